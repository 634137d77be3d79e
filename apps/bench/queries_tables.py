"""The tables of the report on queries, from plain numbers: wrong answers, and speeds beside their goals."""

from dataclasses import dataclass

NAMES = {"limn": "limn", "embreex": "embreex (through trimesh)", "open3d": "Open3D", "trimesh": "trimesh's own",
         "cgal": "CGAL, exact predicates"}
MODULES = NAMES | {"limn.open3d": "limn.open3d", "limn.trimesh": "limn.trimesh"}
THREADS = {1: "one thread", 0: "all threads"}


@dataclass(frozen=True)
class Pair:
    """A question from Python to limn and to another library, and how many times as fast limn should be."""

    question: str  # the method of query_worker.py
    words: str
    ours: str
    theirs: str
    goal: float


# Like with like: front ends of the same interface, on the same arrays.
PAIRS = (
    Pair("cast", "`cast_rays`", "limn", "open3d", 1.5),
    Pair("cast", "`cast_rays`", "limn.open3d", "open3d", 1.5),
    Pair("location", "`intersects_location`", "limn.trimesh", "embreex", 2),
    Pair("first", "`intersects_first`", "limn.trimesh", "embreex", 2),
    Pair("location", "`intersects_location`", "limn.trimesh", "trimesh", 2),
    Pair("contains", "`contains_points`", "limn.trimesh", "embreex", 10),
    Pair("contains", "`contains_points`", "limn.trimesh", "trimesh", 10),
)
THREADED = ("limn", "limn.open3d", "limn.trimesh", "open3d")  # trimesh's own and embreex have no threads
GOAL_CGAL, GOAL_ALL_HITS, GOAL_MOVE = 20, 1.3, 5  # GOAL_MOVE: milliseconds
IN_CPP = {"nearest": "single rays", "nearest_batch": "a batch, one thread", "nearest_threads": "a batch, all threads"}
ONE_HIT = {"": "single rays", "_batch": "batches"}


def threads_of(library, threads):
    """How many the library can be asked on."""
    return threads if library in THREADED else 1


def number(value):
    """Three digits, plain."""
    return "–" if value is None else f"{value:,.0f}" if value >= 99.95 else f"{float(f'{value:.3g}'):.9g}"


def row(what, ours, theirs, times, goal, least):
    """`times`: ours to theirs, bold where it falls short of the goal as it is printed; `least`: what it should be at
    least, otherwise at most."""
    text = "–"
    if times is not None:
        text = f"{times:,.0f}" if times >= 99.95 else f"{times:.2f}"
        printed = float(text.replace(",", ""))
        text = text if (printed >= goal if least else printed <= goal) else f"**{text}**"
    return f"| {what} | {number(ours)} | {number(theirs)} | {text} | at {'least' if least else 'most'} {goal:g} |"


def speed(what, ours, theirs, goal):
    """A row of what should be faster."""
    return row(what, ours, theirs, None if ours is None or theirs is None else ours / theirs, goal, True)


def python_rows(mesh, rates):
    """`rates`: millions a second by question, library and threads, None where there is no such number."""
    rows = []
    for pair in PAIRS:
        for threads, words in THREADS.items():
            theirs = threads_of(pair.theirs, threads)
            alone = "" if theirs == threads else " on its one"
            what = f"{mesh}, {pair.words}, {words}: {MODULES[pair.ours]}, {MODULES[pair.theirs]}{alone}"
            rows.append(speed(what, rates.get((pair.question, pair.ours, threads)),
                              rates.get((pair.question, pair.theirs, theirs)), pair.goal))
    return rows


def cpp_rows(mesh, limn, cgal):
    """`limn`: of limn_query_rates; `cgal`: seconds for the same rays, or None."""
    rate = lambda seconds: seconds and limn["rays"] / seconds / 1e6
    return [speed(f"{mesh}, nearest hits in C++, {words}: limn, CGAL{' on one' * ('all' in words)}", rate(limn[key]),
                  rate(cgal), GOAL_CGAL) for key, words in IN_CPP.items()]


def one_hit_rows(mesh, limn):
    rows = []
    for key, words in ONE_HIT.items():
        ours, theirs = (1e9 * limn[f"one_hit_{which}{key}"] / limn["one_hit_rays"] for which in ("all", "nearest"))
        what = f"{mesh}, nanoseconds for a ray with one hit, {words}: `all_hits`, `closest_hit`"
        rows.append(row(what, ours, theirs, ours / theirs, GOAL_ALL_HITS, False))
    return rows


def move_row(mesh, seconds):
    text = f"{1e3 * seconds:.2f}"
    text = text if float(text) < GOAL_MOVE else f"**{text}**"
    return f"| {mesh}, milliseconds of `recompile`, 10,000 moved instances | {text} | – | – | under {GOAL_MOVE} |"


def speeds(rates, times):
    """Two tables of rows as made above."""
    head = ["", "| | first | second | first / second | goal |", "|---|---|---|---|---|"]
    return "\n".join(["Million rays or points a second. What falls short of its goal is bold.", *head, *rates, "",
                      "Times, each the least of several rounds.", *head, *times])


def cell(values):
    if values is None:
        return "failed"
    return " / ".join("–" if value is None else f"{value:,.0f}" for value in values)


def wrong_answers(libraries, rows):
    """`rows`: words, and for each library [nearest hits, counts] that are wrong, a million."""
    lines = ["| rays | " + " | ".join(NAMES[one] for one in libraries) + " |", "|---" * (1 + len(libraries)) + "|"]
    lines += [f"| {words} | " + " | ".join(cell(found[one]) for one in libraries) + " |" for words, found in rows]
    return "\n".join(lines)
