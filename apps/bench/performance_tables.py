"""The tables of the performance report, what counts as a fault, and which goals are missed."""

import statistics

from reports import stamp

GOAL_DEFAULT, GOAL_ROBUST, GOAL_BATCH, GOAL_BUILD = 1.0, 1.3, 1.3, 1.0
GOAL_SCALING, GOAL_BYTES, GOAL_INSTRUCTIONS = 1.9, 64, 1.01
RATIOS = (("single_to_default", GOAL_DEFAULT), ("single_to_robust", GOAL_ROBUST), ("batch_to_best", GOAL_BATCH))


def is_plain_mesh(scene):
    return scene["name"] in ("displaced sphere", "soup") or scene["name"].endswith(".obj")


def marked(text, good):
    return text if good else f"**{text}**"


def spread(r):
    return "–" if r is None else f"{r['median']:.2f} ({r['low']:.2f}..{r['high']:.2f})"


def ratio_cell(r, goal):
    return marked(spread(r), r is None or r["median"] >= goal)


def rate(row, name):
    found = [s["million_a_second"] for s in row["subjects"] if s["name"] == name]
    return f"{found[0]:.2f}" if found else "–"


def percent(x):
    return f"{100 * (x - 1):+.2f} %"


def of_threads(scene, threads):
    return [row for row in scene["rows"] if row["threads"] == threads]


def all_threads(scene):
    return max((row["threads"] for row in scene["rows"]), default=1)


def scaling(scene):
    """Kind of rays, and by how much all threads are faster than one: limn single, limn batch, Embree."""
    rows = []
    many = {row["rays"]: row for row in of_threads(scene, all_threads(scene))}
    for row in of_threads(scene, 1):
        by_name = [{s["name"]: s["million_a_second"] for s in r["subjects"]} for r in (row, many[row["rays"]])]
        rows.append((row["rays"], [by_name[1][n] / by_name[0][n] if n in by_name[0] and n in by_name[1] else None
                                   for n in ("limn", "limn batch", "Embree")]))
    return rows


def bytes_each(scene, name):
    return scene["bytes"][name] / scene["primitives"] if name in scene["bytes"] else None


def faults(table, content, truth):
    """One line for each result that is wrong. `content`: whether limn bench ended well."""
    found = [] if content else ["limn bench: single rays and batches differ"]
    found += [f"{t['scene']}, {t['rays']}: {t['wrong']} of {t['judged']} results are wrong: {t['first']}"
              for t in truth if t["wrong"]]
    for scene in table["scenes"]:
        found += [f"{scene['name']}, {row['rays']}: {row['differences']} rays have other results in batches"
                  for row in scene["rows"] if row["differences"]]
    return found


def missed(raw):
    """One line for each cell that falls short of its goal."""
    found = []
    for scene in raw["table"]["scenes"]:
        for row in scene["rows"]:
            for key, goal in RATIOS:
                if row[key] is not None and row[key]["median"] < goal:
                    found.append(f"{scene['name']}, {row['rays']}, {row['threads']} threads: {key}")
        for build in scene["builds"]:
            r = build["ratios"].get("Embree")
            if r and r["median"] < GOAL_BUILD:
                found.append(f"{scene['name']}, built by {build['threads']} threads")
        if all_threads(scene) == 2:
            found += [f"{scene['name']}, {kind}: scaling" for kind, ratios in scaling(scene)
                      if any(r is not None and r < GOAL_SCALING for r in ratios[:2])]
        if is_plain_mesh(scene) and bytes_each(scene, "limn") > GOAL_BYTES:
            found.append(f"{scene['name']}: bytes")
    for feature, lean in raw["instructions"]["without"].items():
        found += [f"instructions, {feature}: {name}" for name, n in lean["counts"].items()
                  if raw["instructions"]["whole"][name] / n > GOAL_INSTRUCTIONS]
    return found + [f"instructions, a user-defined sphere aside: {name}"
                    for name, n in raw["instructions"]["user_defined"]["counts"].items()
                    if n / raw["instructions"]["whole"][name] > GOAL_INSTRUCTIONS]


def ray_table(scene, threads):
    lines = ["| rays | limn | limn, batches | Embree | Embree robust | Embree's best mode | "
             "limn / Embree | limn / robust | batches / best | Embree differs, a million |",
             "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|"]
    for row in of_threads(scene, threads):
        best = row["batch_to_best"]
        mode = f"{rate(row, best['to'])} ({best['to'].removeprefix('Embree').strip() or 'single'})" if best else "–"
        batch = rate(row, best["of"]) if best else rate(row, "limn batch")
        differ = [1e6 * s["mismatches"] / row["count"] for s in row["subjects"] if s["name"] == "Embree"]
        cells = [row["rays"], rate(row, "limn"), batch, rate(row, "Embree"), rate(row, "Embree robust"), mode]
        cells += [ratio_cell(row[key], goal) for key, goal in RATIOS]
        lines.append("| " + " | ".join(cells + [f"{differ[0]:.0f}" if differ else "–"]) + " |")
    return lines + [""]


def table_section(raw):
    lines = ["## Rays a second", "",
             "In millions; ratios are medians over the rounds with their quartiles, each round letting all take their "
             "turn; one thread by its processor time, several by the clock. Batches are spans of rays given to one call. Embree's best mode is the fastest of single rays, "
             "packets of 4, 8, 16 and streams of single rays (1M) or of packets (16M), each with its flag for coherent "
             "rays where the rays are. Bold: short of the goal, 1.0 against Embree, 1.3 against robust Embree and "
             "against the best mode. Embree differs: hit for miss, or t by more than a thousandth.", ""]
    for scene in raw["table"]["scenes"]:
        for threads in sorted({row["threads"] for row in scene["rows"]}):
            lines += [f"### {scene['name']}, {threads} thread{'s' if threads > 1 else ''}", ""]
            lines += ray_table(scene, threads)
    return lines


def build_section(raw):
    lines = ["## Building and memory", "",
             "`compile()` against `rtcCommitScene` at medium quality; Embree / limn over 1 says that limn is faster. "
             "Bytes are all that a compiled scene holds, the arrays of meshes included; the goal is 64 for plain meshes.",
             "", "| scene | primitives | threads | limn, s | Embree, s | Embree / limn | limn, bytes each | "
             "Embree, bytes each |", "|---|---:|---:|---:|---:|---:|---:|---:|"]
    for scene in raw["table"]["scenes"]:
        for build in scene["builds"]:
            own, theirs = (statistics.median(build["seconds"][n]) if build["seconds"].get(n) else None
                           for n in ("limn", "Embree"))
            size, their_size = bytes_each(scene, "limn"), bytes_each(scene, "Embree")
            lines.append(f"| {scene['name']} | {scene['primitives']:,} | {build['threads']} | {own:.4f} | "
                         + (f"{theirs:.4f}" if theirs else "–") + " | "
                         + ratio_cell(build["ratios"].get("Embree"), GOAL_BUILD) + " | "
                         + marked(f"{size:.1f}", not is_plain_mesh(scene) or size <= GOAL_BYTES) + " | "
                         + (f"{their_size:.1f}" if their_size else "–") + " |")
    return lines + [""]


def scaling_section(raw):
    lines = ["## Threads", "", "How much faster all threads are than one, by medians. The goal is 1.9 on two.", "",
             "| scene | rays | threads | limn | limn, batches | Embree |", "|---|---|---:|---:|---:|---:|"]
    for scene in raw["table"]["scenes"]:
        threads = all_threads(scene)
        if threads == 1:
            continue
        for kind, ratios in scaling(scene):
            cells = ["–" if r is None else marked(f"{r:.2f}", i == 2 or threads != 2 or r >= GOAL_SCALING)
                     for i, r in enumerate(ratios)]
            lines.append(f"| {scene['name']} | {kind} | {threads} | " + " | ".join(cells) + " |")
    return lines + [""]


def growth_section(raw):
    lines = ["## Growing scenes", "", "One thread.", "", "![Build time, memory and speed over the number of triangles]"
             "(performance/growth.svg)", "",
             "| scene | triangles | limn builds, ns each | Embree builds, ns each | limn, bytes each | "
             "Embree, bytes each | limn primary, M/s | Embree primary, M/s | limn diffuse1, M/s | "
             "Embree diffuse1, M/s |", "|---|---:|" + "---:|" * 8]
    for scenes in raw["growth"].values():
        for scene in scenes:
            seconds = scene["builds"][0]["seconds"]
            cells = [scene["name"], f"{scene['primitives']:,}"]
            for name in ("limn", "Embree"):
                cells.append(f"{1e9 * statistics.median(seconds[name]) / scene['primitives']:.0f}"
                             if seconds.get(name) else "–")
            for name in ("limn", "Embree"):
                size = bytes_each(scene, name)
                cells.append(f"{size:.1f}" if size else "–")
            for kind in ("primary", "diffuse1"):
                row = [r for r in scene["rows"] if r["rays"] == kind]
                cells += [rate(row[0], name) if row else "–" for name in ("limn", "Embree")]
            lines.append("| " + " | ".join(cells) + " |")
    return lines + [""]


def median_text(ratios):
    return percent(statistics.median(ratios)) if ratios else "–"


def instruction_section(raw):
    measured = raw["instructions"]
    names = list(measured["whole"])
    lines = ["## Only what a scene needs", "",
             "Instructions a ray of a scene of one mesh (20,000 triangles, no material but one of one colour), counted "
             "by callgrind, which runs the code for AVX2: in limn as it is, and how many more that is than in a build "
             "without a feature. The goal is at most 1 % more. In brackets the same by time, on the code for this "
             "processor, the two programs by turns. `render` is a small picture of paths of four segments before a "
             "background, `lamps` the same under two lamps.", "",
             "| | " + " | ".join(n.replace("_", ", ") for n in names) + " |", "|---|" + "---:|" * len(names),
             "| instructions a ray | " + " | ".join(f"{measured['whole'][n]:,.0f}" for n in names) + " |"]
    for feature, lean in measured["without"].items():
        cells = []
        for n in names:
            more = measured["whole"][n] / lean["counts"][n]
            cells.append(marked(percent(more), more <= GOAL_INSTRUCTIONS) + f" ({median_text(lean['times'].get(n))})")
        lines.append(f"| with code for {feature} | " + " | ".join(cells) + " |")
    aside = measured["user_defined"]
    def with_user_defined(n):
        more = aside["counts"][n] / measured["whole"][n]
        return marked(percent(more), more <= GOAL_INSTRUCTIONS) + f" ({median_text(aside['times'].get(n))})"

    lines += ["", "The other way round: a user-defined sphere is beside the mesh, and the rays are those that miss its "
              "box. The goal is the same.", "",
              "| | " + " | ".join(n.replace("_", ", ") for n in aside["counts"]) + " |",
              "|---|" + "---:|" * len(aside["counts"]),
              "| with a user-defined sphere | " + " | ".join(map(with_user_defined, aside["counts"])) + " |", ""]
    return lines


def truth_section(raw):
    judged, wrong = (sum(t[k] for t in raw["truth"]) for k in ("judged", "wrong"))
    return ["## Results", "",
            f"limn's single rays and batches give the same bits for every ray above. {judged:,} of the rays, of every "
            f"scene and kind, were judged by exact arithmetic over all primitives: {wrong} results are wrong.", ""]


def summary_section(raw):
    lines = ["On one thread, limn over Embree; over 1 limn is faster, or takes less memory. Of rays geometric means "
             "over their kinds; batches against Embree's best mode.", "",
             "| scene | single rays / Embree | / robust | batches, primary | batches, other rays | building | memory |",
             "|---|" + "---:|" * 6]
    for scene in raw["table"]["scenes"]:
        rows = of_threads(scene, 1)
        other = [row for row in rows if row["rays"] != "primary"]
        cells = [mean_of(rows, "single_to_default"), mean_of(rows, "single_to_robust"),
                 mean_of([row for row in rows if row["rays"] == "primary"], "batch_to_best"),
                 mean_of(other, "batch_to_best")]
        built = [b["ratios"]["Embree"]["median"] for b in scene["builds"] if b["threads"] == 1 and "Embree" in b["ratios"]]
        own, theirs = bytes_each(scene, "limn"), bytes_each(scene, "Embree")
        cells += [built[0] if built else None, theirs / own if theirs else None]
        lines.append(f"| {scene['name']} | " + " | ".join("–" if c is None else f"{c:.2f}" for c in cells) + " |")
    return lines + [""]


def mean_of(rows, key):
    """The geometric mean of the ratios of some rows; None where there are none."""
    found = [row[key]["median"] for row in rows if row[key] is not None]
    return statistics.geometric_mean(found) if found else None


def report(raw):
    head, short = raw["head"], missed(raw)
    cells = sum(row[key] is not None for s in raw["table"]["scenes"] for row in s["rows"] for key, _ in RATIOS)
    of_rays = sum(1 for line in short if line.rsplit(": ", 1)[-1] in dict(RATIOS))
    lines = [f"{stamp(head)}, Embree {raw['table']['versions'].get('Embree', 'is not installed')}, "
             f"{head['minutes']:.0f} minutes. Only ratios of one run compare.", "",
             f"Of {cells} ratios of rays {cells - of_rays} reach their goal.", "",
             "![Ratios of single rays and batches](performance/ratios.svg)", ""]
    lines += [f"- **fault: {fault}**" for fault in raw["faults"]] + [""] * bool(raw["faults"])
    for section in (summary_section, table_section, truth_section, build_section, scaling_section, growth_section, instruction_section):
        lines += section(raw)
    return "\n".join(lines).rstrip() + "\n"
