#!/usr/bin/env python3
"""What films cost: checkpoints, shards, merges. Writes docs/long-renders.md.

Run through ./build.sh films. Times are those of a quiet machine; each render is a process of its own.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import reports
from machine import ROOT

BIN = ROOT / "build/release/bin"
FIGURE = "fig16_volume_cornell_box"
ROUNDS = 5
LARGE = (3840, 2160)
LARGE_SHARDS = 64
TARGET = 1e-4
MACHINES = (1, 10, 100, 1000)
ROUNDS_FIGURE, ROUNDS_SIZE, ROUNDS_ERROR, ROUNDS_SHARDS, ROUNDS_SEEDS = "fig15_cornell_box", "96x96", 1e-3, 4, 50


def run(words, folder):
    """Seconds and peak MB."""
    begin = time.monotonic()
    process = subprocess.Popen([str(w) for w in words], cwd=folder, stdin=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"films: {' '.join(map(str, words))}: status {status}")
    return time.monotonic() - begin, usage.ru_maxrss / 1024


def render(folder, *options):
    return run([BIN / FIGURE, "--quiet", "--report", "r.json", *options], folder), json.loads((folder / "r.json").read_text())


def checkpoint_cost(folder):
    """Seconds that a checkpoint costs a render of 400x400 pixels on all processors, by pairs."""
    costs = []
    for _ in range(ROUNDS):
        times = {}
        for every in (None, 0.5):
            film = folder / "a.film"
            film.unlink(missing_ok=True)
            options = ["--checkpoint", film, "--every", every] if every else []
            times[every] = render(folder, "--spp", "160", "-o", "a.exr", *options)[1]["seconds"]["render"]
        costs.append((times[0.5] - times[None]) / (times[0.5] / 0.5))
    size = film.stat().st_size
    return {"cost": statistics.median(costs), "least": min(costs), "most": max(costs), "bytes": size / 160000}


def balance(folder, count):
    """The largest shard over the mean one, by rays."""
    rays = [render(folder, "--spp", "16", "--shard", f"{i}/{count}", "--film", "s.film")[1]["rays"]
            for i in range(1, count + 1)]
    return max(rays) / statistics.mean(rays) - 1


def large_merge(folder):
    size = "x".join(map(str, LARGE))
    save = []
    for i in range(1, LARGE_SHARDS + 1):
        (seconds, _), report = render(folder, "--size", size, "--spp", "2", "--shard", f"{i}/{LARGE_SHARDS}", "--film",
                                      f"{i}.film")
        save.append(seconds - report["seconds"]["render"])
    films = [f"{i}.film" for i in range(1, LARGE_SHARDS + 1)]
    seconds, memory = run([BIN / "limn", "merge", *films, "-o", "m.exr", "--quiet"], folder)
    alone, memory_alone = run([BIN / "limn", "merge", films[0], *films[1:], "--film", "m.film", "--quiet"], folder)
    _, memory_render = run([BIN / FIGURE, "--quiet", "--size", size, "--spp", "1", "-o", "one.exr"], folder)
    return {"seconds": seconds, "memory": memory, "film_seconds": alone, "film_memory": memory_alone,
            "render_memory": memory_render, "rest": statistics.median(save)}


def to_target(folder):
    report = render(folder, "--error", TARGET, "-o", "a.exr")[1]
    return {"seconds": report["seconds"]["render"], "spp": report["spp"]}


def in_rounds(folder, seed, reference):
    """One picture to ROUNDS_ERROR by shards in rounds, and one by one machine: samples of both, true error, rounds."""
    figure = [BIN / ROUNDS_FIGURE, "--quiet", "--size", ROUNDS_SIZE, "--seed", seed]
    goal, rounds, status = ["--spp", "8"], 0, 3
    for path in folder.glob("s-*.film"):
        path.unlink()
    films = [f"s-{i}.film" for i in range(1, ROUNDS_SHARDS + 1)]
    while status == 3:
        for i, film in enumerate(films, 1):
            run([*figure, *goal, "--shard", f"{i}/{ROUNDS_SHARDS}", "--film", film, "--resume", film], folder)
        status = subprocess.run([BIN / "limn", "merge", *films, "--quiet", "--error", str(ROUNDS_ERROR), "--plan", "plan",
                                 "-o", "s.exr", "--report", "s.json"], cwd=folder).returncode
        goal, rounds = ["--plan", "plan"], rounds + 1
    run([*figure, "--error", ROUNDS_ERROR, "-o", "one.exr", "--report", "one.json"], folder)
    compared = json.loads(subprocess.run([BIN / "limn", "compare", "s.exr", *reference, "--json", "-"], cwd=folder,
                                         capture_output=True, text=True, check=True).stdout)
    spp = [json.loads((folder / name).read_text())["spp"] for name in ("s.json", "one.json")]
    return {"more": spp[0] / spp[1], "kept": compared["corrected_relmse"] <= ROUNDS_ERROR, "rounds": rounds}


def all_rounds(folder):
    reference = []
    for seed in (1000, 1001):
        reference.append(f"reference-{seed}.exr")
        run([BIN / ROUNDS_FIGURE, "--quiet", "--size", ROUNDS_SIZE, "--seed", seed, "--spp", 16384, "-o", reference[-1]], folder)
    tried = [in_rounds(folder, seed, reference) for seed in range(1, ROUNDS_SEEDS + 1)]
    return {"kept": sum(t["kept"] for t in tried), "more": statistics.mean(t["more"] for t in tried),
            "most": max(t["more"] for t in tried), "rounds": statistics.median(t["rounds"] for t in tried)}


def table(found):
    """What N machines give, on paper."""
    pixels = LARGE[0] * LARGE[1]
    work = found["target"]["seconds"] * pixels / 160000
    merge, rest = found["merge"]["seconds"], found["merge"]["rest"]
    lines = ["| machines | rendering | uneven shards | starting, compiling, film | merging | in all | of the ideal |",
             "|---:|---:|---:|---:|---:|---:|---:|"]
    for n in MACHINES:
        share = work / n
        uneven = 0 if n == 1 else share * found["uneven"]
        join = 0 if n == 1 else merge
        whole = share + uneven + rest + join
        lines.append(f"| {n} | {share:.0f} s | {uneven:.0f} s | {rest:.1f} s | {join:.0f} s | {whole:.0f} s | "
                     f"{share / whole:.0%} |")
    return "\n".join(lines)


def main():
    head = reports.origin("films")
    kept = reports.Kept(ROOT / "build/films.json", sources=head["sources"])
    head = kept("head", lambda: head)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        cost = kept("checkpoint", lambda: checkpoint_cost(folder))
        uneven = {n: kept(f"balance {n}", lambda n=n: balance(folder, n)) for n in (7, 16, 64)}
        found = {"target": kept("target", lambda: to_target(folder)), "merge": kept("merge", lambda: large_merge(folder)),
                 "uneven": max(uneven[7], uneven[16])}
        rounds = kept("rounds", lambda: all_rounds(folder))
    merge = found["merge"]
    text = f"""{reports.stamp(head)}.

Figure 16 at 400x400. A checkpoint costs the render {cost['cost'] * 1000:.0f} ms ({cost['least'] * 1000:.0f} to {cost['most'] * 1000:.0f} in {ROUNDS} pairs of runs), so that one
a minute costs {cost['cost'] / 60:.2%}. A film has {cost['bytes']:.1f} bytes a pixel. The largest shard has {uneven[7]:.1%} more rays than the mean of 7,
{uneven[16]:.1%} of 16, {uneven[64]:.1%} of 64 (of ten tiles each).

Figure 16 at {LARGE[0]}x{LARGE[1]}: {LARGE_SHARDS} films are merged to a picture in {merge['seconds']:.1f} s, with the estimate of its error, the EXR and its
reading back; the peak of memory is {merge['memory']:.0f} MB, where a render of the whole picture has {merge['render_memory']:.0f} MB. To a film alone:
{merge['film_seconds']:.1f} s.

To a relMSE of {TARGET:g} it takes {found['target']['spp']:.0f} samples a pixel, {found['target']['seconds']:.0f} s at 400x400 on {head['cores']} processors. From all these, on paper, at
{LARGE[0]}x{LARGE[1]} by machines like this one:

{table(found)}

To an error of {ROUNDS_ERROR:g} in rounds, figure 15 at {ROUNDS_SIZE} by {ROUNDS_SHARDS} shards, {ROUNDS_SEEDS} seeds: {rounds['kept']} of the pictures have it, after {rounds['rounds']:.0f} rounds
(median), with {rounds['more']:.2f} times the samples of one machine in the mean and {rounds['most']:.2f} times at most.

With N machines in the same time the error is an N-th, or less where Sobol points gain."""
    reports.write("films", text)
    kept.forget()
    print(text)


if __name__ == "__main__":
    main()
