"""The suite in builds other than the usual one, and what its tests say there."""

import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "apps/bench"))

import reports  # noqa: E402


def say(text):
    print(text, file=sys.stderr, flush=True)


def logged(command, log, **options):
    """Runs a command; what it prints is added to a file. Ends the program where it fails."""
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("a") as out:
        done = subprocess.run([str(c) for c in command], stdout=out, stderr=subprocess.STDOUT, cwd=ROOT, **options)
    if done.returncode != 0:
        print("\n".join(log.read_text(errors="replace").splitlines()[-40:]), file=sys.stderr)
        sys.exit(f"{' '.join(map(str, command))} failed; all it printed is in {log}")


def build(folder, configure, targets=()):
    """Configures and builds a folder; with a compiler cache where there is one."""
    cache = {"CMAKE_CXX_COMPILER_LAUNCHER": "ccache"} if shutil.which("ccache") else {}  # counts where a folder is new
    log = folder.with_suffix(".log")
    log.unlink(missing_ok=True)
    say(f"building {folder.relative_to(ROOT)}")
    logged(["cmake", "-S", ROOT, *configure], log, env={**os.environ, **cache})
    logged(["cmake", "--build", folder, *(["--target", *targets] if targets else [])], log)


def rooms(folder):
    """What stands before the colon in the names of the tests, in order; the others together as ''."""
    listed = subprocess.run(["ctest", "--test-dir", folder, "-N"], capture_output=True, text=True).stdout
    names = re.findall(r"^ *Test +#\d+: (.*)$", listed, re.MULTILINE)
    return list(dict.fromkeys(name.partition(":")[0] if ":" in name else "" for name in names))


def run(folder, room=None, preset=None, **environment):
    """The tests of a room, or all: how many there are, and those that failed, with what they printed."""
    results = folder / "results.xml"
    results.unlink(missing_ok=True)
    which = [] if room is None else ["-R", f"^{re.escape(room)}:" if room else "^[^:]*$"]
    where = ["--preset", preset] if preset else ["--test-dir", folder, "-j", str(os.cpu_count()), "--timeout", "3600"]
    subprocess.run(["ctest", *where, *which, "--output-junit", results], cwd=ROOT, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL, env={**os.environ, **environment})
    cases = list(ET.parse(results).getroot().iter("testcase")) if results.exists() else []
    if not cases:
        sys.exit(f"{folder}: no tests ran" + (f" of {room}" if room else ""))

    def is_skipped(case):
        reason = case.find("skipped")  # also of programs that are not there
        return reason is not None and reason.get("message", "").startswith("SKIP_")

    failed = {case.get("name"): case.findtext("system-out", "") for case in cases
              if case.get("status") != "run" and not is_skipped(case)}
    return {"tests": len(cases) - sum(map(is_skipped, cases)), "failed": failed}
