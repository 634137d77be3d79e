#!/usr/bin/env python3
"""The patches beside this file: each puts one fault into limn. Run alone, sees whether all of them still apply.

A patch begins with a sentence that says what is wrong, and a line `suspect: PREFIX`, the beginning of the names of the
tests that should notice. Its hunks are found by their lines, which must occur just once, not by their numbers.
"""

import contextlib
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FEWEST = 100  # patches: fewer were lost by accident


class MutantError(Exception):
    """A fault of the mutants themselves."""


class Mutant:
    def __init__(self, path):
        self.name = path.stem
        self.room = self.name.split("_")[0]
        head, *files = re.split(r"^--- a/.*\n\+\+\+ b/(.*)\n", path.read_text(), flags=re.MULTILINE)
        match = re.fullmatch(r"(\S.*\.)\nsuspect: (\w+.*)\n", head)
        if not match or not files:
            raise MutantError(f"{path.name}: must begin with a sentence, a line 'suspect: PREFIX' and a file")
        self.fault, self.suspect = match.groups()
        self.hunks = [(file, hunk) for file, body in zip(files[::2], files[1::2])
                      for hunk in re.split(r"^@@.*\n", body, flags=re.MULTILINE)[1:]]

    def tests(self):
        """A regular expression for the names of the tests to try first."""
        return f"^{self.suspect}" + ("" if ":" in self.suspect else ":")

    def target(self):
        """What must be built for them."""
        room = self.suspect.split(":")[0]
        return "limn" if room == "consumer" else f"test_{room}"

    def mutated(self, root):
        """The text of each file with the fault in it."""
        texts = {}
        for file, hunk in self.hunks:
            lines = hunk.splitlines(keepends=True)
            before, after = ("\n" + "".join(line[1:] for line in lines if line[0] in kinds) for kinds in (" -", " +"))
            text = texts.get(file) or "\n" + (root / file).read_text()
            if text.count(before) != 1:
                raise MutantError(f"{self.name}: its lines occur {text.count(before)} times in {file}, not once")
            texts[file] = text.replace(before, after)
        return {file: text[1:] for file, text in texts.items()}

    @contextlib.contextmanager
    def applied(self, root):
        mutated = self.mutated(root)
        original = {file: (root / file).read_text() for file in mutated}
        try:
            for file, text in mutated.items():
                (root / file).write_text(text)
            yield
        finally:  # with a new time, so that what was built with the fault is built again
            for file, text in original.items():
                (root / file).write_text(text)


def load_mutants():
    """All of them, each known to apply."""
    mutants = [Mutant(path) for path in sorted(HERE.glob("*.patch"))]
    for mutant in mutants:
        mutant.mutated(ROOT)
    if len(mutants) < FEWEST:
        raise MutantError(f"there are only {len(mutants)} mutants of at least {FEWEST}")
    return mutants


if __name__ == "__main__":
    try:
        print(f"{len(load_mutants())} patches apply")
    except (MutantError, OSError) as problem:
        sys.exit(f"mutants: {problem}")
