"""The performance report: the generated part of docs/performance.md, and its plots.

Runs limn bench (the table, and how building and tracing grow with the scene), limn_bench_truth, and
limn_count_instructions under callgrind in builds without one feature each. Interrupted, it goes on where it was. Raw
numbers go to build/bench/all.json, from which --again writes the report anew. Prose outside the markers in
docs/performance.md stays as it is. Exit status 0 unless a result is wrong or a measurement fails: what is slow is
marked, not punished.

Needs limn's programs in build/release/bin, valgrind, cmake and matplotlib. Run through ./build.sh bench [--full]
[MODEL.obj ...]. On a machine that does something else meanwhile its times say little.
"""

import argparse
import json
import os
import subprocess
import sys

import performance_instructions
import performance_plots
import performance_tables
from machine import ROOT
from reports import Kept, origin, write

BIN = ROOT / "build/release/bin"
RAW = ROOT / "build/bench"

# Triangles of the growing scenes, and how many `--scale 1` has.
GROWTH = [1e3, 1e4, 1e5, 5e5, 2e6]
GROWTH_FULL = GROWTH + [5e6, 2e7]
FULL_SIZE = {"sphere": 2e6, "soup": 1e6}


def say(text):
    print(f"bench: {text}", file=sys.stderr, flush=True)


def limn_bench(name, *arguments):
    """Runs limn bench and returns its JSON, and whether its results agree."""
    path = RAW / f"{name}.json"
    path.unlink(missing_ok=True)
    run = subprocess.run([BIN / "limn", "bench", "--json", path, *map(str, arguments)],
                         stdout=subprocess.DEVNULL)
    if not path.exists():
        sys.exit(f"bench: limn bench {name} ended with status {run.returncode}")
    return json.loads(path.read_text()), run.returncode == 0


def measure_table(full, models):
    say("rays a second")
    rays, rounds = ("262144", "15") if full else ("131072", "7")
    names = [word for name in ("sphere", "soup", "spheres", "cornell", "forest") for word in ("--scene", name)]
    return limn_bench("table", *names, *models, "--rays", rays, "--rounds", rounds)


def measure_grown(scene, n):
    say(f"{scene} of {n:.0e} triangles")
    result, _ = limn_bench("growing", "--scene", scene, "--scale", n / FULL_SIZE[scene], "--rays", "65536", "--rounds",
                           "3", "--build-rounds", "1" if n > 4e6 else "3", "--threads", "1", "--kind", "primary",
                           "--kind", "diffuse1")
    return result["scenes"][0]


def judge(full, models):
    say("results against exact truth")
    run = subprocess.run([BIN / "limn_bench_truth", "1", "65536", "200" if full else "40", *models],
                         stdout=subprocess.PIPE, text=True)
    if not run.stdout:
        sys.exit(f"bench: limn_bench_truth ended with status {run.returncode}")
    return json.loads(run.stdout)


def measure_all(full, models):
    command = "./build.sh bench" + (" --full" if full else "")
    head = origin("performance", " ".join([command, *models]))
    kept = Kept(RAW / "kept.json", sources=head["sources"], full=full, models=models)
    head = kept("head", lambda: head)
    table, content = kept("table", lambda: measure_table(full, models))
    growth = {scene: [kept(f"{scene} {n:.0e}", lambda: measure_grown(scene, n))
                      for n in (GROWTH_FULL if full else GROWTH)] for scene in FULL_SIZE}
    truth = kept("truth", lambda: judge(full, models))
    instructions = kept("instructions", lambda: performance_instructions.measure(RAW, BIN, full, say))
    faults = performance_tables.faults(table, content, truth)
    raw = {"table": table, "growth": growth, "truth": truth, "instructions": instructions, "faults": faults,
           "head": {**head, "faults": len(faults), "minutes": kept.minutes()}}
    (RAW / "all.json").write_text(json.dumps(raw, indent=1))
    kept.forget()
    return raw


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true", help="twice the rays and rounds, scenes to 2e7 triangles")
    parser.add_argument("--again", action="store_true", help="write the report from what was measured last")
    parser.add_argument("models", nargs="*", metavar="MODEL.obj", help="measured too")
    arguments = parser.parse_args()
    for model in arguments.models:
        if not os.path.isfile(model):
            parser.error(f"{model}: there is no such file")
    RAW.mkdir(parents=True, exist_ok=True)
    raw = (json.loads((RAW / "all.json").read_text()) if arguments.again
           else measure_all(arguments.full, arguments.models))

    performance_plots.draw(raw, ROOT / "docs/performance")
    write("performance", performance_tables.report(raw))
    for fault in raw["faults"]:
        say(fault)
    say(f"docs/performance.md: {len(raw['faults'])} faults, "
        f"{len(performance_tables.missed(raw))} goals missed")
    return 1 if raw["faults"] else 0


if __name__ == "__main__":
    sys.exit(main())
