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
    """Returns "scene" for include/limn/scene/shape/x.h and lib/scene/x.cpp, and "" for the umbrella and other files."""
    inside = re.match(r"(?:include/limn|lib)/(\w+)/", path)
    return inside[1] if inside else ""


def folder_of(path):
    """Returns the room and the folder in it, as "scene/shape" for lib/scene/shape/x.cpp and "scene" for lib/scene/x.cpp."""
    return re.sub(r"^(include/limn|lib)/", "", path.rpartition("/")[0])


class Floors:
    """The table of layers: which room may include which."""

    def __init__(self, table):
        self.arrows = {}
        for line in table.splitlines():
            room, below = line.split("->")
            self.arrows[room.strip()] = below.split()
        self.heights = {}
        for room in self.arrows:
            self.height(room, [])

    def height(self, room, path):
        """Returns the number of the room's floor: 1 for a room that includes no other."""
        if room in path:
            raise ValueError("the floors have a cycle: " + " ".join([*path[path.index(room):], room]))
        if room not in self.heights:
            below = self.arrows.get(room, [])
            self.heights[room] = 1 + max((self.height(other, [*path, room]) for other in below), default=0)
        return self.heights[room]

    def __str__(self):
        arrows, floors = sum(map(len, self.arrows.values())), max(self.heights.values())
        rows = [f"{self.heights[room]}  {room:9}-> {' '.join(below)}" for room, below in self.arrows.items()]
        return "\n".join([f"{len(self.arrows)} rooms, {arrows} arrows, {floors} floors", *rows])
