#!/usr/bin/env python3
"""The suite under a sanitizer: sanitize.py asan|tsan|memcheck. Writes docs/checks.md.

    asan      AddressSanitizer, leaks included, and UndefinedBehaviorSanitizer
    tsan      ThreadSanitizer, with a oneTBB that is instrumented, too: Debian's source package, built so
    memcheck  valgrind, on AVX2 and SCALAR, which it knows; the rooms and cases of MEMCHECK

Of the kernels, asan and tsan run SCALAR, AVX2 and AVX3: SSE4 is AVX2's code with fewer lanes. Goes on where it was
interrupted. Exit status 0 only where every test passed and nothing was reported.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import suite
from suite import ROOT, logged, reports, say

REPORT = re.compile(r"ERROR: (?:Address|Leak)Sanitizer|WARNING: ThreadSanitizer|runtime error:|"
                    r"==\d+== (?:Invalid|Conditional|Use of|Syscall param|Mismatched|Source and destination)")

# Valgrind is some 40 times slower, computes long double in 64 bits, and knows no AVX-512: what the kernels read and
# write, and files, with few cases of each property.
MEMCHECK = {
    "test_core": "~Elementary: all functions*",  # whose truth is of long double
    "test_accel": "~[large]",
    "test_compile": "~[large]",
    "test_digest": "Digest: scenes of some kinds*",
    "test_image": "",
    "test_io": "~[large]~[.writer]",  # which is no test of its own
    "test_material": "~Dielectric: the cosine of the refracted*",  # whose truth is of long double
    "test_render": "[lobes],[determinism],[film],Sobol*,Light choice*",
    "test_shape": "",
    "test_texture": "",
}


def instrumented_tbb():
    """Where CMake finds a oneTBB that ThreadSanitizer sees into; built the first time."""
    folder = ROOT / "build/tsan-tbb"
    config = next(folder.glob("installed/lib*/cmake/TBB/TBBConfig.cmake"), None)
    if config is None:
        say("building oneTBB with ThreadSanitizer")
        logged([Path(__file__).parent / "instrumented_tbb.sh", folder], ROOT / "build/tsan-tbb.log")
        config = next(folder.glob("installed/lib*/cmake/TBB/TBBConfig.cmake"))
    return config.parent


def sanitized(kind):
    """Builds with the preset; yields for each room what its tests said."""
    folder = ROOT / "build" / kind
    options = []
    if kind == "tsan":
        config = instrumented_tbb()
        options = [f"-DTBB_DIR={config}"]
        os.environ["LD_LIBRARY_PATH"] = str(config.parents[1])  # for the programs of the consumers' tests
    suite.build(folder, ["--preset", kind, *options])
    for room in suite.rooms(folder):
        yield room or "others", lambda room=room: suite.run(folder, room, preset=kind)


def memchecked():
    folder = ROOT / "build/memcheck"
    suite.build(folder, ["-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O1 -g",
                         "-DLIMN_DISABLED_TARGETS=HWY_SSSE3|HWY_SSE4|HWY_AVX3|HWY_AVX3_DL"], MEMCHECK)

    def run(program, cases, target):
        done = subprocess.run(
            ["valgrind", "-q", "--error-exitcode=97", "--leak-check=full", "--errors-for-leak-kinds=definite",
             "--show-leak-kinds=definite", f"--suppressions={Path(__file__).parent / 'memcheck.supp'}",
             "--num-callers=30",
             folder / "bin" / program, "-w", "NoTests", *([cases] if cases else [])],
            capture_output=True, text=True, env={**os.environ, "LIMN_TEST_TARGET": target,
                                                 "RC_PARAMS": "seed=20260101 max_success=5"})
        said = done.stdout + done.stderr
        counted = re.search(r"All tests passed \(\d+ assertions? in (\d+)|test cases: *(\d+)", said)
        return {"tests": int(counted[1] or counted[2]) if counted else 0,
                "failed": {program: said} if done.returncode != 0 or not counted else {}}

    # What has one lane is called so by g++ 12, and EMU128 elsewhere.
    probe = subprocess.run([folder / "bin/test_image", "--list-tags"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                           env={**os.environ, "LIMN_TEST_TARGET": "SCALAR"})
    targets = ("AVX2", "EMU128" if probe.returncode == 4 else "SCALAR")
    for program, cases in MEMCHECK.items():
        for target in targets:
            yield f"{program} on {target}", lambda p=program, c=cases, t=target: run(p, c, t)


def main():
    if len(sys.argv) != 2 or sys.argv[1] not in ("asan", "tsan", "memcheck"):
        sys.exit(__doc__)
    kind = sys.argv[1]
    head = reports.origin(kind)
    kept = reports.Kept(ROOT / f"build/{kind}.json", sources=head["sources"])
    head = kept("head", lambda: head)
    rows, said = {}, 0
    for name, run in memchecked() if kind == "memcheck" else sanitized(kind):
        rows[name] = row = kept(name, run, lambda row: not row["failed"])
        for case, output in row["failed"].items():
            count = len(REPORT.findall(output))
            said += count
            say(f"{kind}: {case}: {count} reports\n{output[-6000:]}")
        say(f"{kind}: {name}: {row['tests']} tests, {len(row['failed'])} failed")
    failed = sum(len(row["failed"]) for row in rows.values())
    head["faults"] = failed
    tests = sum(row["tests"] for row in rows.values())
    lines = [f"{reports.stamp(head)}, {kept.minutes():.0f} minutes.", "",
             f"{tests} tests, {failed} failed, {said} reports.", "", "| | tests | failed |", "|---|---:|---:|"]
    lines += [f"| {name} | {row['tests']} | {len(row['failed'])} |" for name, row in rows.items()]
    reports.write(kind, "\n".join(lines))
    if not failed:
        kept.forget()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
