"""What the convergence report measures on one scene: the reference of each renderer, then its ladder of renders."""

import hashlib
import os
import statistics
from dataclasses import dataclass

import numpy as np

import convergence_pictures as pictures
from convergence_renderers import RAW, Failed, describe, say

FIRST_SPP = 4  # of the ladders: fewer give limn no estimate of its error
PILOT_SPP = 16
LARGEST_SPP = 1 << 20
REFERENCE_SEEDS = (1001, 1002)


@dataclass(frozen=True)
class Plan:
    size: int  # pixels a side
    seeds: int
    growth: int  # of samples from rung to rung
    cap: float  # seconds of a render on one thread, beyond which a ladder ends
    reference: float  # seconds of each half of a reference, on all threads


def threads_here():
    return len(os.sched_getaffinity(0))


def reference_path(renderer, scene, description, plan):
    told = repr((renderer.about["settings"], plan.reference)).encode()
    mark = hashlib.sha256(description.read_bytes() + renderer.identity() + told).hexdigest()[:12]
    return RAW / f"reference_{scene}_{renderer.key}_{plan.size}_{mark}.npz"


def reference(renderer, scene, description, plan):
    """Two independent halves, each of about the plan's seconds. Kept as long as scene and renderer stay the same."""
    path = reference_path(renderer, scene, description, plan)
    if path.exists():
        kept = np.load(path)
        return kept["halves"], int(kept["spp"])
    pilot = renderer.render(plan.size, PILOT_SPP, 1, threads_here())[1]  # compiles too, where there is a compiler
    pilot = renderer.render(plan.size, PILOT_SPP, 2, threads_here())[1]
    spp = PILOT_SPP
    while spp < LARGEST_SPP and 1.5 * spp * pilot["render"] / PILOT_SPP < plan.reference:
        spp *= 2
    halves = np.array([renderer.render(plan.size, spp, seed, threads_here())[0] for seed in REFERENCE_SEEDS],
                      dtype=np.float64)
    np.savez(path, halves=halves, spp=spp)
    return halves, spp


def has_own_reference(key):
    """All of limn's steps are judged by one reference; that by scattering alone is there to check it."""
    return not key.startswith("limn-") or key == "limn-naive"


def empty_rung(spp):
    return {"spp": spp, "seconds": [], "errors": [], "rays": [], "estimates": [], "inside": 0}


def add(rung, told, error):
    rung["seconds"].append(told["render"])
    rung["errors"].append(error)
    if "rays" in told:
        rung["rays"].append(told["rays"])
    if "error" in told:
        e = told["error"]
        rung["estimates"].append(e["estimate"])
        rung["inside"] += None not in (e["ci95_low"], e["ci95_high"]) and e["ci95_low"] <= error <= e["ci95_high"]


def can_go_on(key, plan, rows):
    """Whether the next rung is short enough, and this one not yet better than what it is judged by."""
    rung = rows[key]["rungs"][-1]
    judged_by = rows["limn" if key.startswith("limn") else key]["reference"]["error"]
    return (plan.growth * statistics.median(rung["seconds"]) <= plan.cap
            and statistics.mean(rung["errors"]) > judged_by)


def climb(active, halves_of, plan, rows):
    """The ladders on one thread, the renderers taking turns on each rung and seed."""
    spp = FIRST_SPP
    while active and spp <= LARGEST_SPP:
        for seed in range(1, plan.seeds + 1):
            for renderer in list(active):
                try:
                    picture, told = renderer.render(plan.size, spp, seed, 1)
                except Failed as problem:
                    rows[renderer.key]["failed"] = str(problem)
                    active.remove(renderer)
                    continue
                rungs = rows[renderer.key]["rungs"]
                if seed == 1:
                    rungs.append(empty_rung(told["spp"]))
                add(rungs[-1], told, pictures.corrected_relmse(picture.astype(np.float64), halves_of[renderer.key]))
        active = [r for r in active if can_go_on(r.key, plan, rows)]
        spp *= plan.growth


def rate_on_all_threads(renderers, plan, rows):
    """Samples a second; the error of a number of samples does not depend on threads."""
    for seed in (1, 2):
        for renderer in renderers:
            row = rows[renderer.key]
            if "failed" in row or not row["rungs"]:
                continue
            try:
                told = renderer.render(plan.size, round(row["rungs"][-1]["spp"]), seed, threads_here())[1]
            except Failed as problem:
                row["failed"] = str(problem)
                continue
            row.setdefault("all_threads", []).append(told["spp"] * plan.size**2 / told["render"])


def measure(scene, renderers, plan):
    """One row for each renderer, by key; limn's is one of them. Those that cannot express the scene say why.
    Raises Failed where limn cannot render it."""
    description, rows, halves_of, able = describe(scene), {}, {}, []
    for renderer in renderers:
        row = rows[renderer.key] = {"name": renderer.name, **renderer.about, "rungs": []}
        try:
            row["seconds"] = {**renderer.about["seconds"], **renderer.open(scene, description)}
            row["seconds"]["setup"] = renderer.render(plan.size, 1, 1, 1)[1]["setup"]
            if has_own_reference(renderer.key):
                halves, spp = reference(renderer, scene, description, plan)
                row["reference"] = {"spp": spp, "error": pictures.half_error(halves)}
                halves_of[renderer.key] = halves
        except Failed as problem:
            if renderer.key == "limn":
                raise
            say(f"{scene}: without {renderer.key}: {problem}")
            row["failed"] = str(problem)
            continue
        able.append(renderer)
    ours = halves_of["limn"]
    for key, halves in halves_of.items():
        if key != "limn":
            rows[key]["agreement"] = pictures.agreement(ours, halves)
    halves_of.update({r.key: ours for r in able if r.key.startswith("limn-")})
    climb(list(able), halves_of, plan, rows)
    rate_on_all_threads(able, plan, rows)
    return rows
