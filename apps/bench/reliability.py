"""What checkpoints cost, and what becomes of long renders under faults: build/results/reliability.html.

Run through ./build.sh reliability [films|faults|cluster ...]. Exit status 0 only if nothing was lost.
"""

import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from results import BIN, ROOT, origin, table, write

sys.path[:0] = [str(ROOT / "tests/faults"), str(ROOT / "tests/cluster")]
import cluster
import faults

PAIRS = 5


def figure_16(folder, *options):
    """Renders 400x400 pixels and returns the report."""
    command = [BIN / "fig16_volume_cornell_box", "--quiet", "--report", "r.json", *options]
    subprocess.run(command, cwd=folder, check=True)
    return json.loads((folder / "r.json").read_text())


def checkpoints(folder):
    """Milliseconds that a checkpoint costs a render on all processors."""
    for _ in range(PAIRS):
        (folder / "a.film").unlink(missing_ok=True)
        plain, saved = (figure_16(folder, "--spp", "160", "-o", "a.exr", *options)["seconds"]["render"]
                        for options in ([], ["--checkpoint", "a.film", "--every", "0.5"]))
        yield 1000 * (saved - plain) / (saved / 0.5)


def unevenness(folder, count):
    """The rays of the largest of so many shards over those of the mean one, less 1."""
    rays = [figure_16(folder, "--spp", "16", "--shard", f"{i}/{count}", "--film", "s.film")["rays"]
            for i in range(1, count + 1)]
    return max(rays) / statistics.mean(rays) - 1


def films():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        costs = [*checkpoints(folder)]
        size = (folder / "a.film").stat().st_size / 160000
        cost = f"{statistics.median(costs):.0f} ms ({min(costs):.0f}..{max(costs):.0f})"
        yield ["a checkpoint of figure 16", PAIRS, 0, cost]
        yield ["its film", 1, 0, f"{size:.1f} bytes a pixel"]
        for count in (7, 64):
            yield [f"its largest shard of {count}", 1, 0, f"{unevenness(folder, count):.1%} more rays than the mean"]


PARTS = {"films": films, "faults": faults.measure, "cluster": cluster.measure}


def main():
    wanted = sys.argv[1:] or list(PARTS)
    if not set(wanted) <= set(PARTS):
        sys.exit(f"reliability: {' '.join(wanted)}: must be of {', '.join(PARTS)}")
    head = origin(" ".join(["./build.sh reliability", *sys.argv[1:]]))
    rows = []
    for name in wanted:
        for row in PARTS[name]():
            rows.append(row)
            print(f"{name}:", *row, file=sys.stderr, flush=True)
    write("reliability", "Long renders", head, rows, table(["what", "times", "wrong", "what happened"], rows))
    return 1 if any(wrong for _, _, wrong, _ in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
