"""The tables of the accuracy report, and what counts as a fault of limn."""

from reports import stamp

LIMIT_ULPS = 1  # of t in float32 ulps, of u and v in 2^-23
LIMIT_FURNACE = 1e-3
DEEP = "depth 1000"  # the furnace's column in which nothing that matters is cut and nothing ends by chance

TEXTS = {
    "leaks": ("Leaks of meshes",
              "Rays from inside a closed mesh of 20480 triangles, aimed at its vertices and at points of its edges, "
              "and rays at the inner edges of strips of 64 slivers. Such a ray has to hit, wherever float32 has put "
              "the vertices, because a closed surface separates its inside from the rest. Exact arithmetic checks "
              "each ray that a column misses all the same."),
    "quad leaks": ("Leaks of boxes made of quads",
                   "From inside six parallelograms that share their corners bit for bit, at corners and edges."),
    "spheres": ("Spheres", "Small ones far away, large ones near, the horizon of the latter, directions of any "
                "length."),
    "triangles": ("Triangles", "Random hits of an icosphere of 20480 triangles, rays nearly in the plane of a "
                  "triangle, slivers with two thirds of the rays aimed from 1e-9 to 1e-1 of their width beside an "
                  "edge."),
    "quads": ("Quads", "Nearly in the plane, a parallelogram that is almost a line, directions of any length."),
    "slabs": ("Boxes", "limn's box test may accept a box that a ray narrowly passes, which costs a visit. A box that is "
              "met and rejected would lose what is in it. Boxes are closed. Embree's box test cannot be run on its own."),
    "instances": ("Instances", "A unit sphere through a float32 matrix that turns, scales and moves it; eye 10 radii "
                  "away."),
    "leaving": ("Leaving a surface",
                "From each hit point a ray outward and one inward (at least 0.01 off the surface), and straight "
                "through gaps of 4e-5 radii. Self-hits: the ray hits the surface that it leaves again. Lost: the ray passes "
                "the other side of the body, or of the gap. The columns differ only in where the ray starts. In each of "
                "them limn's exact intersection decides what it hits."),
    "far origins": ("Origins far away", "Half of the rays parallel to an axis, half towards the origin."),
    "queries": ("Queries",
                "Rays aimed at vertices, edges and faces, in the planes of faces, along the axes and anywhere, and as "
                "many points on the surface, an ulp beside it and anywhere. All triangles are looked at for each: by "
                "a filter in double with a proven bound, then in exact arithmetic. All hits: each triangle that the "
                "ray meets, once, in order. Crossings: each passage of the ray as moved by the symbolic rule "
                "([queries](queries.md)), how many there are, and the winding number. Inside: the winding number of "
                "the point and whether it is on the surface. Nearest: the distance to 2⁻³², the triangle, the sign. "
                "Hits counted: who takes the number of hits for that of crossings."),
    "bad rays": ("Rays that cannot be used", "Each has to miss. The time is that of one such ray over that of a good "
                 "ray at the same mesh of 20480 triangles. Aborts: Embree has ended the process of its caller."),
    "furnace": ("Furnaces",
                "limn alone, by `render()`. In a uniform field a body that absorbs nothing is invisible; a closed "
                "room that glows with 1 and reflects a shows 1 / (1 - a). The cells are the mean's relative deviation "
                "± its standard error. A path that is cut loses its light, so that small depths must fall short; "
                "depth 1000 cuts nothing that matters, and unlimited depth ends paths by roulette."),
}


def is_limn(column):
    return column.startswith("limn")


def count(n):
    return f"{n:,}"


def size(x):
    return "0" if x == 0 else f"{x:.2g}" if x < 1e4 else f"{x:.0e}"


def per_million(n, asked):
    rate = 1e6 * n / asked
    return "0" if n == 0 else count(round(rate)) if rate >= 10 else f"{rate:.2g}"


def share(n, asked):
    return "0" if n == 0 else f"{100 * n / asked:.2g} %"


def is_wrong(group, column, cell):
    if group["measure"] == "furnace":
        if column == DEEP:
            return abs(cell["figure"]) > LIMIT_FURNACE
        return column == "unlimited" and abs(cell["figure"]) > LIMIT_FURNACE + 4.5 * cell["figure_error"]
    # What a program reads as infinite or NaN compares as no error within the limits.
    return is_limn(column) and (
        any(cell[k] for k in ("false_hits", "false_misses", "self_hits", "lost", "aborts"))
        or not cell["t_ulps"] <= LIMIT_ULPS or not cell["uv_ulps"] <= LIMIT_ULPS)


def faults(groups):
    """One line for each row that was not judged in full, and each cell of limn's that is not what it must be."""
    found = []
    for group in groups:
        for row in group["rows"]:
            if row["rays"] != row["judged"]:
                found.append(f"{group['group']}: {row['case']}: {row['rays']} rays, {row['judged']} judged")
            for column, cell in zip(group["columns"], row["cells"]):
                if is_wrong(group, column, cell):
                    found.append(f"{group['group']}: {row['case']}: {column}")
    return found


def table(group, columns, cell_text, bound=True):
    lines = ["| case | rays | judged |" + (" 3 / N |" if bound else "") + "".join(f" {c} |" for c in columns),
             "|---|---:|---:|" + ("---:|" if bound else "") + "---:|" * len(columns)]
    for row in group["rows"]:
        cells = []
        for column, cell in zip(group["columns"], row["cells"]):
            if column in columns:
                text = cell_text(column, cell) if cell["asked"] else "–"
                cells.append(f" **{text}** |" if is_wrong(group, column, cell) else f" {text} |")
        limit = f" {3 / row['rays']:.0e} |" if bound else ""
        lines.append(f"| {row['case']} | {count(row['rays'])} | {count(row['judged'])} |{limit}" + "".join(cells))
    return lines + [""]


def aborted(cell):
    return f"aborts ({count(cell['aborts'])} of {count(cell['asked'])})"


def decision(_, cell):
    return aborted(cell) if cell["aborts"] else f"{count(cell['false_hits'])} / {count(cell['false_misses'])}"


def precision(column, cell):
    if cell["aborts"]:
        return "aborts"
    text = size(cell["t_ulps"])
    return text + f"; {size(cell['uv_ulps'])}" if is_limn(column) and cell["uv_ulps"] else text


def bad_ray(_, cell):
    if cell["aborts"]:
        return aborted(cell)
    answer = f"{count(cell['false_hits'])} hits of {count(cell['asked'])}" if cell["false_hits"] else "misses"
    return answer + (f", time × {cell['figure']:.2g}" if cell["figure"] else "")


def tables(group):
    columns = group["columns"]
    if group["measure"] == "leaks":
        rays = sum(row["rays"] for row in group["rows"])
        return [f"Misses a million; {count(rays)} rays in all rows together, 3 / N = {3 / rays:.0e}:", ""] + table(
            group, columns, lambda _, c: per_million(c["false_misses"], c["asked"]))
    if group["measure"] == "leaving":
        return ["Self-hits / lost:", ""] + table(
            group, columns, lambda _, c: f"{share(c['self_hits'], c['asked'])} / {share(c['lost'], c['asked'])}")
    if group["measure"] == "furnace":
        return table(group, columns, lambda _, c: f"{c['figure']:+.1e} ± {c['figure_error']:.0e}", bound=False)
    if group["measure"] == "queries":
        rays = sum(row["rays"] for row in group["rows"])
        return [f"Wrong answers; {count(rays)} of each in all rows together, 3 / N = {3 / rays:.0e}:", ""] + table(
            group, columns, lambda _, c: count(c["false_hits"]), bound=False)
    if group["measure"] == "bad":
        return table(group, columns, bad_ray, bound=False)
    return (["False hits / false misses:", ""] + table(group, columns, decision)
            + ["Largest error of t, in float32 ulps (2⁻²³ of t); for limn after a semicolon that of u and v, in 2⁻²³:",
               ""]
            + table(group, columns, precision, bound=False))


def hard_section(cases, full):
    lines = ["## The hard cases of the suite", ""]
    if cases is None:
        lines += ["Not run.", ""]
    else:
        failed = [c["case"] for c in cases if not c["passed"]]
        lines += [f"`tests/hard`, with {'all' if full else 'a tenth of'} the rays that its cases name: "
                  f"{len(cases)} cases, {len(failed)} failed, {sum(c['seconds'] for c in cases):.0f} s of one core.", ""]
        lines += [f"- failed: {name}" for name in failed] + [""] * bool(failed)
    return lines


def report(head, groups, cases, full, found):
    lines = [
        f"{stamp(head)}, g++ {head['compiler']}, {head['minutes']:.0f} minutes. " +
        (f"Embree {head['embree']} in both modes, in a process of its own."
         if head["embree"] else "Embree is not installed here, so that its columns are missing."), "",
        "Truth is exact arithmetic on the stored numbers (`tests/support/exact_truth.h`). It decides every ray, so that "
        "as many are judged as are generated. Shapes and rays are made of float32 numbers, so that all columns get the "
        "same input. limn intersects in double through the compiled scene and its trees, or through the shape's own "
        "`hit()` where a column says so. The textbook's triangles are behind a box test that loses nothing. If no ray of "
        "N is wrong, the rate is below 3 / N with 95 % confidence.", "",
        ("**limn: no wrong decision, no leak, no self-hit in any row.**" if not found else
         f"**limn: {len(found)} cells or checks are not as they must be:**"), ""]
    lines += [f"- {fault}" for fault in found] + [""] * bool(found)
    lines += ["![Leaks over distance from the origin](accuracy/leaks.svg)", "",
              "![Error of t over size and distance](accuracy/t_error.svg)", "",
              "![Wrong decisions over the aspect of slivers](accuracy/slivers.svg)", ""]
    for group in groups:
        title, text = TEXTS[group["group"]]
        lines += [f"## {title}", "", text, ""] + tables(group)
    return "\n".join(lines + hard_section(cases, full)).rstrip() + "\n"
