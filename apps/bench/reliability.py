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
    """The report of a render."""
    subprocess.run([BIN / "fig16_volume_cornell_box", "--quiet", "--report", "r.json", *map(str, options)], cwd=folder, check=True)
    return json.loads((folder / "r.json").read_text())


def checkpoints(folder):
    """Milliseconds that a checkpoint costs a render of 400x400 pixels on all processors."""
    for _ in range(PAIRS):
        (folder / "a.film").unlink(missing_ok=True)
        plain, saved = (figure_16(folder, "--spp", 160, "-o", "a.exr", *options)["seconds"]["render"]
                        for options in ([], ["--checkpoint", "a.film", "--every", 0.5]))
        yield 1000 * (saved - plain) / (saved / 0.5)


def unevenness(folder, count):
    """The rays of the largest of so many shards over those of the mean one, less 1."""
    rays = [figure_16(folder, "--spp", 16, "--shard", f"{i}/{count}", "--film", "s.film")["rays"] for i in range(1, count + 1)]
    return max(rays) / statistics.mean(rays) - 1


def films():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        costs = [*checkpoints(folder)]
        film = (folder / "a.film").stat().st_size / 160000
        rows = [["a checkpoint", f"{statistics.median(costs):.0f} ms ({min(costs):.0f}..{max(costs):.0f})"],
                ["a film", f"{film:.1f} bytes a pixel"],
                *([f"rays of the largest of {n} shards", f"{unevenness(folder, n):.1%} over the mean"] for n in (7, 64))]
    return 0, table(["figure 16, 400x400 pixels", "measured"], rows)


PARTS = {"films": films, "faults": faults.measure, "cluster": cluster.measure}


def main():
    wanted = sys.argv[1:] or list(PARTS)
    if not set(wanted) <= set(PARTS):
        sys.exit(f"reliability: {' '.join(wanted)}: must be of {', '.join(PARTS)}")
    head = origin(" ".join(["./build.sh reliability", *sys.argv[1:]]))
    raw = {name: PARTS[name]() for name in wanted}
    text = "".join(f"## {name.capitalize()}\n\n{said}\n" for name, (_, said) in raw.items())
    write("reliability", "Long renders", head, raw, text)
    return 1 if any(lost for lost, _ in raw.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
