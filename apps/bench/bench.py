"""Compares limn with Embree in tracing and building, and with Open3D, trimesh and embreex in queries.

Run it by ./build.sh bench. The exit status is 1 if a result is wrong. An interrupted run continues with what is not
measured yet. The times mean little if the machine runs other programs."""

import argparse
import os
import subprocess
import sys
from pathlib import Path
from statistics import geometric_mean, median

from results import BIN, ROOT, Kept, origin, quartiles, run_json, spread, table, write

SCENES = ("sphere", "soup", "spheres", "cornell", "forest")
PARTS = (*SCENES, "growth", "queries")
GROWTH = {"sphere": 2e6, "soup": 1e6}  # number of triangles with --scale 1
BATCHES = {"limn batch 1": 1, "limn batch 8": 8, "limn batch 64": 64, "limn batch": 4096, "limn batch 65536": 65536}
LIMN_BENCH = (BIN / "limn", "bench", "--quiet", "--json", "-")
RATIOS = (("limn", "Embree"), ("limn", "Embree robust"), ("batch", "best mode"))
PACKAGES = ("numpy", "scipy", "rtree", "pillow", "trimesh", "embreex", "open3d")
HEAD = """A ratio over 1 says that limn is faster. Ratios are medians of interleaved rounds, with quartiles.
In the first table they are geometric means over the kinds of rays. `batch` is the fastest of limn's batches. `best
mode` is the fastest of Embree's modes: single rays, packets of 4, 8 and 16, streams (1M, 16M)."""


def ask_peers(*arguments):
    """Installs limn and the other libraries in a virtual environment, and returns what queries.py prints."""
    raw, python = ROOT / "build/queries", ROOT / "build/query-peers/bin/python"
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    for command in ([sys.executable, "-m", "venv", python.parents[1]],
                    ["cmake", "--install", ROOT / "build/release", "--prefix", raw / "limn"],
                    [*pip, "--force-reinstall", "--no-deps", f"--config-settings=build-dir={raw}/wheel",
                     "--config-settings=cmake.define.LIMN_INSTALLED=ON",
                     f"--config-settings=cmake.define.CMAKE_PREFIX_PATH={raw}/limn", ROOT]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    for package in PACKAGES:
        subprocess.run([*pip, package])  # a library that can't be installed has no results
    return run_json(python, "-B", ROOT / "apps/bench/queries.py", *arguments)


def subject(row, name):
    """Returns the subject of a row that has the name, or else {}. HEAD defines the names "batch" and "best mode"."""
    fits = {"batch": lambda s: s["name"].startswith("limn batch"),
            "best mode": lambda s: s["name"].startswith("Embree") and s["name"] != "Embree robust"}
    found = filter(fits.get(name, lambda s: s["name"] == name), row["subjects"])
    return max(found, key=lambda s: s["million_a_second"], default={})


def ratio(a, b):
    """Returns the quartiles over the rounds of the times b divided by the times a, or None if one is missing."""
    return quartiles([y / x for x, y in zip(a, b)]) if a and b else None


def ray_ratio(row, ours, theirs):
    return ratio(*(subject(row, name).get("seconds") for name in (ours, theirs)))


def number(x, digits=2):
    return "–" if x is None else f"{x:,.{digits}f}"


def rows_of(scenes, threads=1):
    return [(f"{scene['name']}, {row['rays']}", row) for scene in scenes for row in scene["rows"]
            if row["threads"] == threads]


def summary(scenes):
    def means(rows):
        found = [[r[1] for _, row in rows if (r := ray_ratio(row, *pair))] for pair in RATIOS]
        return [number(geometric_mean(ratios)) if ratios else "–" for ratios in found]

    rows = [[scene["name"], *means(rows_of([scene]))] for scene in scenes]
    return table(["one thread", *map(" / ".join, RATIOS)], [*rows, ["all", *means(rows_of(scenes))]])


def ray_tables(scenes):
    """Returns tables of rates, of batches (and of the best instruction set over AVX2), and of all threads over one."""
    columns = ["limn", "batch", "Embree", "Embree robust", "best mode"]
    rate = lambda row, name: subject(row, name).get("million_a_second")
    gains = [r for r in (("limn", "AVX2"), ("limn batch", "AVX2 batch")) if subject(scenes[0]["rows"][0], r[1])]
    rates, batches, threads = [], [], []
    most = max(row["threads"] for scene in scenes for row in scene["rows"])
    for (name, row), (_, many) in zip(rows_of(scenes), rows_of(scenes, most)):
        plain, best = subject(row, "Embree"), subject(row, "best mode")
        rates.append([name, *(number(rate(row, c)) for c in columns), best["name"][7:] or "1" if best else "–",
                      *(spread(ray_ratio(row, *r)) for r in RATIOS),
                      number(1e6 * plain["mismatches"] / row["count"] if plain else None, 0)])
        batches.append([name, *(spread(ray_ratio(row, batch, "limn")) for batch in BATCHES),
                        *(spread(ray_ratio(row, *r)) for r in gains)])
        threads.append([name, *(number(rate(row, c) and rate(many, c) / rate(row, c)) for c in columns[:3])])
    return ("## Million rays a second\n\n" + table(["one thread", *columns, "mode", *map(" / ".join, RATIOS),
                                                    "Embree differs, a million"], rates),
            "## Batches over single rays\n\n" + table(["one thread", *(f"of {size}" for size in BATCHES.values()),
                                                       *map(" / ".join, gains)], batches),
            f"## {most} threads over one\n\n" + table(["", *columns[:3]], threads))


def building(scenes):
    rows = []
    for scene in scenes:
        for build in scene["builds"]:
            own, theirs = build["seconds"]["limn"], build["seconds"].get("Embree")
            rows.append([scene["name"], f"{scene['primitives']:,}", build["threads"], f"{median(own):.3g}",
                         f"{median(theirs):.3g}" if theirs else "–", spread(ratio(own, theirs)),
                         *(number(scene["bytes"].get(n, 0) / scene["primitives"], 1) for n in ("limn", "Embree"))])
    return "## Building and memory\n\n" + table(
        ["scene", "primitives", "threads", "limn, s", "Embree, s", "limn / Embree", "limn, bytes each",
         "Embree, bytes each"], rows)


def query_tables(results):
    """Returns two tables: wrong answers, and rates. limn answers by the interfaces of the other libraries."""
    text = lambda x: "–" if x is None else f"{x:,.0f}" if x >= 100 else f"{x:.3g}"
    tables, libraries = {"wrong": [], "rates": []}, list(next(iter(results.values())))
    for mesh, answers in results.items():
        for what, rows in tables.items():
            found = [one[what] if one else {} for one in answers.values()]
            for question in dict.fromkeys(question for one in found for question in one):
                cells = ([one.get(question)] if what == "rates" else one.get(question, [None]) for one in found)
                rows.append([f"{mesh}, {question}", *(" / ".join(map(text, cell)) for cell in cells)])
    return ("## Queries: wrong answers in a million", "Nearest hits / counts of hits whose parity contradicts whether "
            "the origin is inside. trimesh's interface counts each triangle at an edge.",
            table(["rays", *libraries], tables["wrong"]), "## Queries: million rays or points a second",
            table(["question, threads", *libraries], tables["rates"]))


def faults(results):
    found = [f"{t['scene']}, {t['rays']}: {t['wrong']} of {t['judged']} results are wrong: {t['first']}"
             for t in results.get("truth", []) if t["wrong"]]
    found += [f"{scene['name']}, {row['rays']}: {row['differences']} rays have other results in batches"
              for scene in results.get("rays", []) for row in scene["rows"] if row["differences"]]
    for mesh, answers in results.get("queries", {}).items():
        # Judge nearest hits and counts. By trimesh's interface counts differ, as it counts each triangle at an edge.
        for library, judged in (("limn.open3d", 2), ("limn.trimesh", 1)):
            if not answers[library] or any(any(wrong[:judged]) for wrong in answers[library]["wrong"].values()):
                found.append(f"{mesh}: {library} is wrong")
    return found


def measure(kept, options, models):
    results, chosen = {}, options.scene or PARTS
    scenes = [name for name in chosen if name in SCENES]
    rays, judged, asked, most = (2 ** 18, 200, 2000, 2e7) if options.full else (2 ** 17, 40, 200, 2e6)
    if scenes or models:
        named = [word for name in scenes for word in ("--scene", name)]
        results["rays"] = kept("rays", lambda: run_json(*LIMN_BENCH, *named, *models, "--rays", rays,
                                                        "--rounds", 9)["scenes"])
        results["truth"] = kept("truth", lambda: run_json(BIN / "limn_bench_truth", 1, 65536, judged, *scenes, *models))
    if "growth" in chosen:
        results["growth"] = [kept(f"{scene} {n}", lambda: run_json(
            *LIMN_BENCH, "--scene", scene, "--scale", n / whole, "--rays", 65536, "--rounds", 3,
            "--build-rounds", 3, "--threads", 1, "--kind", "primary", "--kind", "diffuse1")["scenes"][0])
            for scene, whole in GROWTH.items() for n in (1e3, 1e4, 1e5, 5e5, 2e6, 5e6, 2e7) if n <= most]
    if "queries" in chosen:
        results["queries"] = kept("queries", lambda: ask_peers(asked, 10 ** 6, *models))
    return results


def main():
    parser = argparse.ArgumentParser(prog="./build.sh bench", description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true", help="twice the rays, ten times the queries, growth to 2e7")
    parser.add_argument("--scene", action="append", choices=PARTS, help="measure this alone; repeatable (default: all)")
    parser.add_argument("models", nargs="*", metavar="MODEL.obj", help="a model to measure too")
    options = parser.parse_args()
    models = [Path(os.environ.get("LIMN_CALLER", ".")) / model for model in options.models]
    if missing := [str(model) for model in models if not model.is_file()]:
        parser.error(f"{', '.join(missing)}: there is no such file")
    # Measure.
    head = origin(" ".join(["./build.sh bench", *sys.argv[1:]]))
    kept = Kept("bench", **head)
    results = measure(kept, options, models)
    found = faults(results)
    # Write the page.
    parts = [f"**{fault}**" for fault in found]
    if "rays" in results:
        judged = sum(t["judged"] for t in results["truth"])
        parts += [HEAD, summary(results["rays"]), f"Exact arithmetic judged {judged:,} results of limn.",
                  *ray_tables(results["rays"]), building(results["rays"])]
    if "growth" in results:
        named = [{**scene, "name": f"{scene['name']}, {scene['primitives']:,}"} for scene in results["growth"]]
        parts += ["# Growth with the scene", building(named), ray_tables(named)[0]]
    if "queries" in results:
        parts += query_tables(results["queries"])
    write("bench", "Rays and queries", head, results, "\n\n".join(parts))
    kept.forget()
    sys.exit("\n".join(f"bench: {fault}" for fault in found) or 0)


if __name__ == "__main__":
    main()
