"""How good limn's estimate of its own error is: the last chapter of docs/speed-against-error.md.

Runs limn_promise, which goes on where it was interrupted, and limn_sampler_rates. Run through ./build.sh promise.
"""

import json
import math
import statistics
import subprocess

from machine import ROOT
from reports import origin, stamp, write
from titles import SCENES

BIN = ROOT / "build/release/bin"
RAW = ROOT / "build/promise"
TITLES = {**SCENES, "bouncing": "bouncing spheres (figure 1)", "glass": "glass (figure 13)", "fireflies": "fireflies"}


def lower_bound(part, whole):
    """Of a share, with 95 % confidence (Wilson, Probable inference, the law of succession, and statistical inference,
    1927)."""
    z2, share = 1.645 ** 2, part / whole
    return (share + z2 / (2 * whole) - math.sqrt(z2 * (share * (1 - share) + z2 / (4 * whole)) / whole)) / (1 + z2 / whole)


def share(part, whole):
    return f"{part} of {whole}, ≥ {100 * lower_bound(part, whole):.0f} %" if whole else "–"


def read(folder):
    """The lines of each scene, as limn_promise wrote them."""
    found = {}
    for name in TITLES:
        path = folder / f"{name}.jsonl"
        if path.exists():
            found[name] = [json.loads(line) for line in path.read_text().splitlines()]
    return found


def coverage_lines(scenes):
    counts = sorted({r["after"] for rows in scenes.values() for r in rows} - {0})
    lines = ["### How good the estimate is", "",
             "Estimate over true relMSE, both as means over the seeds that have an estimate; how often the 95 % interval holds "
             "the true error, with a lower bound of that share at 95 % confidence; and how many have no estimate.", "",
             "| scene | " + " | ".join(f"{n} samples" for n in counts) + " | all |", "|---|" + "---|" * (len(counts) + 1)]
    pooled = {n: [0, 0] for n in [*counts, "all"]}
    for name, rows in scenes.items():
        cells, of_scene = [], [0, 0]
        for n in counts:
            measured = [r for r in rows if r["after"] == n]
            known = [r for r in measured if r["estimate"] is not None]
            held = sum(r["lower"] <= r["error"] <= r["upper"] for r in known)
            for total in (of_scene, pooled[n], pooled["all"]):
                total[0] += held
                total[1] += len(known)
            ratio = sum(r["estimate"] for r in known) / sum(r["error"] for r in known) if known else None
            none = f", {len(measured) - len(known)} without" if len(known) < len(measured) else ""
            cells.append(f"{ratio:.2f}; {share(held, len(known))}{none}" if known else "none")
        lines.append(f"| {TITLES[name]} | " + " | ".join([*cells, share(*of_scene)]) + " |")
    lines.append("| together | " + " | ".join(share(*pooled[n]) for n in [*counts, "all"]) + " |")
    return lines + [""]


def stop_lines(scenes):
    targets = sorted({r["target"] for rows in scenes.values() for r in rows if r["target"]}, reverse=True)
    lines = ["### How often --error keeps its promise", "",
             "Kept: the true relMSE is at or under the target. Samples: the median. The overshoot is in samples, over the fewest "
             "(by bisection, 8 at least) at which the same render meets the target.", "",
             "| scene | target | kept | samples | median overshoot | target / true error, median |", "|---|---:|---:|---:|---:|---:|"]
    pooled, overshoots = {t: [0, 0] for t in targets}, []
    for name, rows in scenes.items():
        for target in targets:
            stops = [r for r in rows if r["target"] == target]
            if not stops:
                continue
            kept = sum(r["error"] <= target for r in stops)
            pooled[target][0] += kept
            pooled[target][1] += len(stops)
            over = [r["samples"] / r["fewest"] - 1 for r in stops if r["fewest"]]
            overshoots += over
            lines.append(f"| {TITLES[name]} | {target:.0e} | {kept} of {len(stops)} | "
                         f"{statistics.median(r['samples'] for r in stops):.0f} | "
                         + (f"{100 * statistics.median(over):.0f} %" if over else "–")
                         + f" | {statistics.median(target / r['error'] for r in stops):.2f} |")
    lines += ["", "Together: " + "; ".join(f"{share(*pooled[t])} at {t:.0e}" for t in targets) + "; "
              + share(*[sum(p[i] for p in pooled.values()) for i in (0, 1)]) + " in all."
              + (f" The median overshoot of all is {100 * statistics.median(overshoots):.0f} %." if overshoots else "")]
    return lines + [""]


def gain_lines(scenes):
    targets = sorted({r["target"] for rows in scenes.values() for r in rows if r["halves"]}, reverse=True)
    lines = ["### What two replicates gain over four", "",
             "The error of the mean of two renders of half as many samples, which is that of four replicates, over that of one: "
             "the geometric mean over seeds, with its standard error, at the samples that each target takes.", "",
             "| scene | " + " | ".join(f"{t:.0e}" for t in targets) + " |", "|---|" + "---:|" * len(targets)]
    for name, rows in scenes.items():
        cells = []
        for target in targets:
            logs = [math.log(r["halves"] / r["error"]) for r in rows if r["target"] == target and r["halves"] > 0 < r["error"]]
            spread = statistics.stdev(logs) / math.sqrt(len(logs)) if len(logs) > 1 else math.nan
            cells.append(f"{math.exp(statistics.mean(logs)):.2f} ± {100 * spread:.0f} %" if logs else "–")
        lines.append(f"| {TITLES[name]} | " + " | ".join(cells) + " |")
    return lines + [""]


def slope(variance):
    """Least-squares slope of log variance over log samples."""
    x, y = [math.log(int(n)) for n in variance], [math.log(max(v, 1e-300)) for v in variance.values()]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def rate_lines(rows):
    samples = list(rows[0]["variance"])
    lines = ["### How fast pixels converge", "",
             f"The relative variance of single pixels, over {rows[0]['seeds']} seeds, by the number of samples, and the slope of its "
             "logarithm. The two replicates, which the error estimate needs, are part of it: they cost a factor of 1.4 where "
             "the slope is -1.5, and four where it is -3.", "",
             "| pixel | sampler | " + " | ".join(samples) + " | slope |", "|---|---|" + "---:|" * (len(samples) + 1)]
    for r in rows:
        lines.append(f"| {r['pixel']} | {r['sampler']} | " + " | ".join(f"{v:.1e}" for v in r["variance"].values()) +
                     f" | {slope(r['variance']):.2f} |")
    return lines + [""]


def main():
    head = origin("promise")
    folder = RAW / head["sources"]  # what was measured on others does not count
    folder.mkdir(parents=True, exist_ok=True)
    out = folder / "sampler_rates.json"
    if not out.exists():
        subprocess.run([BIN / "limn_sampler_rates", "--json", out], check=True, cwd=ROOT)
    subprocess.run([BIN / "limn_promise", "--folder", folder], check=True, cwd=ROOT)
    scenes = read(folder)
    write("promise", "\n".join([
        f"{stamp(head)}.", "",
        "64x64 pixels; references in two independent halves, each to an eighth of the least target. Fireflies: a small bright "
        "lamp behind a screen, whose light arrives by way of a fuzzy mirror alone.", "",
        *coverage_lines(scenes), *stop_lines(scenes), *gain_lines(scenes), *rate_lines(json.loads(out.read_text()))]))


if __name__ == "__main__":
    main()
