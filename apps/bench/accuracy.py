"""Counts how many intersections are wrong, in limn and in other libraries.

Run it by ./build.sh accuracy. The exit status is 1 if limn has a wrong intersection. An interrupted run continues with
the groups that are not measured yet. docs/accuracy.md describes the groups."""

import argparse
import sys

import matplotlib.pyplot as plt

from results import BIN, RESULTS, Kept, origin, run_json, table, write

GROUPS = ("leaks", "quad-leaks", "spheres", "triangles", "quads", "slabs", "instances", "leaving", "far-origins",
          "bad-rays", "furnace", "queries")
LIMIT_ULPS = 1
LIMIT_FURNACE = 1e-3
DEEP = "depth 1000"  # the furnace's column without Russian roulette, whose paths are long enough to lose no light
WRONG = ("false_hits", "false_misses", "self_hits", "lost", "aborts")
# Numbers of rays. 1e8 rays in each row of leaks would take two hours on two cores.
USUAL = ("--rays", "250000", "--leak-rays", "1000000")
FULL = ("--rays", "1000000", "--leak-rays", "10000000")


def is_wrong(measure, column, cell):
    if measure == "furnace":
        return (column == DEEP and abs(cell["figure"]) > LIMIT_FURNACE or
                column == "unlimited" and abs(cell["figure"]) > LIMIT_FURNACE + 4.5 * cell["figure_error"])
    # "not <=" is also true for an error of NaN.
    return column.startswith("limn") and (any(cell[key] for key in WRONG) or not cell["t_ulps"] <= LIMIT_ULPS
                                          or not cell["uv_ulps"] <= LIMIT_ULPS)


def faults(groups):
    """Returns a line for each row that was not judged completely, and for each wrong cell of limn."""
    found = []
    for group in groups:
        for row in group["rows"]:
            if row["rays"] != row["judged"]:
                found.append(f"{group['group']}: {row['case']}: {row['rays']} rays, {row['judged']} judged")
            found += [f"{group['group']}: {row['case']}: {column}" for column, cell in
                      zip(group["columns"], row["cells"]) if is_wrong(group["measure"], column, cell)]
    return found


def cell_text(measure, column, cell):
    """Returns the numbers of a cell that are not 0, as text."""
    if not cell["asked"]:
        return "–"
    name = lambda key: "wrong" if measure == "queries" else key.replace("_", " ")
    parts = [f"{cell[key]:,} {name(key)}" for key in WRONG if cell[key]]
    parts += [f"{cell[key]:.2g} {unit}" for key, unit in (("t_ulps", "ulps of t"), ("uv_ulps", "ulps of u, v"))
              if cell[key]]
    if measure == "furnace":
        parts.append(f"{cell['figure']:+.1e} ± {cell['figure_error']:.0e}")
    if measure == "bad" and cell["figure"]:
        parts.append(f"time × {cell['figure']:.2g}")
    text = ", ".join(parts) or "0"
    return f"**{text}**" if is_wrong(measure, column, cell) else text


def draw_leaks(group):
    """Draws the leaks of the group, and returns the Markdown that shows the plot."""
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5), sharey=True, layout="constrained")
    for axis, kind in zip(axes, ("vertices", "edges")):
        for k, column in enumerate(group["columns"]):
            for body, style in (("icosphere", "o-"), ("bumpy ball", "s:")):
                rows = [row for row in group["rows"] if row["case"].startswith(body) and row["case"].endswith(kind)]
                rates = [1e6 * row["cells"][k]["false_misses"] / row["cells"][k]["asked"] for row in rows]
                axis.plot([f"{row['x']:g}" for row in rows], rates, style, color=f"C{k}", label=f"{column}, {body}")
        axis.set(xlabel="distance from the origin along each axis", title=f"aimed at {kind}", yscale="symlog")
        axis.grid(True, alpha=0.3)
    axes[0].set_ylabel("leaks a million rays")
    axes[0].legend(fontsize=7)
    figure.savefig(RESULTS / "accuracy-leaks.svg")
    return "![leaks over the distance from the origin](accuracy-leaks.svg)"


def main():
    parser = argparse.ArgumentParser(prog="./build.sh accuracy", description=__doc__.splitlines()[0])
    parser.add_argument("--full", dest="rays", action="store_const", const=FULL, default=USUAL,
                        help="1e7 rays a row of leaks and 1e6 in others: an hour")
    parser.add_argument("groups", nargs="*", metavar="GROUP", help=f"what to measure (all): {', '.join(GROUPS)}")
    options = parser.parse_args()
    if unknown := set(options.groups) - set(GROUPS):
        parser.error(f"there is no group {', '.join(unknown)}")
    # Measure.
    head = origin(" ".join(["./build.sh accuracy", *sys.argv[1:]]))
    kept = Kept("accuracy", **head)
    measured = [kept(name, lambda: run_json(BIN / "limn_accuracy", name, *options.rays))
                for name in options.groups or GROUPS]
    groups = [one["groups"][0] for one in measured]
    # Write the page.
    found = faults(groups)
    rays = sum(row["rays"] for group in groups for row in group["rows"])
    parts = [f"{rays:,} rays, each judged by exact arithmetic. Embree: {measured[0]['embree'] or 'not installed'}. "
             "A cell says how many rays were answered wrong, and the largest errors of the other answers in float32 "
             "ulps. That of a furnace says the relative deviation of the mean ± its standard error.",
             f"**limn is wrong in {len(found)} cells.**" if found else "**limn is wrong nowhere.**", *found]
    for group in groups:
        rows = [[row["case"], f"{row['rays']:,}",
                 *(cell_text(group["measure"], column, cell) for column, cell in zip(group["columns"], row["cells"]))]
                for row in group["rows"]]
        parts += [f"## {group['group']}", table(["case", "rays", *group["columns"]], rows)]
        if group["group"] == "leaks":
            parts.append(draw_leaks(group))
    write("accuracy", "Accuracy", head, groups, "\n\n".join(parts))
    kept.forget()
    sys.exit("\n".join(f"accuracy: {fault}" for fault in found) or 0)


if __name__ == "__main__":
    main()
