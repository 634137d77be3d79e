"""Patches of the sources, put into a copy of the tree: faults in tests/mutants, features left out in apps/bench/without.

A patch begins with a line or more that say what it does. Its hunks are found by their lines, which must occur just
once, not by their numbers.
"""

import contextlib
import filecmp
import os
import re
import shutil
from pathlib import Path

from machine import ROOT


class PatchError(Exception):
    """A fault of the patches themselves."""


class Patch:
    def __init__(self, path):
        self.name = path.stem
        self.head, *files = re.split(r"^--- a/.*\n\+\+\+ b/(.*)\n", path.read_text(), flags=re.MULTILINE)
        self.hunks = [(file, hunk) for file, body in zip(files[::2], files[1::2])
                      for hunk in re.split(r"^@@.*\n", body, flags=re.MULTILINE)[1:]]
        if not self.head or not self.hunks:
            raise PatchError(f"{path.name}: must begin with what it does, and change a file")

    def patched(self, root):
        """The text of each file that it changes, changed."""
        texts = {}
        for file, hunk in self.hunks:
            lines = hunk.splitlines(keepends=True)
            before, after = ("\n" + "".join(line[1:] for line in lines if line[0] in kinds) for kinds in (" -", " +"))
            text = texts.get(file) or "\n" + (root / file).read_text()
            if text.count(before) != 1:
                raise PatchError(f"{self.name}: its lines occur {text.count(before)} times in {file}, not once")
            texts[file] = text.replace(before, after)
        return {file: text[1:] for file, text in texts.items()}

    @contextlib.contextmanager
    def applied(self, root):
        patched = self.patched(root)
        original = {file: (root / file).read_text() for file in patched}
        try:
            for file, text in patched.items():
                (root / file).write_text(text)
            yield
        finally:  # with a new time, so that what was built with the patch is built again
            for file, text in original.items():
                (root / file).write_text(text)


def load(folder, kind=Patch):
    """Those of a folder, each known to apply."""
    patches = [kind(path) for path in sorted(folder.glob("*.patch"))]
    for patch in patches:
        patch.patched(ROOT)
    return patches


def copy_tree(target):
    """Makes the copy equal to the tree. Files that are equal keep their times, so that little is built again."""
    kept = set()
    for folder, folders, files in os.walk(ROOT):
        folders[:] = [f for f in folders if f not in (".git", "build", "__pycache__")]
        for file in files:
            origin = Path(folder, file)
            copy = target / origin.relative_to(ROOT)
            kept.add(copy)
            copy.parent.mkdir(parents=True, exist_ok=True)
            if not copy.exists() or not filecmp.cmp(origin, copy, shallow=False):
                shutil.copy(origin, copy)
    for folder, folders, files in os.walk(target):
        folders[:] = [f for f in folders if f != "build"]
        for file in {Path(folder, f) for f in files} - kept:
            file.unlink()
