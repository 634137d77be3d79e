"""Random faults in the sources of a room: which of them does the suite miss?

    mutants.py [ROOM ...] [--sample N] [--seed S]    ROOM: a folder of lib/, by default each; N: 10

Draws N mutations of a room's sources that compile and change the object code. The tests of that room run against each;
if they pass, the tests of `hard` and of `render`. A mutation that all of them miss is printed as a diff: it is
equivalent, or a test is missing. Run through ./build.sh mutants.
"""

import argparse
import contextlib
import difflib
import hashlib
import io
import os
import random
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "apps/bench"))
from results import Kept, git, origin, table, write  # noqa: E402

WORK = ROOT / "build/mutants"
SOURCE, BUILD = WORK / "source", WORK / "build"
HANGS = 300  # seconds after which a test counts as failed
# Code for AVX2 and for one lane: the other instruction sets share its sources.
OPTIONS = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DLIMN_BUILD_TESTS=ON",
           "-DLIMN_DISABLED_TARGETS=HWY_SSSE3|HWY_AVX3_DL|HWY_SSE4|HWY_AVX3", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
# The rooms without a test program of their own name.
TESTED_BY = {"geometry": ["math", "geometry", "shape"], "records": ["flat"], "bsdf": ["material", "texture"],
             "scene": ["scene", "texture", "material", "shape"], "trace": ["flat"], "query": ["flat"],
             "shading": ["material", "flat"]}


def run(*command, seconds=None):
    """Returns the exit status and the output; the status is None if the command takes longer than `seconds`."""
    try:
        done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", timeout=seconds)
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        return None, ""


def rules():
    """Imports universalmutator, from an environment of its own."""
    environment = WORK / "environment"
    if not environment.exists():
        subprocess.run([sys.executable, "-m", "venv", environment], check=True)
        subprocess.run([environment / "bin/pip", "install", "-q", "universalmutator"], check=True)
    sys.path.append(str(next(environment.glob("lib/*/site-packages"))))
    from universalmutator import mutator
    return lambda lines: mutator.mutants_regexp(lines, ["universal", "c_like", "cpp"], ignorePatterns=[], ignoreStringOnly=True)


def copy_tree():
    """Makes SOURCE equal to the tree. A file that is equal keeps its time, so that it isn't compiled again."""
    names = set(git("ls-files", "--cached", "--others", "--exclude-standard").splitlines())
    for path in [p for p in SOURCE.rglob("*") if p.is_file() and str(p.relative_to(SOURCE)) not in names]:
        path.unlink()
    for name in names:
        here, there = ROOT / name, SOURCE / name
        if here.is_file() and (not there.exists() or here.read_bytes() != there.read_bytes()):
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(here, there)


def programs(room):
    own = TESTED_BY.get(room, [room])
    return [f"test_{name}" for name in dict.fromkeys([*own, "hard", "render"])]


def objects():
    """Returns a digest of the libraries' object code."""
    digest = hashlib.sha256()
    for path in sorted(BUILD.glob("lib/**/*.a")):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def libraries():
    return run("cmake", "--build", BUILD, "--target", "limn_limn")[0] == 0


def judge(room):
    """Returns the test that fails, or None. Each program is built when the one before it has noticed nothing."""
    for program in programs(room):
        status, output = run("cmake", "--build", BUILD, "--target", program)
        if status != 0:
            return "a test that doesn't compile"
        status, output = run(BUILD / "bin" / program, "--abort", seconds=HANGS)
        if status != 0:
            case = re.search(r"^-{70,}\n(.+)\n", output, re.MULTILINE)
            return f"{program}: {case[1] if case else 'hangs' if status is None else 'crashes'}"
    return None


def try_mutation(room, path, line, text, clean):
    """Returns None if the mutation doesn't compile or changes no object code, else what became of it."""
    before = path.read_text()
    lines = before.splitlines(keepends=True)
    lines[line - 1] = text
    try:
        path.write_text("".join(lines))
        if not libraries() or objects() == clean:
            return None
        name = str(path.relative_to(SOURCE))
        diff = "".join(difflib.unified_diff(before.splitlines(keepends=True), lines, name, name, n=2))
        return {"diff": diff, "caught": judge(room)}
    finally:
        path.write_text(before)


def mutate(room, count, seed, mutations, kept):
    """Returns `count` mutations of a room and what became of them."""
    sources = [path for folder in ("lib", "include/limn") for path in sorted((SOURCE / folder / room).rglob("*"))
               if path.suffix in (".h", ".cpp")]
    with contextlib.redirect_stdout(io.StringIO()):
        drawn = [(path, line, text) for path in sources
                 for line, text, *_ in mutations(path.read_text().splitlines(keepends=True))]
    random.Random(f"{seed} {room}").shuffle(drawn)
    found, clean = [], None
    for number, (path, line, text) in enumerate(drawn):
        if len(found) == count:
            break
        part = f"{room} {number}"
        if clean is None and part not in kept.parts:
            libraries()
            clean = objects()
        result = kept(part, lambda: try_mutation(room, path, line, text, clean))
        if result:
            found.append(result)
            print(f"mutants: {room} {len(found)}: {result['caught'] or 'SURVIVES'}", file=sys.stderr, flush=True)
            if not result["caught"]:
                print(result["diff"], flush=True)
    return found


def main():
    rooms = sorted(path.name for path in (ROOT / "lib").iterdir() if path.is_dir())
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("rooms", nargs="*", metavar="ROOM", help=", ".join(rooms))
    parser.add_argument("--sample", type=int, default=10, metavar="N", help="mutations of each room")
    parser.add_argument("--seed", default=git("rev-parse", "HEAD^")[:8], help="by default the commit before")
    arguments = parser.parse_args()
    for room in set(arguments.rooms) - set(rooms):
        parser.error(f"{room}: there is no such room; there are {', '.join(rooms)}")
    head = origin(" ".join(["./build.sh mutants", *sys.argv[1:]]))
    wanted = arguments.rooms or rooms
    mutations = rules()
    copy_tree()
    os.environ.pop("LIMN_FULL", None)
    everything = sorted({program for room in wanted for program in programs(room)})
    for command in (["cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", *OPTIONS],
                    ["cmake", "--build", BUILD, "--target", "limn_limn", *everything]):
        status, output = run(*command)
        if status != 0:
            sys.exit(f"mutants: without a mutation {' '.join(map(str, command))} fails:\n{output[-3000:]}")
    kept = Kept("mutants", commit=head["commit"], seed=arguments.seed)
    found = {room: mutate(room, arguments.sample, arguments.seed, mutations, kept) for room in wanted}
    rows = [[room, len(results), sum(not result["caught"] for result in results)] for room, results in found.items()]
    survivors = "\n".join(f"```\n{r['diff']}```\n" for results in found.values() for r in results if not r["caught"])
    text = table(["room", "mutations", "missed by the suite"], rows)
    print(text)
    write("mutants", "Mutations and the suite", {**head, "seed": arguments.seed}, found, f"{text}\n{survivors}")
    kept.forget()


if __name__ == "__main__":
    main()
