"""Whether the tree can be released: the reports are of these sources, and what the documents claim is so.

    release.py            a table of the reports, and a line for each fault; exit status 0 only where there is none
    release.py --renew    first runs the commands of the reports that are not fresh; each goes on where it was
                          interrupted

Run through ./build.sh release [--renew].
"""

import re
import subprocess
import sys

import reports
from machine import ROOT, git

CLAIM = re.compile(r"\b(\d+)\s+(?:known\s+)?faults\b")


def papers(root):
    return sorted([*root.glob("*.md"), *root.glob("docs/*.md")])


def version_faults(root):
    version = re.search(r"project\(limn VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())[1]
    newest = re.search(r"^## (\S+?),? ", (root / "CHANGELOG.md").read_text() + " ", re.MULTILINE)
    faults = []
    newest = newest[1] if newest else "no version"
    if newest != version:
        faults.append(f"CHANGELOG.md begins with {newest}, CMakeLists.txt says {version}")
    for tag in re.findall(r"GIT_TAG v([\d.]+)\b", (root / "README.md").read_text()):
        if tag != version:
            faults.append(f"README.md fetches v{tag}, CMakeLists.txt says {version}")
    return faults


def claim_faults(root):
    patches = len(list(root.glob("tests/mutants/*.patch")))

    def claims(paper):  # of the changelog those of the newest version: the others were true then
        text = paper.read_text()
        return CLAIM.findall("".join(text.split("\n## ")[:2]) if paper.name == "CHANGELOG.md" else text)

    return [f"{paper.relative_to(root)} claims {claim} faults, tests/mutants has {patches}"
            for paper in papers(root) for claim in claims(paper) if int(claim) != patches]


def test_names(root):
    """A pattern for the names of all tests, "program: name", as the sources of the suite spell them."""
    found = []
    for room in root.glob("tests/*"):
        listing = room / "CMakeLists.txt"
        text = listing.read_text() if listing.exists() else ""
        program = "|".join([room.name, *re.findall(r"^limn_test\((\w+)", text, re.MULTILINE)])
        for source in room.glob("*.cpp"):
            for literals in re.findall(r'\bTEST_CASE\(\s*((?:"(?:\\.|[^"\\])*"\s*)+)', source.read_text()):
                name = "".join(re.findall(r'"((?:\\.|[^"\\])*)"', literals)).replace('\\"', '"')
                found.append(f"(?:{program}): {re.escape(name)}")
        names = re.findall(r'add_test\(NAME "([^"]+)"', text)
        names += [f"consumer: {name}" for name in re.findall(r'^consumer_test\("([^"]+)"', text, re.MULTILINE)]
        # What CMake puts in for a variable may be anything.
        found += [".+".join(map(re.escape, re.split(r"\$\{\w+\}", name))) for name in names]
    return re.compile("|".join(found))


def killer_faults(root):
    """Tests that docs/mutants.md names and the suite does not have."""
    known, faults = test_names(root), []
    for row in (root / "docs/mutants.md").read_text().splitlines():
        cells = [cell.replace("\\|", "|").strip() for cell in re.split(r"(?<!\\)\|", row)][1:-1]
        if len(cells) < 4 or cells[0] == "room" or cells[0].startswith("-"):
            continue
        name = cells[2].removesuffix(" (hangs)")
        if not known.fullmatch(name) and not known.fullmatch(name.replace(":", ": ", 1)):
            faults.append(f"docs/mutants.md: there is no test '{name}'")
    return faults


def all_faults(root):
    faults = [f"{r.paper}: {r.name} is not fresh" for r in reports.REPORTS if reports.state(r, root) != "fresh"]
    changed = git("status", "--porcelain")
    if changed:
        faults.append(f"{len(changed.splitlines())} files are not as committed")
    return faults + version_faults(root) + claim_faults(root) + killer_faults(root)


def renew():
    for report in reports.REPORTS:
        if reports.state(report) != "fresh":
            print(f"release: {report.command}, about {report.minutes} minutes", flush=True)
            status = subprocess.run(["bash", "-c", report.command], cwd=ROOT, stdin=subprocess.DEVNULL).returncode
            if status != 0:
                print(f"release: {report.command} ended with status {status}", flush=True)


def main(arguments):
    if arguments not in ([], ["--renew"]):
        sys.exit(__doc__)
    if arguments:
        renew()
    print("\n".join(map(reports.line, reports.REPORTS)))
    faults = all_faults(ROOT)
    print("\n".join(["", *faults] if faults else ["", f"{git('describe', '--always')}: ready"]))
    return 1 if faults else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
