"""The sources as the rules see them, and the table of layers."""

import re
from pathlib import Path
from typing import NamedTuple

TOKEN = re.compile(r"""
    (?P<comment> //[^\n]* | /\*.*?(?:\*/|\Z))
  | (?P<raw> R"(?P<mark>[^(]*)\(.*?\)(?P=mark)")
  | (?P<text> "(?:\\.|[^"\\\n])*["\n]? | (?<![0-9a-fA-F])'(?:\\.|[^'\\\n])*['\n]?)  # 1'000 opens nothing
""", re.DOTALL | re.VERBOSE)


def strip(text, keep_literals=False):
    """Drops comments, and what literals hold unless they are kept. Lines keep their numbers."""
    def replacement(match):
        token = match[0]
        if match["comment"]:
            return "\n" * token.count("\n")
        if match["raw"]:
            return '""'
        return token if keep_literals else 2 * token[0] + ("\n" if token.endswith("\n") else "")
    return TOKEN.sub(replacement, text)


class Include(NamedTuple):
    path: str
    angle: bool
    line: int


class SourceFile:
    """A file of the tree. `code` is empty unless it is C++."""

    def __init__(self, path, text):
        self.path, self.code, self.includes = path, "", []
        self.lines = text.count("\n")
        if not path.endswith((".h", ".cpp")):
            return
        self.code = strip(text)
        for number, line in enumerate(strip(text, keep_literals=True).split("\n"), 1):
            if found := re.match(r'\s*#\s*include\s*(["<])([^">]+)[">]', line):
                self.includes.append(Include(found[2], found[1] == "<", number))

    is_public = property(lambda self: self.path.startswith("include/limn/"))
    is_lib = property(lambda self: self.path.startswith("lib/"))
    is_program = property(lambda self: self.path.startswith(("apps/", "examples/")))


def read_tree(root, folders):
    """The C++ and CMake files under these folders of `root`."""
    paths = (path for folder in folders for path in (root / folder).rglob("*"))
    return [SourceFile(path.relative_to(root).as_posix(), path.read_text(encoding="utf-8"))
            for path in sorted(paths) if path.suffix in (".h", ".cpp", ".cmake", ".in") and path.is_file()]


def room_of(path):
    """"shape" for include/limn/shape/x.h and lib/shape/x.cpp. records.h and record_sink.h are rooms of one header, with
    their sources in lib/records. Empty for the umbrella and outside both folders."""
    inside = re.match(r"(?:include/limn|lib)/(.*)", path)
    if not inside:
        return ""
    stem = Path(inside[1]).name.partition(".")[0]
    if stem in ("records", "record_sink"):
        return stem
    return inside[1].partition("/")[0] if "/" in inside[1] else ""


class Floors:
    """The table of layers: which room may include which."""

    def __init__(self, table):
        self.rooms, self.anyone, self.sources = [], {}, {}
        for line in table.splitlines():
            modifier = re.search(r"\s*\(sources may use ([^)]*)\)", line)
            if modifier:
                line = line[:modifier.start()] + line[modifier.end():]
            for chain in re.split(r"\s{2,}", re.sub(r"\s*->\s*", "->", line)):
                if "->" in chain:
                    self.add_chain([re.findall(r"[^,\s]+", link) for link in chain.split("->")],
                                   re.findall(r"[^,\s]+", modifier[1]) if modifier else [])
        visited = set()
        for room in sorted(self.rooms):
            self.refuse_cycles(room, visited, [])

    def add_chain(self, links, sources_may_use):
        for upper, rooms in enumerate(links):
            for room in rooms:
                self.rooms.append(room)
                for lower in links[upper + 1:]:
                    self.anyone.setdefault(room, set()).update(lower)
                if upper + 1 < len(links):
                    self.sources.setdefault(room, set()).update(sources_may_use)

    def refuse_cycles(self, room, visited, path):
        if room in path:
            raise ValueError("the floors have a cycle: " + " ".join([*path[path.index(room):], room]))
        if room in visited:
            return
        visited.add(room)
        for target in sorted(self.anyone.get(room, ())) + sorted(self.sources.get(room, ())):
            self.refuse_cycles(target, visited, [*path, room])

    def allows(self, room, target, is_source):
        return (room == target or target in self.anyone.get(room, ())
                or is_source and target in self.sources.get(room, ()))
