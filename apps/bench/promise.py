"""Measures how good limn's estimate of its own error is. Used by convergence.py --promise."""

import os
import statistics
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from renderers import SCENES, SCENES_OF_LIMN, compare, limn
from results import table

SCENES = SCENES[:10] + SCENES_OF_LIMN
SIZE = 64
SAMPLES = (8, 16, 32, 64, 256)
TARGETS = (3e-2, 1e-2, 1e-3, 1e-4)


def measure(scene, seeds):
    """Renders to given numbers of samples and to given errors. Returns the estimated and the true error of each."""
    print(f"promise: {scene}", file=sys.stderr, flush=True)
    finest = 1e-2 if scene == "glass-mesh" else TARGETS[-1]  # a smaller error would take hours there
    tasks = [("spp", samples, seed) for samples in SAMPLES for seed in range(1, seeds + 1)]
    tasks += [("error", target, seed) for target in TARGETS if target >= finest for seed in range(1, seeds + 1)]
    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        halves = [Path(name) / "a.exr", Path(name) / "b.exr"]
        for seed, half in enumerate(halves, 1_000_001):
            limn(scene, half, SIZE, f"--error={finest / 8}", f"--seed={seed}")

        def render(option, value, seed):
            picture = Path(name) / f"{option}-{value}-{seed}.exr"
            report = limn(scene, picture, SIZE, f"--{option}={value}", f"--seed={seed}", "--threads=1")
            return {option: value, "samples": report["spp"], "known": report["error"],
                    "true": compare(picture, *halves)["corrected_relmse"]}

        return list(pool.map(render, *zip(*tasks)))


def share(cases):
    """Returns how many of the cases are true, as text."""
    return f"{sum(cases)} of {len(cases)}, {100 * sum(cases) / max(1, len(cases)):.0f} %"


def coverage_rows(scenes):
    together = {samples: [] for samples in SAMPLES}
    for scene, renders in scenes.items():
        cells = []
        for samples in SAMPLES:
            known = [r for r in renders if r.get("spp") == samples and r["known"]["estimate"] is not None]
            held = [r["known"]["ci95_low"] <= r["true"] <= r["known"]["ci95_high"] for r in known]
            together[samples] += held
            estimate, true = sum(r["known"]["estimate"] for r in known), sum(r["true"] for r in known)
            cells.append(f"{estimate / true:.2f}; {sum(held)} of {len(held)}" if known else "–")
        yield [scene, *cells]
    yield ["together", *(share(held) for held in together.values())]


def stop_rows(scenes):
    together = []
    for scene, renders in scenes.items():
        for target in TARGETS:
            stops = [r for r in renders if r.get("error") == target]
            kept = [r["true"] <= target for r in stops]
            together += kept
            if stops:
                yield [scene, f"{target:g}", share(kept), f"{statistics.median(r['samples'] for r in stops):.0f}",
                       f"{statistics.median(target / r['true'] for r in stops):.2f}"]
    yield ["together", "", share(together), "", ""]


def page(scenes, seeds):
    return f"""{SIZE}x{SIZE} pixels, {seeds} seeds.

## How good the estimate is

The cell of a scene has the estimate over the true relMSE, both as means over the seeds that have an estimate. Then it
says in how many of these renders the 95 % interval holds the true error. The row "together" has only the latter.

{table(["scene", *(f"{samples} samples" for samples in SAMPLES)], list(coverage_rows(scenes)))}

## How often --error is kept

It is kept if the true relMSE is at or under the target.

{table(["scene", "target", "kept", "samples, median", "target / true error, median"], list(stop_rows(scenes)))}"""
