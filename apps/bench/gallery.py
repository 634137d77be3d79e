"""Renders the pictures of docs/gallery.md: the figures and those that the commands on that page render.

Writes build/results/gallery.json and gallery.html with the seconds and the estimated errors. The page shows the copies
in docs/gallery."""

import json
import re
import shlex
import subprocess

from results import BIN, RESULTS, ROOT, origin, table, write

COMMAND = re.compile(r"^(build/release/bin/.*) -o (\w+)\.png$", re.MULTILINE)


def main():
    # Collect the commands.
    head = origin("./build.sh gallery")
    commands = {m[2]: shlex.split(m[1]) for m in COMMAND.finditer((ROOT / "docs/gallery.md").read_text())}
    commands |= {program.name: [program, "--error", "2e-3"] for program in sorted(BIN.glob("fig[0-9][0-9]_*"))}
    (RESULTS / "gallery").mkdir(parents=True, exist_ok=True)
    raw = {}
    for name, command in commands.items():
        picture, report = (RESULTS / f"gallery/{name}.{suffix}" for suffix in ("png", "json"))
        subprocess.run([*command, "-o", picture, "--report", report], cwd=ROOT, check=True)
        raw[name] = json.loads(report.read_text())
    rows = [[f"![{name}](gallery/{name}.png)", name, f"{r['seconds']['render']:.1f}", f"{r['error']['estimate']:.1e}"]
            for name, r in raw.items()]
    write("gallery", "Gallery", head, raw, table(["picture", "name", "seconds", "relMSE, as limn estimates it"], rows))


if __name__ == "__main__":
    main()
