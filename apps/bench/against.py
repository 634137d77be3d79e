"""Measures this tree's scenes with its own library and with another commit's. A ratio over 1: this tree is faster."""

import re
import subprocess
import sys
from statistics import geometric_mean, median

from results import ROOT, git, origin, quartiles, spread, table, write

FOLDERS = ("apps", "apps/common", "examples/figures", "examples/gallery")
SOURCES = [ROOT / f"apps/bench/{name}.cpp" for name in ("against", "rays", "scenes", "transport_scenes")]
SOURCES += [path for folder in FOLDERS[2:] for path in (ROOT / folder).glob("*.cpp")
            if path.stem not in ("main", "figure_program")]
CALLGRIND = "valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=measured_render".split()


def run(*command, check=True):
    """Returns the finished process. Ends this program if the command fails and `check` is true."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if check and done.returncode != 0:
        sys.exit(f"against: {' '.join(map(str, command))}:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done


def build(source, folder):
    """Builds this tree's program with the library of `source`. Returns its path and the files that don't compile."""
    run("cmake", "-S", source, "-B", folder / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DLIMN_INSTALL=ON",
        "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache", f"-DCMAKE_INSTALL_PREFIX={folder}/installed",
        *(f"-DLIMN_{part}=OFF" for part in ("WITH_OPENIMAGEIO", "BUILD_APPS", "BUILD_EXAMPLES", "BUILD_TESTS")))
    run("cmake", "--build", folder / "build", "--target", "install")
    package = next((folder / "installed").glob("lib/**/limn.pc"))
    compiler = ["ccache", "g++", "-O3", "-no-pie", "-ffp-contract=off", *(f"-I{ROOT / f}" for f in FOLDERS),
                f'-DLIMN_FIGURE_DATA_DIR="{ROOT}/examples/figures/data"',
                f'-DLIMN_GALLERY_MODELS="{ROOT}/examples/models"',
                *run("pkg-config", "--cflags", package).stdout.split()]
    failed = [path.name for path in SOURCES
              if run(*compiler, "-c", path, "-o", folder / f"{path.name}.o", check=False).returncode != 0]
    # Link those that compile. The program ends with an error if it makes a scene of another one.
    run(*compiler, "-o", folder / "against", *(folder / f"{p.name}.o" for p in SOURCES if p.name not in failed),
        *run("pkg-config", "--libs", package).stdout.split(), "-Wl,--unresolved-symbols=ignore-all,-z,lazy")
    return folder / "against", failed


def numbers(program, what, name, spp):
    """Returns the times or the count by name, or nothing if the program can't make the scene."""
    print(f"against: {what} of {name}", file=sys.stderr, flush=True)
    done = run(*(CALLGRIND if what == "instructions" else ()), program, what, name, spp, check=False)
    if what == "instructions" and done.returncode == 0:
        return {what: int(re.search(r"Collected : (\d+)", done.stderr)[1])}
    return {key: float(value) for key, value in map(str.split, done.stdout.splitlines())} if not done.returncode else {}


def measure(programs, kind, name):
    """Returns for each time or count the list of its ratios, one for each round."""
    ratios, spp = {}, max(4, round(1.6 / numbers(programs[0], kind, name, 4).get("samples", 1)))  # about 0.4 s
    for what, count in [(kind, spp)] * 9 + [("instructions", 4)] * (kind == "samples"):
        ours, theirs = (numbers(program, what, name, count) for program in programs)
        for key in ours.keys() & theirs.keys():
            ratios.setdefault(key, []).append(theirs[key] / ours[key])
    return ratios


def main():
    commit = git("rev-parse", "--verify", "-q", "--short=8", f"{''.join(sys.argv[1:2])}^{{commit}}") or sys.exit(
        "usage: ./build.sh against COMMIT [SCENE ...]; COMMIT must be one of this repository")
    head, there = origin(" ".join(["./build.sh against", commit, *sys.argv[2:]])), ROOT / "build/against" / commit
    if not (there / "source").exists():
        run("git", "-C", ROOT, "worktree", "add", "--force", "--detach", there / "source", commit)
    programs, failed = zip(build(ROOT, ROOT / "build/against/this"), build(there / "source", there))
    known = [line.split() for line in run(programs[0]).stdout.splitlines()]
    names = dict.fromkeys(name for _, name in known)
    if unknown := [name for name in sys.argv[2:] if name not in names]:
        sys.exit(f"against: there is no scene {', '.join(unknown)}; there are {', '.join(names)}")
    chosen = [(kind, name) for kind, name in known if name in (sys.argv[2:] or names)]
    found = {f"{name}, {kind}": measure(programs, kind, name) for kind, name in chosen}
    rows = [[name, what, spread(quartiles(each[what]), 3)] for name, each in found.items() for what in sorted(each)]
    for kind in sorted({what.rpartition(",")[2] for each in found.values() for what in each}):
        medians = [median(ratios) for each in found.values() for what, ratios in each.items() if what.endswith(kind)]
        rows.append(["geometric mean", kind, f"{geometric_mean(medians):.3f}"])
    left_out = ", ".join(sorted({*failed[0], *failed[1], *(n for n, each in found.items() if not each)})) or "nothing"
    print(text := table(["scene", "what", "ratio"], rows) + f"\nCan't be built by both: {left_out}.")
    write("against", f"This tree against {commit}", head, found, text)


if __name__ == "__main__":
    main()
