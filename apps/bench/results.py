"""Writes the results of a measuring command: numbers to build/results/NAME.json, tables and plots to NAME.html."""

import datetime
import json
import os
import platform
import re
import subprocess
import sys
from pathlib import Path
from statistics import quantiles

ROOT = Path(__file__).resolve().parents[2]
BIN = ROOT / "build/release/bin"
RESULTS = ROOT / "build/results"
STYLE = ("body{font:16px/1.5 sans-serif;max-width:70em;margin:2em auto;padding:0 1em}table{border-collapse:collapse}"
         "td,th{border:1px solid #ccc;padding:.2em .6em}img{max-width:100%}div{overflow-x:auto}")


def git(*arguments):
    return subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True).stdout.strip()


def origin(command):
    """Returns where numbers come from: command, date, commit and machine. "-dirty" after the commit means that files
    other than documents differ from it."""
    model = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    changed = git("status", "--porcelain", "--", ".", ":!docs", ":!*.md")
    return {"command": command, "date": str(datetime.date.today()),
            "commit": git("rev-parse", "--short=8", "HEAD") + ("-dirty" if changed else ""),
            "machine": f"{model[1] if model else platform.machine()}, {len(os.sched_getaffinity(0))} cores"}


def run_json(*command):
    """Returns the JSON that a program prints. An exit status of 1 may mean a wrong result and is no error."""
    print(*command, file=sys.stderr, flush=True)
    run = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE)
    if run.returncode not in (0, 1) or not run.stdout:
        sys.exit(f"{command[0]} ended with status {run.returncode}")
    return json.loads(run.stdout)


class Kept:
    """The results of parts of a command, kept in a file until it has finished. If the command is interrupted, the next
    run with the same key uses the results. A run with another key measures all parts again."""

    def __init__(self, name, **key):
        self.path = RESULTS / f"{name}.part.json"
        self.key = json.loads(json.dumps(key))
        kept = json.loads(self.path.read_text()) if self.path.exists() else {}
        self.parts = kept["parts"] if kept.get("key") == self.key else {}

    def __call__(self, part, measure):
        """Returns the result of a part. Calls `measure` unless the result is kept."""
        if part not in self.parts:
            self.parts[part] = json.loads(json.dumps(measure()))
            RESULTS.mkdir(parents=True, exist_ok=True)
            beside = self.path.with_suffix(".new")
            beside.write_text(json.dumps({"key": self.key, "parts": self.parts}))
            beside.replace(self.path)
        return self.parts[part]

    def forget(self):
        self.path.unlink(missing_ok=True)


def quartiles(values):
    """Returns the lower quartile, the median and the upper quartile."""
    return quantiles(values, n=4, method="inclusive") if len(values) > 1 else [*values] * 3


def spread(found, digits=2):
    """Returns the result of quartiles() as text, with the median first. `found` may be None."""
    return "{1:.{n}f} ({0:.{n}f}..{2:.{n}f})".format(*found, n=digits) if found else "–"


def table(columns, rows):
    """Returns a Markdown table. The first column is left-aligned, the others are right-aligned."""
    lines = [columns, ["---", *["---:"] * (len(columns) - 1)], *rows]
    return "\n".join("| " + " | ".join(str(cell).replace("|", "\\|") for cell in line) + " |" for line in lines) + "\n"


def write(name, title, head, raw, text):
    """Writes the numbers `raw` and the page. `text` is Markdown. It may name plots, which are files in RESULTS."""
    import markdown  # Debian's python3-markdown
    RESULTS.mkdir(parents=True, exist_ok=True)
    (RESULTS / f"{name}.json").write_text(json.dumps({**head, "results": raw}, indent=1))
    source = " ".join(f"{key} {value}" if key == "commit" else str(value) for key, value in head.items())
    body = markdown.markdown(f"# {title}\n\n`{source}`\n\n{text}", extensions=["tables"])
    body = body.replace("<table>", "<div><table>").replace("</table>", "</table></div>")
    (RESULTS / f"{name}.html").write_text(
        f'<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
        f"<title>{title}</title><style>{STYLE}</style>{body}</html>\n")
    print(f"build/results/{name}.json, build/results/{name}.html", file=sys.stderr, flush=True)
