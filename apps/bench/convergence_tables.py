"""The tables of the convergence report. Pure: from what was measured to Markdown."""

import statistics

import convergence_numbers as numbers
from reports import stamp
from titles import SCENES

ERRORS = (1e-2, 1e-3, 1e-4)
GOAL = 0.5  # limn's seconds to relMSE 1e-3 over those of the best peer


def is_peer(key):
    return not key.startswith("limn")


def measured(rows):
    return {key: row for key, row in rows.items() if row["rungs"]}


def comparable(rows):
    """The peers whose converged picture is limn's."""
    return {key: row for key, row in measured(rows).items()
            if is_peer(key) and not numbers.solves_another_problem(row["agreement"])}


def amount(x):
    """Three digits, without exponents in the usual range."""
    return "–" if x is None else f"{x:.3g}" if x < 1000 else f"{x:.0f}"


def seconds_cell(row, error, faster=1.0):
    seconds, outside = numbers.seconds_to(error, numbers.mean_curve(row["rungs"]))
    if seconds is None:
        return "–"
    return ("~" if outside else "") + amount(seconds / faster)


def rate(row, what="spp", pixels=1):
    """Median of millions a second on one thread, over the rung that took longest."""
    rung = row["rungs"][-1]
    counts = rung["rays"] if what == "rays" else [rung["spp"] * pixels] * len(rung["seconds"])
    return statistics.median(1e-6 * n / s for n, s in zip(counts, rung["seconds"])) if counts else None


def speedup(row, pixels):
    """All threads over one, by samples a second."""
    if "all_threads" not in row:
        return None
    return 1e-6 * statistics.median(row["all_threads"]) / rate(row, pixels=pixels)


def agreement_cell(key, row):
    if "agreement" not in row:
        return "–"
    agreed = row["agreement"]
    text = f"{100 * agreed['difference']:.2f} % ± {100 * agreed['noise']:.2f}"
    return f"**{text}**" if numbers.solves_another_problem(agreed) else text


def renderer_table(rows, pixels, session):
    lines = ["| | s to 1e-2 | s to 1e-3 | s to 1e-4 | all threads: s to 1e-3 | M samples/s | all threads | M rays/s | "
             "slope | load, set up, s | blocks differ from limn's |", "|---|" + "---:|" * 10]
    for key, row in measured(rows).items():
        faster = speedup(row, pixels)
        cells = [seconds_cell(row, e) for e in ERRORS]
        cells.append("–" if faster is None else seconds_cell(row, 1e-3, faster))
        cells += [amount(rate(row, pixels=pixels)),
                  amount(None if faster is None else faster * rate(row, pixels=pixels)), amount(rate(row, "rays")),
                  "–" if len(row["rungs"]) < 2 else f"{numbers.slope_over_samples(row['rungs']):.2f}",
                  f"{amount(row['seconds']['load'])}, {amount(row['seconds']['setup'])}", agreement_cell(key, row)]
        mark = "" if row["session"] == session else " †"
        lines.append(f"| {row['name']}{mark} | " + " | ".join(cells) + " |")
    for row in rows.values():
        if "failed" in row:
            lines += ["", f"{row['name']}: {row['failed']}"]
    return lines + [""]


def ratio_cell(rows, error, goal):
    peers = {row["name"]: row["rungs"] for row in comparable(rows).values()}
    ours = rows["limn"]["rungs"]
    found = numbers.ratio_to_best(error, ours, peers) if peers and ours else None
    if found is None:
        return "–"
    middle, low, high, best = found
    text = f"{middle:.2f} ({low:.2f}..{high:.2f}) of {best}"
    return text if middle <= goal else f"**{text}**"


def summary(scenes):
    keys = [key for key in ("limn", "mitsuba", "cycles", "luxcore")
            if any(key in rows and rows[key]["rungs"] for rows in scenes.values())]
    names = [next(rows[key]["name"] for rows in scenes.values() if key in rows) for key in keys]
    lines = ["| scene | " + " | ".join(f"{name}, s" for name in names) + " | limn / best peer | the same at 1e-4 |",
             "|---|" + "---:|" * (len(keys) + 2)]
    for scene, rows in scenes.items():
        cells = [seconds_cell(rows[key], 1e-3) if key in rows else "–" for key in keys]
        cells += [ratio_cell(rows, 1e-3, GOAL), ratio_cell(rows, 1e-4, GOAL)]
        lines.append(f"| {SCENES[scene]} | " + " | ".join(cells) + " |")
    return lines + [""]


def estimate_table(row):
    lines = ["| samples | seconds | relMSE | film's own estimate | estimate / measured | "
             "measured within its 95 % interval |", "|---:|---:|---:|---:|---:|---:|"]
    for rung in row["rungs"]:
        known = [e for e in rung["estimates"] if e is not None]
        estimate, error = statistics.mean(known) if known else None, statistics.mean(rung["errors"])
        cells = [f"{rung['spp']:g}", amount(statistics.median(rung["seconds"])), f"{error:.2e}",
                 "–" if estimate is None else f"{estimate:.2e}",
                 "–" if estimate is None or error <= 0 else f"{estimate / error:.2f}",
                 f"{rung['inside']} of {len(rung['errors'])}"]
        lines.append("| " + " | ".join(cells) + " |")
    return lines + [""]


def who(scenes):
    """A line for each renderer, from the first scene that has it."""
    lines = {}
    for rows in scenes.values():
        for key, row in rows.items():
            if is_peer(key) or key == "limn":
                version = row["version"].removeprefix("limn ")
                starts = f"; starts in {amount(row['seconds']['start'])} s" if is_peer(key) else ""
                lines.setdefault(key, f"- {row['name']} {version}: {row['settings']}{starts}")
    return list(lines.values())


def plot(head):
    """The path of the plot, from docs."""
    return f"speed-against-error/curves-{head['size']}.svg"


def report(raw):
    head, scenes = raw["head"], {s: raw["scenes"][s] for s in SCENES if s in raw["scenes"]}
    size, pixels = f"{head['size']}x{head['size']}", head["size"] ** 2
    lines = [f"{stamp(head)}, {size} pixels, depth 10, {head['seeds']} seeds, "
             f"{head['minutes']:.0f} minutes.", ""] + who(scenes)
    lines += [f"- without {key}: {why}" for key, why in raw.get("missing", {}).items()]
    lines += ["", f"### Seconds to relMSE 1e-3, {size} pixels, one thread", "",
              "`~` is extrapolated. The ratio is limn's seconds over those of the fastest peer, with its 95 % interval; "
              f"bold where it is over {GOAL}.", ""] + summary(scenes)
    lines += [f"![error over time]({plot(head)})", ""]
    for scene, rows in scenes.items():
        session = rows["limn"]["session"]
        lines += [f"### {SCENES[scene][0].upper()}{SCENES[scene][1:]}, {size}", ""] + renderer_table(rows, pixels, session)
        if any(row.get("session") != session for row in rows.values()):
            lines += ["† Measured in another session.", ""]
        if rows["limn"]["rungs"]:
            lines += ["limn's estimate of its own error:", ""] + estimate_table(rows["limn"])
    return "\n".join(lines)
