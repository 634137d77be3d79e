#!/usr/bin/env python3
"""Puts the pictures of `./build.sh figures` into docs/gallery, their seconds and errors under them in the README."""

import json
import re
import shutil
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FIGURES = ROOT / "build/figures"
GALLERY = ROOT / "docs/gallery"
README = ROOT / "README.md"

# A cell of the table: picture, title, and what an earlier run wrote under it.
CELL = re.compile(r"\(docs/gallery/(?P<name>fig\d\d_\w+)\.png\)<br>(?P<title>[^|<]*?)(?:<br>[^|]*?)? \|")


def cell(match):
    report = json.loads((FIGURES / f"{match['name']}.json").read_text())
    shutil.copyfile(FIGURES / f"{match['name']}.png", GALLERY / f"{match['name']}.png")
    return (f"(docs/gallery/{match['name']}.png)<br>{match['title']}<br>"
            f"{report['seconds']['render']:.1f} s, relMSE {report['error']['estimate']:.1e} |")


def main():
    text, cells = CELL.subn(cell, README.read_text())
    if cells != len(list(GALLERY.glob("*.png"))):
        raise SystemExit(f"{README} shows {cells} pictures, {GALLERY} has another number")
    README.write_text(text)


if __name__ == "__main__":
    main()
