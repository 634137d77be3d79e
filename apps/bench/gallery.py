#!/usr/bin/env python3
"""Runs `./build.sh figures`; puts the pictures into docs/gallery, their seconds and errors under them in the README."""

import json
import re
import shutil
import subprocess
import sys

from machine import ROOT
from reports import origin, part, report_of, stamp, write

FIGURES = ROOT / "build/figures"
GALLERY = ROOT / "docs/gallery"

# A cell of the table: picture, title, and what an earlier run wrote under it.
CELL = re.compile(r"\(docs/gallery/(?P<name>fig\d\d_\w+)\.png\)<br>(?P<title>[^|<]*?)(?:<br>[^|]*?)? \|")


def cell(match):
    report = json.loads((FIGURES / f"{match['name']}.json").read_text())
    shutil.copyfile(FIGURES / f"{match['name']}.png", GALLERY / f"{match['name']}.png")
    return (f"(docs/gallery/{match['name']}.png)<br>{match['title']}<br>"
            f"{report['seconds']['render']:.1f} s, relMSE {report['error']['estimate']:.1e} |")


def main():
    head = origin("gallery")
    subprocess.run([ROOT / "build.sh", "figures"], check=True)
    table = part(report_of("gallery"))
    text, cells = CELL.subn(cell, table[table.index("| | | |"):])
    if cells != len(list(GALLERY.glob("*.png"))):
        sys.exit(f"gallery: README.md shows {cells} pictures, {GALLERY} has another number")
    write("gallery", f"{stamp(head)}.\n\n{text}")


if __name__ == "__main__":
    main()
