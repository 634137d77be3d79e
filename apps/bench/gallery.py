#!/usr/bin/env python3
"""Runs the commands of docs/gallery.md and `./build.sh figures`; puts the pictures into docs/gallery, and their seconds
and errors under them in that page."""

import json
import re
import shlex
import shutil
import subprocess
import sys

from machine import ROOT
from reports import origin, part, report_of, stamp, write

MADE = ROOT / "build/gallery"
FIGURES = ROOT / "build/figures"
GALLERY = ROOT / "docs/gallery"
COMMAND = re.compile(r"^build/release/bin/.* -o (\w+)\.png$", re.MULTILINE)

# A cell of a table: picture, title, and what an earlier run wrote under it.
CELL = re.compile(r"\(gallery/(?P<name>\w+)\.png\)<br>(?P<title>[^|<]*?)(?:<br>[^|]*?)? \|")


def render(page):
    """Returns the names of the pictures."""
    MADE.mkdir(parents=True, exist_ok=True)
    names = []
    for command in COMMAND.finditer(page):
        names.append(command[1])
        program, *words = shlex.split(command[0])
        words[words.index("-o") + 1] = str(MADE / f"{command[1]}.png")
        subprocess.run([ROOT / program, *words, "--report", MADE / f"{command[1]}.json"], cwd=ROOT, check=True)
    subprocess.run([ROOT / "build.sh", "figures"], check=True)
    for report in FIGURES.glob("fig*.json"):
        names.append(report.stem)
        for suffix in (".json", ".png"):
            shutil.copyfile(report.with_suffix(suffix), (MADE / report.stem).with_suffix(suffix))
    return names


def cell(match):
    report = json.loads((MADE / f"{match['name']}.json").read_text())
    shutil.copyfile(MADE / f"{match['name']}.png", GALLERY / f"{match['name']}.png")
    return (f"(gallery/{match['name']}.png)<br>{match['title']}<br>"
            f"{report['seconds']['render']:.1f} s, relMSE {report['error']['estimate']:.1e} |")


def main():
    head, gallery = origin("gallery"), report_of("gallery")
    names = render((ROOT / gallery.paper).read_text())
    tables = part(gallery)
    tables = tables[tables.index("| | |"):]
    if sorted(m["name"] for m in CELL.finditer(tables)) != sorted(names):
        sys.exit(f"gallery: the tables of {gallery.paper} do not show what was rendered")
    write("gallery", f"{stamp(head)}.\n\n{CELL.sub(cell, tables)}")


if __name__ == "__main__":
    main()
