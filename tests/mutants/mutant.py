#!/usr/bin/env python3
"""The patches beside this file: each puts one fault into limn. Run alone, sees whether all of them still apply, and
those of apps/bench/without too.

A patch begins with a sentence that says what is wrong, and a line `suspect: PREFIX`, the beginning of the names of the
tests that should notice.
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1] / "apps/bench"))
import patches
from machine import ROOT
from patches import Patch, PatchError

FEWEST = 100  # patches: fewer were lost by accident


class Mutant(Patch):
    def __init__(self, path):
        super().__init__(path)
        self.room = self.name.split("_")[0]
        match = re.fullmatch(r"(\S.*\.)\nsuspect: (\w+.*)\n", self.head)
        if not match:
            raise PatchError(f"{path.name}: must begin with a sentence, and a line 'suspect: PREFIX'")
        self.fault, self.suspect = match.groups()

    def tests(self):
        """A regular expression for the names of the tests to try first."""
        return f"^{self.suspect}" + ("" if ":" in self.suspect else ":")

    def target(self):
        """What must be built for them; for consumers all that is installed, which test_cli needs too."""
        room = self.suspect.split(":")[0]
        return "test_cli" if room == "consumer" else f"test_{room}"


def load_mutants():
    """All of them, each known to apply."""
    mutants = patches.load(HERE, Mutant)
    if len(mutants) < FEWEST:
        raise PatchError(f"there are only {len(mutants)} mutants of at least {FEWEST}")
    return mutants


if __name__ == "__main__":
    try:
        print(f"{len(load_mutants())} patches apply, and {len(patches.load(ROOT / 'apps/bench/without'))} that leave "
              "a feature out")
    except (PatchError, OSError) as problem:
        sys.exit(f"mutants: {problem}")
