"""The plots of the performance report."""

import statistics

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

matplotlib.rcParams["svg.hashsalt"] = "limn"  # the same numbers give the same file


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def ratios(table, path):
    """One bar a ratio of one thread, with its quartiles, against its goal."""
    panels = (("single_to_default", "single rays / Embree", 1.0), ("single_to_robust", "single rays / robust", 1.3),
              ("batch_to_best", "batches / Embree's best", 1.3))
    rows = [(f"{scene['name']}, {row['rays']}", row) for scene in table["scenes"] for row in scene["rows"]
            if row["threads"] == 1 and row["single_to_default"] is not None]
    figure, axes = plt.subplots(1, 3, figsize=(13, 1 + 0.22 * max(len(rows), 4)), sharey=True)
    for axis, (key, title, goal) in zip(axes, panels):
        found = [row[key] for _, row in rows]
        middle = [r["median"] for r in found]
        error = [[max(0, r["median"] - r["low"]) for r in found], [max(0, r["high"] - r["median"]) for r in found]]
        colors = ["C0" if m >= goal else "C1" for m in middle]
        axis.barh(range(len(rows)), middle, xerr=error, color=colors, error_kw={"linewidth": 0.8})
        axis.axvline(goal, color="black", linewidth=0.8)
        axis.set_title(f"{title}, goal {goal}")
        axis.grid(True, axis="x", alpha=0.3)
    axes[0].set_yticks(range(len(rows)), [name for name, _ in rows], fontsize=8)
    axes[0].invert_yaxis()
    save(figure, path)


def growth(grown, path):
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.5))
    styles = {"limn": "o-", "Embree": "s:"}
    for k, scenes in enumerate(grown.values()):
        n = [scene["primitives"] for scene in scenes]
        for name, style in styles.items():
            if name not in scenes[0]["bytes"]:
                continue
            label = f"{scenes[0]['name']}, {name}"
            build = [1e9 * statistics.median(s["builds"][0]["seconds"][name]) / s["primitives"] for s in scenes]
            axes[0].loglog(n, build, style, color=f"C{k}", label=label)
            axes[1].semilogx(n, [s["bytes"][name] / s["primitives"] for s in scenes], style, color=f"C{k}")
            for kind, alpha in (("primary", 1), ("diffuse1", 0.5)):
                rates = []
                for s in scenes:
                    row = next(r for r in s["rows"] if r["rays"] == kind)
                    rates.append(next(x["million_a_second"] for x in row["subjects"] if x["name"] == name))
                axes[2].loglog(n, rates, style, color=f"C{k}", alpha=alpha)
    axes[0].set_ylabel("build time, ns a triangle")
    axes[1].set_ylabel("memory, bytes a triangle")
    axes[1].set_ylim(bottom=0)
    axes[2].set_ylabel("million rays a second; paler: diffuse")
    for axis in axes:
        axis.set_xlabel("triangles")
        axis.grid(True, which="both", alpha=0.3)
    axes[0].legend()
    save(figure, path)


def draw(raw, folder):
    folder.mkdir(parents=True, exist_ok=True)
    ratios(raw["table"], folder / "ratios.svg")
    growth(raw["growth"], folder / "growth.svg")
