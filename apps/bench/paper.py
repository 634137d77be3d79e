"""The part of a paper that a program writes; the prose around it stays as it is."""


def write_generated(paper, text, name="generated"):
    """Replaces what stands between the markers `<!-- NAME: begin -->` and `<!-- NAME: end -->`."""
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    before, rest = paper.read_text().split(begin)
    _, after = rest.split(end)
    paper.write_text(f"{before}{begin}\n\n{text.strip()}\n\n{end}{after}")
