"""Measures the seconds to a relMSE, of limn and of other renderers.

transport_scenes.cpp describes the scenes, and the modules of peers/ make them for each renderer that can express them.
The seconds mean little if the machine runs other programs."""

import argparse
import math
import os
import sys
import tempfile
from pathlib import Path
from statistics import linear_regression, mean, median

import promise
from renderers import PEERS, PROGRAM, SCENES, SCENES_OF_LIMN, UNIFORM, Failed, Limn, Peer, compare
from results import RESULTS, Kept, origin, table, write

LARGE_SCENES = ("cornell", "lamps", "three-spheres", "still-spheres", "many-lights")
PILOT_SPP, FIRST_SPP, GROWTH, LARGEST_SPP = 16, 4, 4, 1 << 20
ERROR = 1e-3  # the relMSE for which seconds are stated
DIFFERENT = 0.01  # smallest difference of block means that shows that two renderers solve different problems


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./build.sh convergence", description=__doc__.splitlines()[0])
    parser.add_argument("--promise", action="store_true", help="measure limn's estimate of its error instead")
    parser.add_argument("--size", type=int, choices=(100, 400), default=100, help="pixels a side (100)")
    parser.add_argument("--scene", action="append", choices=SCENES + SCENES_OF_LIMN, metavar="NAME",
                        help="only these (all, at size 400 five): " + ", ".join(SCENES))
    parser.add_argument("--peer", action="append", choices=[*PEERS, UNIFORM, "none"], metavar="NAME",
                        help=f"only these: {', '.join(PEERS)}, {UNIFORM} (limn, every pixel sampled alike), none")
    parser.add_argument("--seeds", type=int, metavar="N", help="renders of each kind (4; with --promise 50)")
    parser.add_argument("--cap", type=float, metavar="SECONDS",
                        help="of the longest render, and of half a reference (5; at size 400 40)")
    a = parser.parse_args()
    a.seeds = a.seeds or (50 if a.promise else 4)
    a.cap = a.cap or (40 if a.size == 400 else 5)
    a.scene = a.scene or (promise.SCENES if a.promise else LARGE_SCENES if a.size == 400 else SCENES)
    a.peer = [key for key in a.peer or PEERS if key != "none"]
    return a


def reference(renderer, folder, a):
    """Renders two independent halves of the reference and returns their paths."""
    threads, spp = len(os.sched_getaffinity(0)), PILOT_SPP
    # Measure the time of a pilot render. Render it twice, because some renderers compile in the first one.
    for seed in (1, 2):
        seconds, _ = renderer.render(folder / "pilot.exr", a.size, spp, seed, threads)
    while spp < LARGEST_SPP and 1.5 * spp * seconds / PILOT_SPP < a.cap:
        spp *= 2
    halves = [folder / f"{renderer.key}-{half}.exr" for half in "ab"]
    for seed, half in enumerate(halves, 1001):
        renderer.render(half, a.size, spp, seed, threads)
    return halves


def block_means(picture):
    """Writes a picture of the means of blocks of 10x10 pixels and returns its path."""
    from OpenImageIO import ROI, ImageBuf, ImageBufAlgo  # Debian's python3-openimageio
    image, small = ImageBuf(str(picture)), picture.with_suffix(".blocks.exr")
    size = image.spec().width // 10
    ImageBufAlgo.resize(image, "box", 1, ROI(0, size, 0, size, 0, 1, 0, 3)).write(str(small))
    return small


def agreement(ours, theirs):
    """Returns how much two references differ. Each consists of two halves. The first number is the root mean square of
    the relative differences of blocks of 10x10 pixels, less the noise. The second number is the noise."""
    (a, b), (c, d) = map(block_means, ours), map(block_means, theirs)
    against_ours, variance = compare(c, a, b), compare(c, d)["relmse"] / 2
    difference = max(0, against_ours["corrected_relmse"] - variance)
    return math.sqrt(difference), math.sqrt(variance + against_ours["reference_relmse"])


def measure(scene, renderers, a):
    """Returns a row for each renderer. If a renderer cannot render the scene, its row has the reason."""
    print(f"convergence: {scene}", file=sys.stderr, flush=True)
    rows, references = {}, {}
    # Render the references.
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for renderer in renderers:
            row = rows[renderer.key] = {"rungs": []}
            try:
                row["about"] = renderer.open(scene)
                references[renderer.key] = reference(renderer, folder, a)
                row["agreement"] = agreement(references["limn"], references[renderer.key])
            except Failed as problem:
                if renderer.key == "limn":
                    raise
                row["failed"] = str(problem)
        # Multiply the number of samples from rung to rung. The renderers take turns at each rung and seed.
        active, spp = [renderer for renderer in renderers if renderer.key in references], FIRST_SPP
        while active and spp <= LARGEST_SPP:
            rungs = {renderer: {"seconds": [], "errors": []} for renderer in active}
            for seed in range(1, a.seeds + 1):
                for renderer, rung in rungs.items():
                    seconds, rung["spp"] = renderer.render(folder / "a.exr", a.size, spp, seed, 1)
                    compared = compare(folder / "a.exr", *references[renderer.key])
                    rung["seconds"].append(seconds)
                    rung["errors"].append(compared["corrected_relmse"])
                    rung["reference_error"] = compared["reference_relmse"]
            for renderer, rung in rungs.items():
                rows[renderer.key]["rungs"].append(rung)
            # Go on with a renderer if the next rung is short enough and its error is still above that of its reference.
            active = [renderer for renderer, rung in rungs.items() if GROWTH * median(rung["seconds"]) <= a.cap
                      and mean(rung["errors"]) > rung["reference_error"]]
            spp *= GROWTH
    return rows


def seconds_to(error, curve):
    """Returns the seconds to an error on a curve of (seconds, error), and True if they are extrapolated. The seconds
    are found on the line error = c / seconds^p, which is fitted to the three points with the nearest errors."""
    known = [(math.log(s), math.log(e)) for s, e in curve if s > 0 and e > 0]
    if not known:
        return math.inf, True
    goal = math.log(error)
    near = sorted(known, key=lambda point: abs(point[1] - goal))[:3]
    x, y = zip(*near)
    slope = linear_regression(x, y).slope if len(set(x)) > 1 else -1.0
    if not -3 < slope < -0.3:  # the noise is too large for a fit: use the slope of independent samples
        slope = -1.0
    is_inside = min(e for _, e in known) <= goal <= max(e for _, e in known)
    return math.exp(mean(x) + (goal - mean(y)) / slope), not is_inside


def seconds_by_seed(error, rungs):
    """Returns the sorted results of seconds_to for each seed. A rung has the seconds and the errors of each seed."""
    curves = zip(*([(median(rung["seconds"]), e) for e in rung["errors"]] for rung in rungs))
    return sorted(seconds_to(error, curve) for curve in curves)


def median_seconds(row):
    return median(seconds for seconds, _ in seconds_by_seed(ERROR, row["rungs"]))


def solves_another_problem(difference, noise):
    return difference > max(DIFFERENT, 2 * noise)


def seconds_cell(row):
    found = seconds_by_seed(ERROR, row["rungs"])
    mark = "~" if sum(outside for _, outside in found) > len(found) / 2 else ""
    return f"{mark}{median_seconds(row):.3g} ({found[0][0]:.3g}..{found[-1][0]:.3g})"


def ratio_cell(rows):
    """Returns limn's median seconds over those of the fastest peer that solves the same problem."""
    times = {key: median_seconds(row) for key, row in rows.items()
             if key in PEERS and row["rungs"] and not solves_another_problem(*row["agreement"])}
    best = min(times, key=times.get, default=None)
    return f"{median_seconds(rows['limn']) / times[best]:.2f} of {best}" if best else "–"


def page(scenes, a, plot):
    # Define the cells of the tables.
    keys = ["limn", *a.peer]

    def table_of(cell, *more):
        rows = [[scene, *(cell(rows[key]) if rows[key]["rungs"] else "–" for key in keys),
                 *(of_all(rows) for _, of_all in more)] for scene, rows in scenes.items()]
        return table(["scene", *keys, *(name for name, _ in more)], rows)

    def rate_cell(row):
        rung = row["rungs"][-1]
        return f"{1e-6 * rung['spp'] * a.size**2 / median(rung['seconds']):.2f}"

    def agreement_cell(row):
        difference, noise = row["agreement"]
        text = f"{100 * difference:.2f} % ± {100 * noise:.2f}"
        return f"**{text}**" if solves_another_problem(difference, noise) else text

    # Collect what the renderers say of themselves, and what failed.
    known = {f"- {key}: {row['about']}\n" for rows in scenes.values() for key, row in rows.items() if "about" in row}
    failed = "\n".join(f"- {scene}: {row['failed']}" for scene, rows in scenes.items() for row in rows.values()
                       if "failed" in row)
    return f"""{a.seeds} seeds.

{"".join(sorted(known))}

## Seconds to relMSE {ERROR:g} on one thread

Medians over the seeds, with the least and the largest. A `~` marks what is extrapolated.

{table_of(seconds_cell, ("limn / fastest peer", ratio_cell))}
![curves]({plot})

## Million samples a second on one thread

{table_of(rate_cell)}
## Difference from limn's picture

Root mean square of the relative differences of 10x10 blocks beyond noise, ± the noise. If it is bold, the renderer
solves another problem and is not compared.

{table_of(agreement_cell)}
{failed}"""


def draw(scenes, path):
    import matplotlib.pyplot as plt
    lines = -(-len(scenes) // 2)
    figure, axes = plt.subplots(lines, 2, figsize=(11, 3.6 * lines), squeeze=False, layout="constrained")
    for axis in axes.flat[len(scenes):]:
        axis.set_axis_off()
    for axis, (scene, rows) in zip(axes.flat, scenes.items()):
        for key, row in rows.items():
            axis.loglog([median(rung["seconds"]) for rung in row["rungs"]],
                        [mean(rung["errors"]) for rung in row["rungs"]], "o-", label=key)
        axis.set(title=scene, xlabel="seconds of rendering, one thread", ylabel="relMSE")
        axis.grid(True, alpha=0.3)
        axis.legend()
    figure.savefig(path)


def main():
    a = parse_arguments()
    head = origin(" ".join(["./build.sh convergence", *sys.argv[1:]]))
    name = "promise" if a.promise else "convergence" if a.size == 100 else f"convergence-{a.size}"
    kept = Kept(name, head=head, program=PROGRAM.stat().st_mtime)
    try:
        if a.promise:
            raw = {scene: kept(scene, lambda: promise.measure(scene, a.seeds)) for scene in a.scene}
            write(name, "limn's estimate of its own error", head, raw, promise.page(raw, a.seeds))
        else:
            renderers = [Limn("limn"), *(Limn(key) if key == UNIFORM else Peer(key) for key in a.peer)]
            raw = {scene: kept(scene, lambda: measure(scene, renderers, a)) for scene in a.scene}
            draw(raw, RESULTS / f"{name}.png")
            write(name, f"Seconds to an error, {a.size}x{a.size} pixels", head, raw, page(raw, a, f"{name}.png"))
    except Failed as problem:
        sys.exit(f"convergence: {problem}")
    kept.forget()


if __name__ == "__main__":
    main()
