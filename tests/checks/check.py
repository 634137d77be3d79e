"""Builds limn otherwise than usual and runs the suite there.

    check.py [compilers [--quick|--aarch64]] [asan] [tsan] [memcheck]

    compilers              the suite under g++ 12, clang 14 and clang 19, and its digests on each instruction set; the
                           digests alone without optimisation, for this processor, and with link-time optimisation
    compilers --aarch64    the same, and limn::core cross-built for AArch64, in qemu
    compilers --quick      clang 19 on limn::core with the digests, the hard cases and the compiled scenes
    asan                   AddressSanitizer with leaks, and UndefinedBehaviorSanitizer
    tsan                   ThreadSanitizer, with a oneTBB that is instrumented, too
    memcheck               valgrind on AVX2 and on one lane, with few cases of each property

Without a word all four run. The exit status is 0 if every test passes, nothing is reported, and all digests are the
same.
"""

import argparse
import hashlib
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "apps/bench"))
from results import Kept, origin, table, write  # noqa: E402

WORK = ROOT / "build/check"
COMPILERS = ("g++", "clang++-14", "clang++-19")
TARGETS = ("SCALAR", "EMU128", "SSE4", "AVX2", "AVX3", "NEON")
# Of these builds the digests alone are compared.
OTHER_BUILDS = (("g++", "-O0"), ("g++", "-O3 -march=native"), ("g++", "-O3 -march=native -flto=auto"),
                ("clang++-19", "-O0"), ("clang++-19", "-O3 -march=native"))
CORE = ("test_digest", "test_flat", "test_hard")  # programs whose code differs by instruction set
REPORT = re.compile(r"ERROR: (?:Address|Leak)Sanitizer|WARNING: ThreadSanitizer|runtime error:|"
                    r"==\d+== (?:Invalid|Conditional|Use of|Syscall param|Mismatched|Source and destination)")
# Valgrind is some 40 times slower, computes long double in 64 bits, and knows no AVX-512. These programs cover the
# kernels' reads and writes, and files; the cases whose truth is of long double are left out.
MEMCHECK = {
    "test_math": "~Elementary: all functions*", "test_geometry": "~[large]", "test_flat": "~[large]",
    "test_digest": "Digest: scenes of some kinds*", "test_image": "", "test_io": "~[large]~[.writer]",
    "test_material": "~Dielectric: the cosine of the refracted*", "test_shape": "", "test_texture": "",
    "test_render": "[lobes],[determinism],[film],Sobol*,Light choice*"}


def say(text):
    print(f"check: {text}", file=sys.stderr, flush=True)


def build(folder, *options, targets=()):
    say(f"building {folder.relative_to(ROOT)}")
    log = folder.with_suffix(".log")
    log.parent.mkdir(parents=True, exist_ok=True)
    for command in (["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DLIMN_BUILD_TESTS=ON",
                     "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache", *options],
                    ["cmake", "--build", folder, *(["--target", *targets] if targets else [])]):
        with log.open("w") as out:
            if subprocess.run(command, stdout=out, stderr=subprocess.STDOUT, cwd=ROOT).returncode != 0:
                print("\n".join(log.read_text(errors="replace").splitlines()[-40:]), file=sys.stderr)
                sys.exit(f"check: {' '.join(map(str, command))} failed; all it printed is in {log}")
    return folder


def suite(folder, room=None, preset=None):
    """Runs the tests of a room, or all. Returns how many there are, and the output of those that failed."""
    results = folder / "results.xml"
    results.unlink(missing_ok=True)
    where = ["--preset", preset] if preset else ["--test-dir", folder, "-j", str(os.cpu_count()), "--timeout", "3600"]
    which = ["-R", f"^{re.escape(room)}:" if room else "^[^:]*$"] if room is not None else []
    subprocess.run(["ctest", *where, *which, "--output-junit", results], cwd=ROOT, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    cases = [case for case in ET.parse(results).getroot().iter("testcase")
             if case.find("skipped") is None or not case.find("skipped").get("message", "").startswith("SKIP_")]
    return {"tests": len(cases), "failed": {case.get("name"): case.findtext("system-out", "") for case in cases
                                            if case.get("status") != "run"}}


def programs(folder, names, target=None, emulator=()):
    """Runs test programs. Returns the same as `suite`, and their digests; None if the instruction set isn't there."""
    failed, digests = {}, []
    environment = {**os.environ, **({"LIMN_TEST_TARGET": target} if target else {})}
    for name in names:
        done = subprocess.run([*emulator, folder / "bin" / name, *(["-s"] if name == "test_digest" else [])],
                              capture_output=True, text=True, env=environment)
        if "LIMN_TEST_TARGET: " in done.stderr:
            return None
        digests += re.findall(r'"([0-9a-f]{16})" == ', done.stdout)
        if done.returncode != 0:
            failed[name] = done.stdout[-6000:] + done.stderr[-6000:]
    digest = hashlib.sha256(" ".join(sorted(digests)).encode()).hexdigest()[:12] if digests else "none"
    return {"tests": len(names), "failed": failed, "digest": digest}


def on_each_target(folder, names, emulator=()):
    """Adds the digests, and the programs that fail, of each instruction set."""
    row = {"tests": 0, "failed": {}, "digests": {}}
    for target in TARGETS:
        if found := programs(folder, names, target, emulator):
            row["digests"][target] = found["digest"]
            row["tests"] += found["tests"]
            row["failed"].update({f"{name} on {target}": text for name, text in found["failed"].items()})
    return row


def compiler_build(compiler, flags):
    folder = WORK / f"{compiler}{flags}".replace(" ", "")
    kind = [f"-DCMAKE_CXX_COMPILER={compiler}", f"-DCMAKE_BUILD_TYPE={'None' if flags else 'Release'}"]
    build(folder, *kind, f"-DCMAKE_CXX_FLAGS={flags}", targets=["test_digest"] if flags else ())
    if flags:
        return on_each_target(folder, ["test_digest"])
    row = on_each_target(folder, [*CORE, "test_render"] if compiler == "g++" else ["test_digest"])
    whole = suite(folder)
    return {**row, "tests": row["tests"] + whole["tests"], "failed": {**row["failed"], **whole["failed"]}}


def aarch64():
    off = [f"-DLIMN_{part}=OFF" for part in ("WITH_OPENIMAGEIO", "BUILD_APPS", "BUILD_EXAMPLES", "INSTALL")]
    folder = build(WORK / "aarch64", "--toolchain", HERE / "aarch64.cmake", "-DCMAKE_BUILD_TYPE=Release", *off,
                   targets=CORE)
    return on_each_target(folder, CORE, emulator=["qemu-aarch64"])


def sanitized(kind):
    """Yields the name of each room and what its tests said under asan or tsan."""
    options = ["--preset", kind]
    if kind == "tsan":
        log, installed = WORK / "tsan-tbb.log", WORK / "tsan-tbb/installed"
        if not any(installed.glob("lib*/cmake/TBB/TBBConfig.cmake")):
            say("building oneTBB with ThreadSanitizer")
            WORK.mkdir(parents=True, exist_ok=True)
            subprocess.run([HERE / "instrumented_tbb.sh", installed.parent], stdout=log.open("w"),
                           stderr=subprocess.STDOUT, check=True)
        config = next(installed.glob("lib*/cmake/TBB/TBBConfig.cmake"))
        options.append(f"-DTBB_DIR={config.parent}")
        os.environ["LD_LIBRARY_PATH"] = str(config.parents[2])  # for programs that the tests build
    folder = build(ROOT / "build" / kind, *options)
    listed = subprocess.run(["ctest", "--test-dir", folder, "-N"], capture_output=True, text=True).stdout
    names = re.findall(r"^ *Test +#\d+: (.*)$", listed, re.MULTILINE)
    for room in dict.fromkeys(name.partition(":")[0] if ":" in name else "" for name in names):
        yield room or "others", lambda room=room: suite(folder, room, preset=kind)


def memchecked():
    """Yields each program of MEMCHECK on each instruction set."""
    folder = build(WORK / "memcheck", "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O1 -g",
                   "-DLIMN_DISABLED_TARGETS=HWY_SSSE3|HWY_SSE4|HWY_AVX3|HWY_AVX3_DL", targets=MEMCHECK)
    valgrind = ["valgrind", "-q", "--error-exitcode=97", "--leak-check=full", "--errors-for-leak-kinds=definite",
                "--show-leak-kinds=definite", f"--suppressions={HERE / 'memcheck.supp'}", "--num-callers=30"]

    def run(program, cases, target):
        environment = {**os.environ, "LIMN_TEST_TARGET": target, "RC_PARAMS": "seed=20260101 max_success=5"}
        done = subprocess.run([*valgrind, folder / "bin" / program, "-w", "NoTests", *([cases] if cases else [])],
                              capture_output=True, text=True, env=environment)
        said = done.stdout + done.stderr
        counted = re.search(r"All tests passed \(\d+ assertions? in (\d+)|test cases: *(\d+)", said)
        return {"tests": int(counted[1] or counted[2]) if counted else 0,
                "failed": {} if done.returncode == 0 and counted else {program: said}}

    for program, cases in MEMCHECK.items():
        for target in ("AVX2", "SCALAR"):
            yield f"{program} on {target}", lambda p=program, c=cases, t=target: run(p, c, t)


def parts(kind, arguments):
    """Yields the name of each part of a kind of check, and a function that runs it."""
    if kind == "compilers":
        for compiler, flags in [(compiler, "") for compiler in COMPILERS] + list(OTHER_BUILDS):
            yield f"{compiler} {flags or '-O3'}", lambda c=compiler, f=flags: compiler_build(c, f)
        if arguments.aarch64:
            yield "AArch64", aarch64
    else:
        yield from memchecked() if kind == "memcheck" else sanitized(kind)


def quick():
    folder = build(WORK / "quick", f"-DCMAKE_CXX_COMPILER={COMPILERS[-1]}", "-DCMAKE_BUILD_TYPE=Release",
                   "-DLIMN_WARNINGS_AS_ERRORS=ON", targets=CORE)
    failed = programs(folder, CORE)["failed"]
    for name in CORE:
        say(f"clang 19, {name}: {'FAILED' if name in failed else 'passed'}")
    print("\n".join(failed.values()))
    return 1 if failed else 0


def check(kind, arguments):
    """Runs a kind of check and writes its page. Returns whether something failed."""
    kept, rows = Kept(f"check-{kind}", **origin(kind)), {}
    for name, run in parts(kind, arguments):
        rows[name] = row = kept(name, run)
        for test, output in row["failed"].items():
            say(f"{name}, {test}: {len(REPORT.findall(output))} reports\n{output[-6000:]}")
        say(f"{kind}, {name}: {row['tests']} tests, {len(row['failed'])} failed {row.get('digests', '')}")
    digests = {digest for row in rows.values() for digest in row.get("digests", {}).values()}
    lines = [[name, row["tests"], len(row["failed"]), " ".join(sorted(set(row.get("digests", {}).values()))),
              " ".join(row.get("digests", {}))] for name, row in rows.items()]
    write(f"check-{kind}", f"The suite under {kind}", origin(f"./build.sh check {kind}"), rows,
          table(["build", "tests", "failed", "digests", "on"], lines))
    kept.forget()
    return any(row["failed"] for row in rows.values()) or len(digests) > 1 or (kind == "compilers" and not digests)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kinds", nargs="*", metavar="compilers|asan|tsan|memcheck")
    parser.add_argument("--quick", action="store_true", help="clang 19 alone, in minutes")
    parser.add_argument("--aarch64", action="store_true", help="limn::core for AArch64, too")
    arguments = parser.parse_args()
    kinds = ("compilers", "asan", "tsan", "memcheck")
    if unknown := set(arguments.kinds) - set(kinds):
        parser.error(f"{', '.join(unknown)}: must be of {', '.join(kinds)}")
    if arguments.quick:
        return quick()
    return 1 if any([check(kind, arguments) for kind in arguments.kinds or kinds]) else 0


if __name__ == "__main__":
    sys.exit(main())
