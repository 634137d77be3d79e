"""Speed against error: docs/speed-against-error.md and its plot.

Renders four of the figures at growing sample counts with several seeds, and states for each the seconds of rendering and
the relMSE that they bought, against two long renders with other seeds: one by the same estimator, one by the naive one.
Each reference comes in two independent halves; its own error, known from their difference, is subtracted. Beside the
measured error stands what the film estimated without any reference.

Needs limn's programs in build/release/bin and matplotlib. Run through ./build.sh convergence [--full].
"""

import argparse
import datetime
import json
import math
import statistics
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from machine import ROOT, commit, processor

BIN = ROOT / "build/release/bin"
RAW = ROOT / "build/convergence"
FIGURES = {
    "fig01": "bouncing spheres",
    "fig13": "three spheres, glass and metal",
    "fig15": "Cornell box",
    "fig16": "smoke in the Cornell box",
}
SAMPLES = (4, 16, 64, 256)
SEEDS = range(1, 9)
REFERENCE_SEEDS = {"path": (1001, 1002), "naive": (2001, 2002)}


def program(figure):
    found = sorted(BIN.glob(f"{figure}_*"))
    if len(found) != 1:
        sys.exit(f"convergence: {figure} is not built in {BIN}")
    return found[0]


def render(figure, size, spp, seed, estimator="path"):
    """Renders once and keeps the result as long as the program stays the same."""
    name = f"{figure}_{size}_{estimator}_{spp}_{seed}"
    exr, report = RAW / f"{name}.exr", RAW / f"{name}.json"
    if not report.exists() or report.stat().st_mtime < program(figure).stat().st_mtime:
        subprocess.run(
            [program(figure), "--quiet", "-o", exr, "--report", report, "--size", f"{size}x{size}", "--spp", str(spp),
             "--seed", str(seed), "--estimator", estimator],
            check=True, cwd=RAW)
    return exr, json.loads(report.read_text())


def error(test, halves):
    out = subprocess.run([BIN / "limn", "compare", test, *halves, "--json", "-"], check=True, capture_output=True, text=True)
    return json.loads(out.stdout)


def measure(figure, size, reference_spp):
    halves = {kind: [render(figure, size, spp, seed, kind)[0] for seed in REFERENCE_SEEDS[kind]]
              for kind, spp in reference_spp.items()}
    rows = []
    for spp in SAMPLES:
        row = {"spp": spp, "seconds": [], "path": [], "naive": [], "estimate": [], "inside": 0, "noisy": set()}
        for seed in SEEDS:
            exr, report = render(figure, size, spp, seed)
            row["seconds"].append(report["seconds"]["render"])
            row["estimate"].append(report["error"]["estimate"])
            for kind, pair in halves.items():
                metrics = error(exr, pair)
                row[kind].append(metrics["corrected_relmse"])
                if metrics["reference_too_noisy"]:
                    row["noisy"].add(kind)
            row["inside"] += report["error"]["ci95_low"] <= row["path"][-1] <= report["error"]["ci95_high"]
        rows.append(row)
    return rows


def spread(values):
    """Mean and the standard error of it."""
    return statistics.mean(values), statistics.stdev(values) / math.sqrt(len(values))


def cell(values, noisy=False):
    mean, deviation = spread(values)
    return f"{mean:.2e} ± {deviation:.0e}" + (" \\*" if noisy else "")


def slope(rows):
    """Least-squares slope of log error over log samples: -1 for independent samples."""
    x = [math.log(r["spp"]) for r in rows]
    y = [math.log(max(statistics.mean(r["path"]), 1e-12)) for r in rows]
    mx, my = statistics.mean(x), statistics.mean(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def table(figure, title, rows):
    lines = [f"### {title} ({figure})", "",
             "| samples | seconds | relMSE (long render) | relMSE (naive long render) | film's own estimate | estimate / measured | measured within its 95 % interval |",
             "|---:|---:|---:|---:|---:|---:|---:|"]
    for r in rows:
        ratio = statistics.mean(r["estimate"]) / statistics.mean(r["path"])
        lines.append(f"| {r['spp']} | {statistics.mean(r['seconds']):.3f} | {cell(r['path'], 'path' in r['noisy'])} | "
                     f"{cell(r['naive'], 'naive' in r['noisy'])} | {cell(r['estimate'])} | {ratio:.2f} | {r['inside']} of {len(SEEDS)} |")
    return lines + ["", f"Slope of log error over log samples: {slope(rows):.2f}.", ""]


def plot(results, path):
    figure, axes = plt.subplots(figsize=(7, 5))
    for name, rows in results.items():
        seconds = [statistics.mean(r["seconds"]) for r in rows]
        line, = axes.loglog(seconds, [statistics.mean(r["path"]) for r in rows], "o-", label=FIGURES[name])
        axes.loglog(seconds, [statistics.mean(r["estimate"]) for r in rows], "x:", color=line.get_color())
    axes.set_xlabel("seconds of rendering")
    axes.set_ylabel("relMSE (dots: measured, crosses: the film's own estimate)")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true", help="400x400 instead of 100x100, longer references")
    full = parser.parse_args().full
    size = 400 if full else 100
    reference_spp = {"path": 4096, "naive": 16384} if full else {"path": 1024, "naive": 2048}
    RAW.mkdir(parents=True, exist_ok=True)

    results = {}
    for figure in FIGURES:
        print(f"{figure} ...", file=sys.stderr, flush=True)
        results[figure] = measure(figure, size, reference_spp)

    threads = render(next(iter(FIGURES)), size, SAMPLES[0], SEEDS[0])[1]["threads"]
    plot(results, ROOT / "docs/speed-against-error.png")
    lines = ["# Speed against error", "",
             "Written by `./build.sh convergence" + (" --full" if full else "") + "`; do not edit. "
             f"{datetime.date.today()}, commit {commit()}, {processor()}, {threads} threads, {size}x{size} pixels, depth 10.", "",
             "relMSE is the mean of (x - r)² / (r² + 0.01) over pixels and channels. Every number is the mean over "
             f"{len(SEEDS)} seeds ± its standard error. The references are long renders with other seeds, in two halves "
             f"each: {reference_spp['path']} samples a pixel and half by the same estimator, {reference_spp['naive']} by the "
             "naive one; their own error is subtracted, and a star marks cells in which it is over a tenth of what is "
             "measured. That both columns agree shows that the two estimators converge to the same picture. The film's "
             "estimate knows no reference. Its interval states the spread of the estimate over blocks of pixels.", "",
             "![error over time](speed-against-error.png)", ""]
    for figure, rows in results.items():
        lines += table(figure, FIGURES[figure], rows)
    (ROOT / "docs/speed-against-error.md").write_text("\n".join(lines))
    (RAW / "results.json").write_text(json.dumps(results, indent=1, default=sorted))


if __name__ == "__main__":
    main()
