"""The accuracy report: docs/accuracy.md and its plots.

Runs limn_accuracy, table by table (the raw numbers: build/accuracy/*.json), and the hard cases of the suite with more
rays than the suite has: a tenth of what they name, with --full all. Interrupted, it goes on where it was. Exit status 0
only if limn is wrong nowhere; the report is written in any case.

Needs limn's programs in build/release/bin and matplotlib. Run through ./build.sh accuracy [--full].
"""

import argparse
import json
import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import accuracy_plots
import accuracy_tables
from machine import ROOT
from reports import Kept, origin, write

BIN = ROOT / "build/release/bin"
RAW = ROOT / "build/accuracy"
GROUPS = ("leaks", "quad-leaks", "spheres", "triangles", "quads", "slabs", "instances", "leaving", "far-origins",
          "bad-rays", "furnace", "queries")
# Rays a row, and rays a row of leaks: with --full 1.2e8 through the twelve rows of closed meshes together. 1e8 in each
# would take two hours of two cores.
RAYS = {False: ("250000", "1000000"), True: ("1000000", "10000000")}


def measure(group, full):
    rays, leak_rays = RAYS[full]
    run = subprocess.run([BIN / "limn_accuracy", group, "--rays", rays, "--leak-rays", leak_rays],
                         stdout=subprocess.PIPE, text=True)
    if run.returncode != 0:
        sys.exit(f"accuracy: limn_accuracy {group} ended with status {run.returncode}")
    (RAW / f"{group}.json").write_text(run.stdout)
    return json.loads(run.stdout)


def hard_cases(full, kept):
    """Every case of tests/hard in a process of its own: name, passed, seconds. None where there is no such program."""
    program = BIN / "test_hard"
    if not program.exists():
        return None
    environment = dict(os.environ, **{"LIMN_FULL" if full else "LIMN_ACCURACY": "1"})
    names = subprocess.run([program, "--list-test-names-only"], capture_output=True, text=True).stdout.splitlines()

    def run(name):
        started = time.monotonic()
        pattern = "".join("\\" + c if c in "\\,[" else c for c in name)
        done = subprocess.run([program, pattern, "--warn", "NoTests"], env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        seconds = time.monotonic() - started
        if done.returncode != 0:
            print(done.stdout, file=sys.stderr)
        print(f"accuracy: hard case '{name}': {seconds:.0f} s", file=sys.stderr, flush=True)
        return {"case": name, "passed": done.returncode == 0, "seconds": seconds}

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(lambda name: kept(f"hard case: {name}", lambda: run(name), lambda case: case["passed"]),
                             [name.strip() for name in names if name.strip()]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true",
                        help="1e7 rays a row of leaks, 1e6 in others, and all rays of the hard cases: an hour more")
    full = parser.parse_args().full
    RAW.mkdir(parents=True, exist_ok=True)
    head = origin("accuracy", "./build.sh accuracy" + (" --full" if full else ""))
    kept = Kept(RAW / "kept.json", sources=head["sources"], full=full)
    head = kept("head", lambda: head)

    results = [kept(name, lambda: measure(name, full)) for name in GROUPS]
    groups = [result["groups"][0] for result in results]
    cases = hard_cases(full, kept)

    faults = accuracy_tables.faults(groups)
    faults += [f"hard cases: {c['case']}" for c in cases or [] if not c["passed"]]
    head = {**head, "faults": len(faults), "compiler": results[0]["compiler"], "embree": results[0]["embree"], "minutes": kept.minutes()}
    accuracy_plots.draw(groups, ROOT / "docs/accuracy")
    write("accuracy", accuracy_tables.report(head, groups, cases, full, faults))
    if not faults:
        kept.forget()
    for fault in faults:
        print(f"accuracy: {fault}", file=sys.stderr)
    print(f"docs/accuracy.md: {len(faults)} faults", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
