"""Compares the speed of this tree with another commit: samples, rays and instructions of each scene.

Builds the scenes of this tree with the libraries of both. A ratio over 1 says that this tree is faster. It is the
median of nine rounds in which both take turns."""

import re
import subprocess
import sys
from statistics import geometric_mean, quantiles

from results import ROOT, git, origin, table, write

FOLDERS = ("apps", "apps/common", "examples/figures", "examples/gallery")
SOURCES = [ROOT / f"apps/bench/{name}.cpp" for name in ("against", "rays", "scenes", "transport_scenes")]
SOURCES += [path for folder in FOLDERS[2:] for path in (ROOT / folder).glob("*.cpp")
            if path.stem not in ("main", "figure_program")]
CALLGRIND = "valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=measured_render".split()


def run(*command, check=True):
    """Runs a command and returns its output. Ends the program if the command fails and `check` is true."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if check and done.returncode != 0:
        sys.exit(f"against: {' '.join(map(str, command))}:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done


def build(source, folder):
    """Builds the program of this tree with the library of `source`. Returns its path and the source files that can't be
    compiled with that library."""
    # Build and install the library.
    run("cmake", "-S", source, "-B", folder / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DLIMN_INSTALL=ON",
        "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache", f"-DCMAKE_INSTALL_PREFIX={folder}/installed",
        *(f"-DLIMN_{part}=OFF" for part in ("WITH_OPENIMAGEIO", "BUILD_APPS", "BUILD_EXAMPLES", "BUILD_TESTS")))
    run("cmake", "--build", folder / "build", "--target", "install")
    # Compile this tree's source files.
    package = next((folder / "installed").glob("lib/**/limn.pc"))
    compiler = ["ccache", "g++", "-O3", "-no-pie", "-ffp-contract=off", *(f"-I{ROOT / f}" for f in FOLDERS),
                f'-DLIMN_FIGURE_DATA_DIR="{ROOT}/examples/figures/data"',
                f'-DLIMN_GALLERY_MODELS="{ROOT}/examples/models"',
                *run("pkg-config", "--cflags", package).stdout.split()]
    failed = [path.name for path in SOURCES
              if run(*compiler, "-c", path, "-o", folder / f"{path.name}.o", check=False).returncode != 0]
    # Link those that compile. The program ends with an error if it makes a scene of another one.
    run(*compiler, *(folder / f"{path.name}.o" for path in SOURCES if path.name not in failed),
        *run("pkg-config", "--libs", package).stdout.split(), "-Wl,--unresolved-symbols=ignore-all,-z,lazy",
        "-o", folder / "against")
    return folder / "against", failed


def numbers(program, what, name, spp):
    """Returns the times that the program prints, or the instructions that callgrind counts, as a dict. The dict is
    empty if the program can't make the scene."""
    done = run(*(CALLGRIND if what == "instructions" else ()), program, what, name, spp, check=False)
    if done.returncode == 0 and what == "instructions":
        return {what: int(re.search(r"Collected : (\d+)", done.stderr)[1])}
    return {key: float(value) for key, value in map(str.split, done.stdout.splitlines())} if not done.returncode else {}


def measure(programs, kind, name):
    """Returns for each time or count the list of its ratios, one for each round."""
    print(f"against: {name}", file=sys.stderr, flush=True)
    ratios, spp = {}, max(4, round(1.6 / numbers(programs[0], kind, name, 4).get("samples", 1)))  # about 0.4 s
    for what, count, rounds in [(kind, spp, 9)] + [("instructions", 4, 1)] * (kind == "samples"):
        for _ in range(rounds):
            ours, theirs = (numbers(program, what, name, count) for program in programs)
            for key in ours.keys() & theirs.keys():
                ratios.setdefault(key, []).append(theirs[key] / ours[key])
    return ratios


def main():
    commit = git("rev-parse", "--verify", "-q", "--short=8", f"{''.join(sys.argv[1:2])}^{{commit}}")
    if not commit:
        sys.exit("usage: ./build.sh against COMMIT [SCENE ...]; COMMIT must be one of this repository")
    # Build both programs.
    head, there = origin(" ".join(["./build.sh against", commit, *sys.argv[2:]])), ROOT / "build/against" / commit
    if not (there / "source").exists():
        run("git", "-C", ROOT, "worktree", "add", "--force", "--detach", there / "source", commit)
    programs, failed = zip(build(ROOT, ROOT / "build/against/this"), build(there / "source", there))
    # Measure the scenes.
    known = {name: kind for kind, name in map(str.split, run(programs[0]).stdout.splitlines())}
    if unknown := [name for name in sys.argv[2:] if name not in known]:
        sys.exit(f"against: there is no scene {', '.join(unknown)}; there are {', '.join(known)}")
    found = {name: measure(programs, known[name], name) for name in sys.argv[2:] or known}
    # Write the table.
    rows, medians = [], {}
    for name, what, ratios in [(n, w, ratios) for n, each in found.items() for w, ratios in sorted(each.items())]:
        low, middle, high = quantiles(ratios, n=4) if len(ratios) > 1 else ratios * 3
        medians.setdefault(what.rpartition(",")[2], []).append(middle)
        rows.append([name, what, f"{middle:.3f}", f"{low:.3f}", f"{high:.3f}"])
    rows += [["geometric mean", what, f"{geometric_mean(values):.3f}", "", ""] for what, values in medians.items()]
    left_out = sorted({*failed[0], *failed[1], *(name for name, each in found.items() if not each)})
    rows.append(["can't be built by both: " + (", ".join(left_out) or "nothing"), "", "", "", ""])
    print(text := table(["scene", "what", "ratio", "lower quartile", "upper quartile"], rows))
    write("against", f"This tree against {commit}", head, found, text)


if __name__ == "__main__":
    main()
