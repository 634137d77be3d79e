"""Instructions a ray, by callgrind, in builds of limn without one feature each: copies of the sources out of which the
patches in apps/bench/without take it.

Valgrind knows no AVX-512, so that it counts the code for AVX2; what this processor runs is timed, the two programs by
turns.
"""

import json
import re
import shutil
import statistics
import subprocess
import sys

import patches
from machine import ROOT

FUNCTION = re.compile(r"^\s*([\d,]+) .*?[:\s]measure_(\w+)(?:\s|$)")


def build(source, tree):
    steps = [["cmake", "-S", source, "-B", tree, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
              "-DLIMN_BUILD_TESTS=OFF", "-DLIMN_BUILD_EXAMPLES=OFF", "-DLIMN_WITH_OPENIMAGEIO=OFF",
              *(["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] * bool(shutil.which("ccache")))],
             ["cmake", "--build", tree, "--target", "limn_count_instructions"]]
    for step in steps:
        run = subprocess.run(step, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if run.returncode != 0:
            sys.exit(f"bench: {' '.join(map(str, step))}:\n{run.stdout}")
    return tree / "bin/limn_count_instructions"


def build_without_features(folder, say):
    """A program for each feature, by its name."""
    source, programs = folder / "without/source", {}
    patches.copy_tree(source)
    for patch in patches.load(ROOT / "apps/bench/without"):
        feature = patch.name.replace("_", " ")
        say(f"building without {feature}")
        with patch.applied(source):
            programs[feature] = build(source, folder / "without" / patch.name)
    return programs


def count(program, folder, rays, *options):
    """Instructions a ray of each function of the program."""
    out = folder / "callgrind.out"
    command = ["valgrind", "-q", "--tool=callgrind", "--toggle-collect=measure_*", f"--callgrind-out-file={out}",
               program, "--rays", str(rays), *options]
    run = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if run.returncode != 0:
        sys.exit(f"bench: callgrind ended with status {run.returncode}")
    traced = json.loads(run.stdout)["rays"]
    listing = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", "--auto=no", out],
                             stdout=subprocess.PIPE, text=True, check=True).stdout
    counts = {}
    for line in listing.splitlines():
        if match := FUNCTION.match(line):
            name = match[2]
            counts[name] = int(match[1].replace(",", "")) / traced[name.split("_")[0]]
    return counts


def times(program, rays, rounds, *options):
    run = subprocess.run([program, "--rays", str(rays), "--rounds", str(rounds), *options],
                         stdout=subprocess.PIPE, text=True, check=True)
    return {name: statistics.median(values) for name, values in json.loads(run.stdout).items() if name != "rays"}


def time_by_turns(first, second, rays, turns):
    """Time of `first` over that of `second`, two (program, options...) each, for each function: one ratio a turn."""
    ratios = {}
    for _ in range(turns):
        a, b = (times(program, rays, 3, *options) for program, *options in (first, second))
        for name in a:
            if name in b:
                ratios.setdefault(name, []).append(a[name] / b[name])
    return ratios


def measure(folder, programs, full, say):
    rays, turns = (8000, 15) if full else (2000, 9)
    timed = 10 * rays
    program = programs / "limn_count_instructions"
    say("counting instructions")
    whole = count(program, folder, rays)
    result = {"whole": whole, "without": {},
              "user_defined": {"counts": count(program, folder, rays, "--user-defined"),
                          "times": time_by_turns((program, "--user-defined"), (program,), timed, turns)}}
    for feature, lean in build_without_features(folder, say).items():
        result["without"][feature] = {"counts": count(lean, folder, rays),
                                      "times": time_by_turns((program,), (lean,), timed, turns)}
    return result
