#!/usr/bin/env python3
"""Are the results the same bits, whichever compiler and instruction set? Writes docs/checks.md.

    compilers.py          the whole suite under g++ 12, clang 14 and clang 19, its digests on each instruction set; the
                          digests without optimisation, for this processor alone, and with link-time optimisation
    compilers.py --aarch64  the same, and limn::core cross-built for AArch64: digests, hard cases and compiled scenes in qemu
    compilers.py --quick  clang 19, the digests, hard cases and compiled scenes alone; writes nothing

Goes on where it was interrupted. Exit status 0 only where all passed and all digests are the same.
"""

import argparse
import hashlib
import os
import re
import subprocess
import sys

import suite
from suite import ROOT, reports, say

COMPILERS = ("g++", "clang++-14", "clang++-19")
TARGETS = ("SCALAR", "EMU128", "SSE4", "AVX2", "AVX3", "NEON")
# Of these the digests alone.
OTHER_BUILDS = (("g++", "-O0"), ("g++", "-O3 -march=native"), ("g++", "-O3 -march=native -flto=auto"),
                ("clang++-19", "-O0"), ("clang++-19", "-O3 -march=native"))
PROGRAMS = ("test_compile", "test_hard", "test_render")  # that differ by instruction set, beside the digests
QUICK = ("test_digest", "test_compile", "test_hard")


def version(compiler):
    """As people write it: g++ 12.2.0."""
    number = subprocess.run([compiler, "-dumpfullversion", "-dumpversion"], capture_output=True, text=True).stdout
    return f"{'g++' if compiler.endswith('g++') else compiler.partition('-')[0]} {number.split()[0]}"


def digests(folder, programs=(), emulator=()):
    """For each instruction set that is there: the digests of test_digest as one; whether it and the programs passed."""
    found = {}
    for target in TARGETS:
        done = subprocess.run([*emulator, folder / "bin/test_digest", "-s"], capture_output=True, text=True,
                              env={**os.environ, "LIMN_TEST_TARGET": target})
        if done.returncode == 4:  # not built, or not on this processor
            continue
        every = sorted(re.findall(r'"([0-9a-f]{16})" == ', done.stdout))  # with -flto the cases come in another order
        short = hashlib.sha256(" ".join(every).encode()).hexdigest()[:12] if every else "none"
        others = [program for program in programs
                  if subprocess.run([folder / "bin" / program], stdout=subprocess.DEVNULL,
                                    env={**os.environ, "LIMN_TEST_TARGET": target}).returncode != 0]
        found[target] = {"digest": short, "count": len(every), "passed": done.returncode == 0 and not others}
    return found


def build(compiler, targets=()):
    """The folder of the release preset's build by a compiler."""
    folder = ROOT / "build" / ("release" if compiler == COMPILERS[0] else f"compilers/{compiler}")
    # The first is what CMake takes by itself; naming it would begin the usual build anew.
    chosen = [] if compiler == COMPILERS[0] else [f"-DCMAKE_CXX_COMPILER={compiler}"]
    suite.build(folder, ["--preset", "release", "-DLIMN_BUILD_TESTS=ON", *chosen, "-B", folder], targets)
    return folder


def whole_suite(compiler):
    folder = build(compiler)
    say(f"{compiler}: the suite")
    return {**suite.run(folder), "digests": digests(folder, PROGRAMS if compiler == COMPILERS[0] else ())}


def digests_alone(compiler, flags):
    folder = ROOT / "build/compilers" / f"{compiler}{flags}".replace(" ", "")
    suite.build(folder, ["-B", folder, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_BUILD_TYPE=None",
                         f"-DCMAKE_CXX_FLAGS={flags}"], ["test_digest"])
    return {"digests": digests(folder)}


def aarch64():
    folder = ROOT / "build/compilers/aarch64"
    without = [f"-D{option}=OFF" for option in ("LIMN_WITH_OPENIMAGEIO", "LIMN_BUILD_APPS", "LIMN_BUILD_EXAMPLES",
                                                "LIMN_INSTALL")]
    suite.build(folder, ["-B", folder, "-G", "Ninja", "--toolchain", ROOT / "tests/checks/aarch64.cmake",
                         "-DCMAKE_BUILD_TYPE=Release", "-DLIMN_BUILD_TESTS=ON", *without], QUICK)
    say("AArch64: hard cases and compiled scenes")
    hard, compiled = suite.run(folder, "hard"), suite.run(folder, "compile")
    return {"tests": hard["tests"] + compiled["tests"], "failed": {**hard["failed"], **compiled["failed"]},
            "digests": digests(folder, emulator=["qemu-aarch64"])}


def quick():
    """The exit status of the programs of QUICK, built by the last of the compilers."""
    compiler = COMPILERS[-1]
    folder = build(compiler, QUICK)
    failed = 0
    for program in QUICK:
        status = subprocess.run([folder / "bin" / program]).returncode
        say(f"{version(compiler)}, {program}: {'passed' if status == 0 else 'FAILED'}")
        failed += status != 0
    return 1 if failed else 0


def faults(rows):
    """What is not as it must be."""
    wrong = [f"{name}: {case}" for name, row in rows.items() for case in row.get("failed", {})]
    wrong += [f"{name}: digests on {target}" for name, row in rows.items() for target, d in row["digests"].items()
              if not d["passed"]]
    wrong += [f"{name}: no digests" for name, row in rows.items() if not row["digests"]]
    different = {d["digest"] for row in rows.values() for d in row["digests"].values()}
    return wrong + ([] if len(different) <= 1 else [f"{len(different)} digests, not one"])


def table(rows):
    lines = ["| compiler | suite | digests | on |", "|---|---|---|---|"]
    for name, row in rows.items():
        tests = f"{row['tests'] - len(row['failed'])} of {row['tests']} passed" if "tests" in row else "digests alone"
        different = sorted({d["digest"] for d in row["digests"].values()})
        lines.append(f"| {name} | {tests} | {' '.join(different)} | {' '.join(row['digests'])} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="clang 19 alone, the exactness suite alone; no report")
    parser.add_argument("--aarch64", action="store_true", help="also limn::core for AArch64")
    arguments = parser.parse_args()
    if arguments.quick:
        return quick()
    head = reports.origin("compilers", "./build.sh compilers" + (" --aarch64" if arguments.aarch64 else ""))
    kept = reports.Kept(ROOT / "build/compilers/kept.json", sources=head["sources"], aarch64=arguments.aarch64)
    head = kept("head", lambda: head)
    rows = {}
    for compiler in COMPILERS:
        rows[f"{version(compiler)}, -O3"] = kept(compiler, lambda: whole_suite(compiler),
                                                 lambda row: not row["failed"])
    for compiler, flags in OTHER_BUILDS:
        rows[f"{version(compiler)}, {flags}"] = kept(compiler + flags, lambda: digests_alone(compiler, flags),
                                                     lambda row: all(d["passed"] for d in row["digests"].values()))
    if arguments.aarch64:
        rows[f"{version('aarch64-linux-gnu-g++')}, AArch64 in qemu"] = kept("aarch64", aarch64, lambda row: not row["failed"])
    wrong = faults(rows)
    head["faults"] = len(wrong)
    count = max((d["count"] for row in rows.values() for d in row["digests"].values()), default=0)
    text = (f"{reports.stamp(head)}, {kept.minutes():.0f} minutes.\n\n{table(rows)}\n\n"
            f"`test_digest` checks {count} digests: of hits and surfaces on fixed rays, traced alone and in batches, of "
            "pictures, and of the elementary functions. A row shows the digest of these; one value means that all of "
            "its instruction sets agree.")
    if wrong:
        text += "\n\n" + "\n".join(f"- wrong: {w}" for w in wrong)
    reports.write("compilers", text)
    if not wrong:
        kept.forget()
    for fault in wrong:
        say(f"compilers: {fault}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
