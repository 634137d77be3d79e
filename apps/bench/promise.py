"""What `--error` promises and what the samplers give, measured: the last chapter of docs/speed-against-error.md.

Runs limn_promise, which goes on where it was interrupted, and limn_sampler_rates. Run through ./build.sh promise
[--full].
"""

import argparse
import json
import math
import subprocess

from machine import ROOT
from reports import origin, stamp, write

BIN = ROOT / "build/release/bin"
RAW = ROOT / "build/promise"
TITLES = {"cornell": "Cornell box", "bouncing": "bouncing spheres", "glass": "glass", "smoke": "smoke",
          "fireflies": "fireflies"}


def measure(program, out, *options):
    subprocess.run([BIN / program, "--json", out, *options], check=True, cwd=ROOT)
    return json.loads(out.read_text())


def promise_lines(head, rows):
    stops, kept = sum(r["stops"] for r in rows), sum(r["kept"] for r in rows)
    lines = [f"{stamp(head)}.", "",
             f"Each scene is rendered to a target with {rows[0]['stops']} seeds, {rows[0]['size']}x{rows[0]['size']} pixels, and each "
             "picture is compared with a reference in two halves whose mean has at most a thirtieth of that error. Kept: the "
             "true relMSE is at or under the target. The overshoot is in samples, over the fewest (by bisection) at which "
             "the same render meets the target; beside it, by how much the true error is under the target. Fireflies: a "
             "small bright lamp behind a screen, whose light arrives by way of a fuzzy mirror alone.", "",
             "| scene | target | kept | estimate / true error | samples | median overshoot | target / true error, median |",
             "|---|---:|---:|---:|---:|---:|---:|"]
    for r in rows:
        overshoot = "" if r["median_overshoot"] is None else f"{100 * r['median_overshoot']:.0f} % ({r['overshoots_measured']} seeds)"
        lines.append(f"| {TITLES[r['scene']]} | {r['target']:.1e} | {r['kept']} of {r['stops']} | {r['estimate_over_error']:.3f} | "
                     f"{r['median_samples']:.0f} | {overshoot} | {r['median_target_over_error']:.3f} |")
    return lines + ["", f"Together {kept} of {stops}: {100 * kept / stops:.1f} %.", ""]


def slope(variance):
    """Least-squares slope of log variance over log samples."""
    x, y = [math.log(int(n)) for n in variance], [math.log(max(v, 1e-300)) for v in variance.values()]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def rate_lines(rows):
    samples = list(rows[0]["variance"])
    lines = ["### How fast pixels converge", "",
             f"The relative variance of single pixels, over {rows[0]['seeds']} seeds, by the number of samples, and the slope of its "
             "logarithm. The four replicates, which the error estimate needs, are part of it: they cost an even sequence a "
             "factor of two at edges (slope -1.5), sixteen where it is smooth (slope -3).", "",
             "| pixel | sampler | " + " | ".join(samples) + " | slope |", "|---|---|" + "---:|" * (len(samples) + 1)]
    for r in rows:
        lines.append(f"| {r['pixel']} | {r['sampler']} | " + " | ".join(f"{v:.1e}" for v in r["variance"].values()) +
                     f" | {slope(r['variance']):.2f} |")
    return lines + [""]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true", help="200 seeds for each scene instead of 50")
    full = parser.parse_args().full
    seeds = ("--seeds", "200") if full else ("--seeds", "50", "--searched", "12")
    head = origin("promise", "./build.sh promise" + (" --full" if full else ""))
    folder = RAW / (head["sources"] + "-full" * full)  # what was measured otherwise does not count
    folder.mkdir(parents=True, exist_ok=True)
    rates = measure("limn_sampler_rates", folder / "sampler_rates.json")
    promises = measure("limn_promise", folder / "promise.json", "--folder", folder, *seeds)
    write("promise", "\n".join(promise_lines(head, promises) + rate_lines(rates)))


if __name__ == "__main__":
    main()
