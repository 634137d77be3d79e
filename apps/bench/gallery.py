"""Renders the pictures of docs/gallery.md: the figures and those that the commands on that page render.

The results are the seconds and the estimated errors. docs/gallery has copies of the pictures."""

import re
import shlex

from results import BIN, RESULTS, ROOT, origin, run_json, table, write

COMMAND = re.compile(r"^(build/release/bin/.*) -o (\w+)\.png$", re.MULTILINE)

head = origin("./build.sh gallery")
commands = {m[2]: shlex.split(m[1]) for m in COMMAND.finditer((ROOT / "docs/gallery.md").read_text())}
commands |= {program.name: [program, "--error", "2e-3"] for program in sorted(BIN.glob("fig[0-9][0-9]_*"))}
(RESULTS / "gallery").mkdir(parents=True, exist_ok=True)
raw = {name: run_json(*command, "-o", RESULTS / f"gallery/{name}.png", "--report", "-")
       for name, command in commands.items()}
rows = [[f"![{name}](gallery/{name}.png)", name, f"{r['seconds']['render']:.1f}", f"{r['error']['estimate']:.1e}"]
        for name, r in raw.items()]
write("gallery", "Gallery", head, raw, table(["picture", "name", "seconds", "relMSE, as limn estimates it"], rows))
