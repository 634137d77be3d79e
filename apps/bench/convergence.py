"""Seconds to an error, limn beside its peers: build/results/convergence.html, with --size 400 convergence-400.html.

transport_scenes.cpp describes the scenes once, and peers/ writes them for each renderer that can express them. Each
renderer renders a converged reference in two halves. Then all of them take turns at growing numbers of samples on one
thread, with several seeds. On a machine that does something else meanwhile the seconds say little.
"""

import argparse
import os
import statistics
import sys

import numpy as np

import promise
from convergence_numbers import agreement, corrected_relmse, half_error, median_seconds, solves_another_problem
from renderers import PEERS, PROGRAM, SCENES, SCENES_OF_LIMN, UNIFORM, Failed, Limn, Peer
from results import RESULTS, Kept, origin, table, write

LARGE_SCENES = ("cornell", "lamps", "three-spheres", "still-spheres", "many-lights")
PILOT_SPP, FIRST_SPP, GROWTH, LARGEST_SPP = 16, 4, 4, 1 << 20
STYLES = {"limn": ("black", "o-"), UNIFORM: ("0.5", "o--"), "mitsuba": ("C0", "s-"), "cycles": ("C1", "^-")}


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./build.sh convergence", description=__doc__.splitlines()[0])
    parser.add_argument("--promise", action="store_true", help="measure limn's estimate of its own error instead")
    parser.add_argument("--size", type=int, choices=(100, 400), default=100, help="pixels a side (100)")
    parser.add_argument("--scene", action="append", choices=SCENES + SCENES_OF_LIMN, metavar="NAME",
                        help="only these (all; at size 400 five): " + ", ".join(SCENES))
    parser.add_argument("--peer", action="append", choices=[*PEERS, UNIFORM, "none"], metavar="NAME",
                        help=f"only these (all): {', '.join(PEERS)}, {UNIFORM} (limn with the same "
                             "number of samples in every pixel), none")
    parser.add_argument("--seeds", type=int, metavar="N", help="renders of each kind (4; with --promise 50)")
    parser.add_argument("--cap", type=float, metavar="SECONDS",
                        help="of the longest render, and of half a reference (5; at size 400 40)")
    a = parser.parse_args()
    large = a.size == 400
    a.seeds = a.seeds or (50 if a.promise else 4)
    a.cap = a.cap or (40 if large else 5)
    a.scene = a.scene or (promise.SCENES if a.promise else LARGE_SCENES if large else SCENES)
    a.peer = [key for key in a.peer or PEERS if key != "none"]
    return a


def reference(renderer, a):
    """Two independent halves."""
    threads = len(os.sched_getaffinity(0))
    for seed in (1, 2):  # the first one compiles if there is a compiler
        seconds = renderer.render(a.size, PILOT_SPP, seed, threads)[1]
    spp = PILOT_SPP
    while spp < LARGEST_SPP and 1.5 * spp * seconds / PILOT_SPP < a.cap:
        spp *= 2
    return np.array([renderer.render(a.size, spp, seed, threads)[0] for seed in (1001, 1002)])


def goes_on(rung, halves, a):
    """Whether the next rung is short enough, and this one not better yet than its reference."""
    return GROWTH * statistics.median(rung["seconds"]) <= a.cap and statistics.mean(rung["errors"]) > half_error(halves)


def measure(scene, renderers, a):
    """A row for each renderer. One that cannot render the scene says why."""
    print(f"convergence: {scene}", file=sys.stderr, flush=True)
    rows, references = {}, {}
    for renderer in renderers:
        row = rows[renderer.key] = {"rungs": []}
        try:
            row["about"] = renderer.open(scene)
            references[renderer.key] = reference(renderer, a)
            row["agreement"] = agreement(references["limn"], references[renderer.key])
        except Failed as problem:
            if renderer.key == "limn":
                raise
            row["failed"] = str(problem)
    # Climb the ladders of samples. The renderers take turns at each rung and seed.
    active, spp = [renderer for renderer in renderers if renderer.key in references], FIRST_SPP
    while active and spp <= LARGEST_SPP:
        for renderer in active:
            rows[renderer.key]["rungs"].append({"seconds": [], "errors": []})
        for seed in range(1, a.seeds + 1):
            for renderer in active:
                rung = rows[renderer.key]["rungs"][-1]
                picture, seconds, rung["spp"] = renderer.render(a.size, spp, seed, 1)
                rung["seconds"].append(seconds)
                rung["errors"].append(corrected_relmse(picture, references[renderer.key]))
        active = [r for r in active if goes_on(rows[r.key]["rungs"][-1], references[r.key], a)]
        spp *= GROWTH
    return rows


def amount(x):
    return f"{x:.3g}" if x < 1000 else f"{x:.0f}"


def seconds_cell(row, error):
    found = median_seconds(error, row["rungs"])
    if not found:
        return "–"
    middle, least, most, outside = found
    return f"{'~' if outside else ''}{amount(middle)} ({amount(least)}..{amount(most)})"


def ratio_cell(rows, error):
    """limn's median seconds over those of the fastest peer that solves the same problem."""
    found = {key: median_seconds(error, row["rungs"]) for key, row in rows.items()
             if key != UNIFORM and row["rungs"] and not solves_another_problem(*row["agreement"])}
    ours = found.pop("limn", None)
    known = {key: seconds[0] for key, seconds in found.items() if seconds}
    if not ours or not known:
        return "–"
    best = min(known, key=known.get)
    return f"{ours[0] / known[best]:.2f} of {best}"


def rate_cell(row, pixels):
    rung = row["rungs"][-1]
    return f"{statistics.median(1e-6 * rung['spp'] * pixels / s for s in rung['seconds']):.2f}"


def agreement_cell(row):
    difference, noise = row["agreement"]
    text = f"{100 * difference:.2f} % ± {100 * noise:.2f}"
    return f"**{text}**" if solves_another_problem(difference, noise) else text


def page(scenes, a, plot):
    keys = ["limn", *a.peer]

    def cells(cell, rows):
        return [cell(rows[key]) if rows[key]["rungs"] else "–" for key in keys]

    about = {key: row["about"] for rows in scenes.values() for key, row in rows.items() if "about" in row}
    text = f"{a.seeds} seeds.\n\n" + "".join(f"- {key}: {said}\n" for key, said in about.items())
    for error in (1e-3, 1e-4):
        text += (f"\n## Seconds to relMSE {error:g} on one thread\n\n"
                 "The median over the seeds, with the least and the largest. A `~` marks what is extrapolated.\n\n")
        text += table(["scene", *keys, "limn / fastest peer"],
                      [[scene, *cells(lambda row: seconds_cell(row, error), rows), ratio_cell(rows, error)]
                       for scene, rows in scenes.items()])
    text += f"\n![error over seconds]({plot})\n\n## Million samples a second on one thread\n\n"
    text += table(["scene", *keys], [[scene, *cells(lambda row: rate_cell(row, a.size**2), rows)]
                                     for scene, rows in scenes.items()])
    text += ("\n## Difference from limn's picture\n\nRoot mean square of the relative differences of 10x10 blocks beyond "
             "noise, ± the noise. If it is bold, the renderer solves another problem and is not compared.\n\n")
    text += table(["scene", *keys], [[scene, *cells(agreement_cell, rows)] for scene, rows in scenes.items()])
    failed = [f"- {scene}, {key}: {row['failed']}\n" for scene, rows in scenes.items() for key, row in rows.items()
              if "failed" in row]
    return text + ("\n## What failed\n\n" + "".join(failed) if failed else "")


def draw(scenes, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    lines = -(-len(scenes) // 2)
    figure, axes = plt.subplots(lines, 2, figsize=(11, 3.6 * lines), squeeze=False)
    for axis in axes.flat[len(scenes):]:
        axis.set_axis_off()
    for axis, (scene, rows) in zip(axes.flat, scenes.items()):
        for key, row in rows.items():
            color, style = STYLES[key]
            axis.loglog([statistics.median(rung["seconds"]) for rung in row["rungs"]],
                        [statistics.mean(rung["errors"]) for rung in row["rungs"]], style, color=color, label=key)
        axis.set(title=scene, xlabel="seconds of rendering, one thread", ylabel="relMSE")
        axis.grid(True, alpha=0.3)
        axis.legend()
    figure.tight_layout()
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
            for renderer in renderers:
                renderer.close()
            draw(raw, RESULTS / f"{name}.png")
            write(name, f"Seconds to an error, {a.size}x{a.size} pixels", head, raw, page(raw, a, f"{name}.png"))
    except Failed as problem:
        sys.exit(f"convergence: {problem}")
    kept.forget()


if __name__ == "__main__":
    main()
