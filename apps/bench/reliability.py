"""Measures the cost of checkpoints, and checks that long renders survive faults.

Run it by ./build.sh reliability [films|faults|cluster ...]. The exit status is 0 only if nothing was lost."""

import statistics
import sys
import tempfile
from pathlib import Path

from results import BIN, ROOT, origin, run_json, table, write

sys.path[:0] = [str(ROOT / "tests/faults"), str(ROOT / "tests/cluster")]
import cluster
import faults

PAIRS = 5


def render_seconds(folder, *options):
    """Renders figure 16 in 400x400 pixels and returns the seconds."""
    return run_json(BIN / "fig16_volume_cornell_box", "--quiet", "--spp", 160, "-o", f"{folder}/a.exr", "--report", "-",
                    *options)["seconds"]["render"]


def films():
    """Measures the time that a checkpoint costs a render on all processors, and the size of its film. Returns rows."""
    costs = []
    with tempfile.TemporaryDirectory() as name:
        film = Path(name) / "a.film"
        for _ in range(PAIRS):
            film.unlink(missing_ok=True)
            plain, saved = (render_seconds(name, *options) for options in
                            ([], ["--checkpoint", film, "--every", "0.5"]))
            costs.append(1000 * (saved - plain) / (saved / 0.5))
        size = film.stat().st_size / 160000
    cost = f"{statistics.median(costs):.0f} ms ({min(costs):.0f}..{max(costs):.0f})"
    return [["a checkpoint of figure 16", PAIRS, 0, cost], ["its film", 1, 0, f"{size:.1f} bytes a pixel"]]


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
    sys.exit(any(wrong for _, _, wrong, _ in rows))


if __name__ == "__main__":
    main()
