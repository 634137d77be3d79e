#!/usr/bin/env python3
"""The measured parts of the documents: which command writes each, what it measures, whether that has changed since.

    reports.py                    a line for each part: fresh, or why not, and what renews it
    reports.py names              the names
    reports.py state NAME         the line of one; exit status 77 unless it is fresh, which CTest counts as skipped
    reports.py digest NAME        that of the sources as they are
    reports.py write NAME DIGEST  makes standard input the part, below a line that says where it comes from; DIGEST is
                                  what the sources had when they were measured

A part stands in its document between `<!-- NAME: begin -->` and `<!-- NAME: end -->`. Its first line holds the command,
the commit, and a digest of the sources that it measures.
"""

import datetime
import fnmatch
import hashlib
import json
import os
import re
import sys
import threading
import time
from dataclasses import dataclass

from machine import ROOT, commit, processor

CORE = ("CMakeLists.txt", "cmake", "include", "lib", "-include/limn/io", "-lib/io", "-cmake/LimnInstall.cmake")
IO = ("include/limn/io", "lib/io")
FIGURES = ("apps/common", "examples/figures")
BENCH = ("apps/bench/*.cpp", "apps/bench/*.h", "apps/bench/CMakeLists.txt", "-apps/bench/queries")
CONVERGENCE = CORE + BENCH + FIGURES + (
    "examples/gallery", "examples/models", "apps/bench/convergence_measure.py", "apps/bench/convergence_pictures.py",
    "apps/bench/convergence_renderers.py", "apps/bench/peers")
# The suite in other builds than the usual one.
CHECKED = ("CMakeLists.txt", "CMakePresets.json", "cmake", "include", "lib", "apps", "examples", "tests", "-*.py",
           "-apps/bench/without", "-tests/mutants", "tests/checks")
# Of tests/hard the digests alone, and no outside projects: MEMCHECK in sanitize.py.
MEMCHECKED = CHECKED + (
    "-tests/consumer", "-tests/hard", "tests/hard/CMakeLists.txt", "tests/hard/*digest_test.cpp", "tests/hard/corpus.h")
ALL = ("CMakeLists.txt", "cmake", "include", "lib", "apps", "examples", "-*.py", "-apps/bench/without")


@dataclass(frozen=True)
class Report:
    name: str
    paper: str
    command: str
    minutes: int  # on two cores, about
    sources: tuple  # files, folders, patterns; those after "-" are left out again


# In the order in which they are best renewed: what needs a quiet machine first.
REPORTS = (
    Report("performance", "docs/performance.md", "./build.sh bench", 20,
           CORE + BENCH + ("apps/limn/bench.cpp", "apps/bench/performance.py", "apps/bench/patches.py",
                           "apps/bench/performance_instructions.py", "apps/bench/without")),
    Report("convergence", "docs/speed-against-error.md", "./build.sh convergence", 55, CONVERGENCE),
    Report("convergence-400", "docs/speed-against-error.md", "./build.sh convergence --size 400", 90, CONVERGENCE),
    Report("queries", "docs/queries.md", "./build.sh queries", 25,
           CORE + ("python", "pyproject.toml", "apps/bench/queries*.py", "apps/bench/queries", "apps/bench/stopwatch.h",
                   "apps/bench/peers/query_worker.py", "apps/bench/peers/cgal_queries.cpp", "tests/python/meshes.py")),
    Report("gallery", "docs/gallery.md", "./build.sh gallery", 10,
           CORE + IO + FIGURES + ("apps/limn/render.cpp", "examples/gallery", "examples/models")),
    Report("promise", "docs/speed-against-error.md", "./build.sh promise", 75,
           CORE + FIGURES + ("apps/bench/transport_scenes.*", "apps/bench/scenes.*", "apps/bench/geometry.*",
                             "apps/bench/promise*.cpp", "apps/bench/promise.h", "apps/bench/sampler_rates.cpp")),
    Report("films", "docs/long-renders.md", "./build.sh films", 10,
           CORE + IO + FIGURES + ("apps/limn/merge.cpp", "apps/bench/films.py")),
    Report("faults", "docs/long-renders.md", "./build.sh faults", 20,
           CORE + IO + FIGURES + ("apps/limn/merge.cpp", "tests/faults")),
    Report("cluster", "docs/long-renders.md", "./build.sh cluster", 4,
           CORE + IO + FIGURES + ("apps/limn/merge.cpp", "tests/cluster", "tests/faults/bits.py", "examples/cluster")),
    Report("accuracy", "docs/accuracy.md", "./build.sh accuracy --full", 80,
           CORE + ("tests/accuracy", "tests/hard", "tests/support", "apps/bench/accuracy.py", "-*_test.py")),
    Report("compilers", "docs/checks.md", "./build.sh compilers --aarch64", 110, CHECKED),
    Report("asan", "docs/checks.md", "./build.sh sanitize asan", 115, CHECKED),
    Report("tsan", "docs/checks.md", "./build.sh sanitize tsan", 80, CHECKED),
    Report("memcheck", "docs/checks.md", "./build.sh sanitize memcheck", 105, MEMCHECKED),
    Report("mutants", "docs/mutants.md", "./build.sh mutants", 120, ALL + ("tests", "apps/bench/patches.py")),
)

COMMENTS = re.compile(r'//[^\n]*|/\*.*?\*/|R"(?P<end>[^(\s]*)\(.*?\)(?P=end)"|"(?:\\.|[^"\\\n])*"'
                      r"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])*'", re.DOTALL)


def report_of(name):
    for report in REPORTS:
        if report.name == name:
            return report
    sys.exit(f"reports: there is no report '{name}'")


def essence(path):
    """What of a file makes a difference: without comments and empty lines, and without limn's own version."""
    if path.suffix in (".cpp", ".h"):
        text = COMMENTS.sub(lambda m: " " if m[0].startswith(("//", "/*")) else m[0], path.read_text())
        return " ".join(text.split()).encode()
    if path.suffix in (".py", ".sh", ".cmake") or path.name == "CMakeLists.txt":
        lines = [line.rstrip() for line in path.read_text().splitlines()]
        text = "\n".join(line for line in lines if line and not line.lstrip().startswith("#"))
        return re.sub(r"(project\(\w+ VERSION) [\d.]+", r"\1", text).encode()
    return path.read_bytes()


def files(patterns, root=ROOT):
    """Those below root that the patterns name, sorted: the last pattern that fits a file decides."""
    found = []
    for folder, folders, names in os.walk(root):
        inner = os.path.relpath(folder, root)
        folders[:] = [f for f in folders if f != "__pycache__" and not f.startswith(".")
                      and (inner != "." or f != "build")]
        for name in names:
            path = name if inner == "." else f"{inner}/{name}"
            kept = False
            for pattern in patterns:
                bare = pattern.removeprefix("-")
                if path == bare or path.startswith(bare + "/") or fnmatch.fnmatch(path, bare):
                    kept = bare == pattern
            if kept and not name.startswith("."):
                found.append(path)
    return sorted(found)


def digest(patterns, root=ROOT):
    whole = hashlib.sha256()
    for path in files(patterns, root):
        whole.update(f"{path}\0".encode() + hashlib.sha256(essence(root / path)).digest())
    return whole.hexdigest()[:12]


def origin(name, command=None):
    """Where the numbers of a report come from; asked before they are measured."""
    report = report_of(name)
    return {"command": command or report.command, "date": str(datetime.date.today()), "commit": commit(),
            "sources": digest(report.sources), "processor": processor(), "cores": len(os.sched_getaffinity(0))}


def stamp(head):
    """The beginning of a part's first line. `faults`: how much of it is not as it must be."""
    faults = f", **{head['faults']} wrong**" if head.get("faults") else ""
    return (f"Written by `{head['command']}`; do not edit. {head['date']}, commit {head['commit']}, "
            f"sources {head['sources']}{faults}, {head['processor']}, {head['cores']} cores")


def markers(name):
    return f"<!-- {name}: begin -->", f"<!-- {name}: end -->"


def part(report, root=ROOT):
    """What stands between the markers; None where they are not there just once."""
    begin, end = markers(report.name)
    text = (root / report.paper).read_text()
    if text.count(begin) != 1 or text.count(end) != 1:
        return None
    return text.partition(begin)[2].partition(end)[0].strip()


def write(name, text, root=ROOT):
    """Puts the text between the markers of the report; the prose around them stays as it is."""
    report = report_of(name)
    if part(report, root) is None:
        sys.exit(f"reports: {report.paper} lacks the markers of {name}")
    begin, end = markers(name)
    before, _, rest = (root / report.paper).read_text().partition(begin)
    (root / report.paper).write_text(f"{before}{begin}\n\n{text.strip()}\n\n{end}{rest.partition(end)[2]}")


def state(report, root=ROOT):
    """'fresh', or why the part is not what its command would write."""
    text = part(report, root)
    if text is None:
        return "not in its document"
    command = re.search(r"[Ww]ritten by `([^`]+)`", text)
    sources = re.search(r"\bsources ([0-9a-f]{12})\b(, \*\*\d+ wrong\*\*)?", text)
    if not command or not sources:
        return "does not say what it measured"
    if sources[1] != digest(report.sources, root):
        return "older than its sources"
    if sources[2]:
        return sources[2].strip(" ,*")
    if re.search(r"\bcommit [0-9a-f]+-dirty\b", text.partition("\n")[0]):
        return "measured before it was committed"
    return "fresh" if command[1] == report.command else f"written by {command[1]}"


def line(report, root=ROOT):
    return f"{report.name:15} {report.paper:29} {state(report, root):30} {report.command}, {report.minutes} min"


class Kept:
    """What a long report has measured so far, on disk, so that it goes on where it was interrupted. `key` tells
    sources and form: what was measured with another one is forgotten."""

    def __init__(self, path, **key):
        self.path, self.started, self.lock = path, time.monotonic(), threading.Lock()
        empty = {"key": json.loads(json.dumps(key)), "seconds": 0, "parts": {}}
        kept = json.loads(path.read_text()) if path.exists() else empty
        self.kept = kept if kept["key"] == empty["key"] else empty
        self.seconds_before = self.kept["seconds"]

    def __call__(self, name, measure, good=lambda value: True):
        """What measure() returns, or returned before. What is not good is measured again the next time."""
        if name not in self.kept["parts"]:
            value = json.loads(json.dumps(measure()))  # the same whether measured now or before
            if not good(value):
                return value
            with self.lock:
                self.kept["parts"][name] = value
                self.save()
        return self.kept["parts"][name]

    def save(self):
        self.kept["seconds"] = self.seconds_before + time.monotonic() - self.started
        self.path.parent.mkdir(parents=True, exist_ok=True)
        beside = self.path.with_suffix(".new")
        beside.write_text(json.dumps(self.kept, indent=1))
        beside.replace(self.path)

    def minutes(self):
        """That all of it took, in however many runs."""
        return (self.seconds_before + time.monotonic() - self.started) / 60

    def forget(self):
        """When the report is written: whoever asks for it again wants it measured again."""
        self.path.unlink(missing_ok=True)


def main(arguments):
    if not arguments:
        print("\n".join(map(line, REPORTS)))
    elif arguments == ["names"]:
        print(" ".join(r.name for r in REPORTS))
    elif arguments[0] == "state" and len(arguments) == 2:
        print(line(report_of(arguments[1])))
        return 0 if state(report_of(arguments[1])) == "fresh" else 77
    elif arguments[0] == "digest" and len(arguments) == 2:
        print(digest(report_of(arguments[1]).sources))
    elif arguments[0] == "write" and len(arguments) == 3:
        head = {**origin(arguments[1]), "sources": arguments[2]}
        write(arguments[1], stamp(head) + ".\n\n" + sys.stdin.read())
    else:
        sys.exit(__doc__)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
