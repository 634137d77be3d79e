#!/usr/bin/env python3
"""Faults that the suite must catch: docs/mutants.md.

Applies the patches beside this file, one at a time, to a copy of the source tree, builds it, and runs the tests until
one fails: first those that the patch suspects, then the whole suite. A fault that nothing notices is a test that is
missing. What was found is kept as long as the sources, the patch and the tests that noticed it stay the same: an
interrupted run goes on where it was. Run through ./build.sh mutants [--full], or with the names of some mutants, which
are then tried anew.
"""

import argparse
import contextlib
import functools
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
from mutant import load_mutants  # which finds apps/bench, where the others are

import reports
from machine import ROOT
from patches import PatchError, copy_tree

WORK = ROOT / "build/mutants"
SOURCE = WORK / "source"
KEPT = WORK / "kept.json"
HANGS = 120  # seconds: some ten times what the slowest test takes
# Half the time of -O3 to compile. What is folded and rounded stays the same: limn builds without -ffast-math. Kernels
# for AVX2 and the fallback alone: all instruction sets share their sources, so that a fault of one is a fault of all.
FLAGS = ["-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DLIMN_WARNINGS_AS_ERRORS=OFF", f"-DLIMN_TEST_TIMEOUT={HANGS}",
         "-DLIMN_DISABLED_TARGETS=HWY_SSSE3|HWY_AVX3_DL|HWY_SSE4|HWY_AVX3"]
COSTS = SOURCE / "build/release/Testing/Temporary/CTestCostData.txt"  # ctest's notes: lines of name, runs, seconds
QUICK_FIRST = WORK / "quick_first.txt"


def run(*command):
    """Exit status and output of a command in the copy; nothing that it started outlives us."""
    with subprocess.Popen(command, cwd=SOURCE, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True) as process:
        try:
            output = process.communicate()[0]
        finally:
            for number in (signal.SIGINT, signal.SIGKILL):
                with contextlib.suppress(ProcessLookupError, subprocess.TimeoutExpired):
                    os.killpg(process.pid, number)
                    process.wait(5)
        return process.returncode, output


def build(*targets):
    status, output = run("cmake", "--build", "--preset", "release", "--target", *targets)
    if status != 0:
        raise PatchError("it does not build:\n" + "\n".join(output.splitlines()[-30:]))


def failing(*options):
    """The tests that fail, in the order of their numbers."""
    if QUICK_FIRST.exists():
        shutil.copy(QUICK_FIRST, COSTS)
    status, output = run("ctest", "--preset", "release", "--exclude-regex", "^mutants:", *options)
    failed = re.findall(r"^\s+\d+ - (.+) \((.+)\)$", output.partition("The following tests FAILED:")[2], re.MULTILINE)
    tests = [name + (" (hangs)" if why == "Timeout" else "") for name, why in failed if why != "Not Run"]
    if status != 0 and not tests:
        raise PatchError("the tests do not run:\n" + "\n".join(output.splitlines()[-10:]))
    return tests


def order_quick_tests_first():
    """ctest begins with what took longest; so it is told the inverse of the times."""
    notes = [line.rsplit(" ", 2) for line in COSTS.read_text().partition("---")[0].splitlines()]
    lines = [f"{name} 1 {1 / (float(seconds) + 0.001)}\n" for name, _, seconds in notes]
    QUICK_FIRST.write_text("".join(lines) + "---\n")


def prepare(mutants, full):
    """Builds what is needed without a fault, and makes sure that it passes."""
    copy_tree(SOURCE)
    QUICK_FIRST.unlink(missing_ok=True)
    if shutil.which("ccache"):  # what is restored need not be compiled again; cmake reads it, here and in the suite
        os.environ["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
    for longer in ("LIMN_FULL", "LIMN_ACCURACY"):
        os.environ.pop(longer, None)  # the short forms of the tests, whatever our own
    status, output = run("cmake", "--preset", "release", *FLAGS)
    if status != 0:
        raise PatchError("cmake fails:\n" + output)
    build(*(["all"] if full else sorted({m.target() for m in mutants})))
    tests = failing() if full else failing("--tests-regex", "|".join(sorted({m.tests() for m in mutants})))
    if tests:
        raise PatchError("without a fault these tests fail already: " + ", ".join(tests))
    order_quick_tests_first()


def killers(mutant, full):
    with mutant.applied(SOURCE):
        if full:
            build("all")
            return failing()
        build(mutant.target())
        tests = failing("--tests-regex", mutant.tests(), "--stop-on-failure")
        if not tests:
            build("all")
            tests = failing("--stop-on-failure")
        return tests


@functools.cache
def digest(patterns):
    return reports.digest(patterns)


def mark(mutant, tests, full):
    """What the answer `tests` for a mutant hangs on: all that is built, the patch, and the room of the test that
    failed, or all rooms."""
    room = tests[0].split(":")[0] if tests and not full else "consumer"
    judges = ("tests", "-tests/mutants")
    if room != "consumer" and (ROOT / "tests" / room).is_dir():
        judges = ("tests/CMakeLists.txt", "tests/*.h", "-tests/*/*.h", "tests/support", f"tests/{room}")
    patch = (ROOT / f"tests/mutants/{mutant.name}.patch").read_text()
    return hashlib.sha256(repr((FLAGS, digest(reports.ALL), digest(judges), patch, full)).encode()).hexdigest()[:12]


def load_kept(mutants, full):
    """What earlier runs found that still holds, by the names of mutants."""
    kept = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    return {m.name: kept[m.name] for m in mutants
            if m.name in kept and kept[m.name]["mark"] == mark(m, kept[m.name]["killers"], full)}


def save_kept(kept):
    beside = KEPT.with_suffix(".new")
    beside.write_text(json.dumps(kept, indent=1))
    beside.replace(KEPT)


def report(head, results, full):
    killed = sum(bool(r["killers"]) for _, r in results)
    columns = ["room", "fault", "caught by"] + ["tests"] * full + ["seconds"]
    lines = [f"{reports.stamp({**head, 'faults': len(results) - killed})}.", "",
             f"{len(results)} faults, each put into limn alone: the suite notices {killed} of them. Named is the first "
             "test that failed; the seconds include building. Together they took "
             f"{sum(r['seconds'] for _, r in results) / 60:.0f} minutes.", "",
             f"| {' | '.join(columns)} |", "|" + "---|" * (3 + full) + "---:|"]
    for mutant, r in results:
        cells = [mutant.room, mutant.fault, r["killers"][0].replace("|", "\\|") if r["killers"] else "**nothing**"]
        cells += [str(len(r["killers"]))] * full + [f"{r['seconds']:.0f}"]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def summary(results, broken):
    print(f"\n{'room':10}{'mutants':>8}{'killed':>8}")
    for room in dict.fromkeys(m.room for m, _ in results):
        of_room = [bool(r["killers"]) for m, r in results if m.room == room]
        print(f"{room:10}{len(of_room):8}{sum(of_room):8}")
    survivors = [m.name for m, r in results if not r["killers"]]
    for what, names in (("survived", survivors), ("broken", broken)):
        if names:
            print(f"{what}: {', '.join(names)}")
    return 1 if survivors or broken else 0


def kill(mutants, full, kept):
    """Tries the mutants and adds what is found to `kept`; returns the names of those that could not be tried."""
    broken = []
    print("building and testing without a fault ...", flush=True)
    prepare(mutants, full)
    for number, mutant in enumerate(mutants, 1):
        begin = time.monotonic()
        print(f"[{number:3}/{len(mutants)}] {mutant.name:48} ", end="", flush=True)
        try:
            tests = killers(mutant, full)
        except PatchError as error:
            broken.append(mutant.name)
            print(f"ERROR: {error}")
            continue
        seconds = time.monotonic() - begin
        print(f"{seconds:6.1f} s  " + (f'KILLED by "{tests[0]}"' if tests else "SURVIVED"), flush=True)
        kept[mutant.name] = {"mark": mark(mutant, tests, full), "killers": tests, "seconds": round(seconds, 1)}
        save_kept(kept)
    return broken


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="only these mutants")
    parser.add_argument("--full", action="store_true", help="the whole suite for each, to list every test that kills it")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))
    mutants = load_mutants()
    unknown = set(arguments.names) - {m.name for m in mutants}
    if unknown:
        raise PatchError("unknown: " + ", ".join(sorted(unknown)))
    head = reports.origin("mutants", "./build.sh mutants" + " --full" * arguments.full)
    WORK.mkdir(parents=True, exist_ok=True)
    kept = load_kept(mutants, arguments.full)
    missing = [m for m in mutants if (m.name in arguments.names if arguments.names else m.name not in kept)]
    if len(mutants) > len(missing):
        print(f"{len(missing)} of {len(mutants)} mutants to try")
    broken = kill(missing, arguments.full, kept) if missing else []
    results = [(m, kept[m.name]) for m in (missing if arguments.names else mutants) if m.name in kept]
    status = summary(results, broken)
    if not arguments.names and not broken:
        reports.write("mutants", report(head, results, arguments.full))
    return status


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (PatchError, OSError) as problem:
        sys.exit(f"mutants: {problem}")
    except KeyboardInterrupt:
        sys.exit(130)
