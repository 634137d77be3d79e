"""The plots of the accuracy report."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

matplotlib.rcParams["svg.hashsalt"] = "limn"  # the same numbers give the same file


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def rows(group, beginning, end=""):
    return [r for r in group["rows"] if r["case"].startswith(beginning) and r["case"].endswith(end)]


def columns(group):
    """Index and name; hit() of the shapes has the results of the compiled scene, and would lie upon it."""
    return [(k, name) for k, name in enumerate(group["columns"]) if name != "limn, hit()"]


def leaks(group, path):
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5), sharey=True)
    for axis, kind in zip(axes, ("vertices", "edges")):
        for k, column in columns(group):
            for beginning, style in (("icosphere", "o-"), ("bumpy ball", "s:")):
                found = rows(group, beginning, kind)
                rates = [1e6 * r["cells"][k]["false_misses"] / r["cells"][k]["asked"] for r in found]
                axis.plot(range(len(found)), rates, style, color=f"C{k}",
                          label=column if beginning == "icosphere" else None)
        axis.set_yscale("symlog", linthresh=1)
        axis.set_ylim(bottom=-0.3)
        axis.set_xticks(range(len(found)), [f"{r['x']:g}" for r in found])
        axis.set_xlabel("distance from the origin along each axis")
        axis.set_title(f"aimed at {kind}; dots: icosphere, squares: bumpy ball")
        axis.grid(True, alpha=0.3)
    axes[0].set_ylabel("leaks a million rays")
    axes[0].legend()
    save(figure, path)


def t_error(group, path):
    panels = (("small sphere", "distance / radius"), ("ground sphere", "radius, eye 1 above"),
              ("its horizon", "radius, at the horizon"))
    figure, axes = plt.subplots(1, len(panels), figsize=(13, 4.5), sharey=True)
    for axis, (beginning, label) in zip(axes, panels):
        found = rows(group, beginning)
        for k, column in columns(group):
            # Below 1e-9 ulps there is nothing to see, and 0 has no logarithm.
            errors = [max(r["cells"][k]["t_ulps"], 1e-9) for r in found]
            axis.loglog([r["x"] for r in found], errors, "o-", label=column)
        axis.axhline(1, color="black", linewidth=0.5)
        axis.set_xlabel(label)
        axis.grid(True, alpha=0.3)
    axes[0].set_ylabel("largest error of t, float32 ulps")
    axes[1].legend(loc="center")
    save(figure, path)


def slivers(group, path):
    figure, axis = plt.subplots(figsize=(7, 4.5))
    found = rows(group, "sliver of aspect")
    for k, column in columns(group):
        cells = [r["cells"][k] for r in found]
        wrong = [100 * (c["false_hits"] + c["false_misses"]) / c["asked"] for c in cells]
        axis.plot([r["x"] for r in found], wrong, "o-", label=column)
    axis.set_xscale("log")
    axis.set_xlabel("length / width of the triangle")
    axis.set_ylabel("wrong decisions, % of rays")
    axis.grid(True, alpha=0.3)
    axis.legend()
    save(figure, path)


def draw(groups, folder):
    folder.mkdir(parents=True, exist_ok=True)
    by_name = {group["group"]: group for group in groups}
    leaks(by_name["leaks"], folder / "leaks.svg")
    t_error(by_name["spheres"], folder / "t_error.svg")
    slivers(by_name["triangles"], folder / "slivers.svg")
