"""The plot of the convergence report."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import convergence_numbers as numbers
from convergence_tables import SCENES, measured

matplotlib.rcParams["svg.hashsalt"] = "limn"  # the same numbers give the same file
STYLES = {"limn": ("black", "o-"), "limn-naive": ("0.75", "o:"), "limn-light": ("0.6", "o--"),
          "limn-uniform": ("0.4", "o-."), "mitsuba": ("C0", "s-"), "cycles": ("C1", "^-"), "luxcore": ("C2", "v-")}


def draw(scenes, path):
    shown = [scene for scene in SCENES if scene in scenes]
    columns = 2
    figure, axes = plt.subplots(-(-len(shown) // columns), columns, figsize=(11, 3.6 * -(-len(shown) // columns)),
                                squeeze=False)
    for axis, scene in zip(axes.flat, shown):
        for key, row in measured(scenes[scene]).items():
            color, style = STYLES[key]
            curve = [(s, e) for s, e in numbers.mean_curve(row["rungs"]) if e > 0]
            axis.loglog([s for s, _ in curve], [e for _, e in curve], style, color=color, label=row["name"],
                        markersize=3)
        axis.set_title(SCENES[scene], fontsize=9)
        axis.set_xlabel("seconds of rendering, one thread")
        axis.set_ylabel("relMSE")
        axis.grid(True, alpha=0.3)
        axis.legend(fontsize=6)
    for axis in axes.flat[len(shown):]:
        axis.set_axis_off()
    figure.tight_layout()
    path.parent.mkdir(exist_ok=True)
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
