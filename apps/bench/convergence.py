"""Speed against error, limn beside its peers: the generated part of docs/speed-against-error.md, and its plot.

Fourteen scenes, described once (transport_scenes.cpp) and written for each renderer that can express them (peers/).
Everybody renders a converged reference in two halves, then a ladder of growing sample counts on one thread, with
several seeds, all taking turns. Raw numbers go to build/convergence/results.json, from which --again writes the report
anew. Interrupted, it goes on with the scene where it was. References are kept as long as scene and renderer stay the
same.

Needs limn's programs in build/release/bin, matplotlib, numpy and OpenImageIO for Python; Mitsuba, Blender and LuxCore
come from PyPI into build/peers where they can. Run through ./build.sh convergence [--full] [--scene NAME ...]
[--peer NAME ...] [--again]. On a machine that does something else meanwhile its times say little.
"""

import argparse
import datetime
import json
import sys

import convergence_plots
import convergence_tables
from convergence_measure import Plan, measure
from convergence_renderers import PEERS, RAW, Failed, limn_ladder, say, start_peers
from machine import ROOT
from reports import Kept, origin, write

RESULTS = RAW / "results.json"
SHORT = Plan(size=100, seeds=4, growth=4, cap=5, reference=6)  # some thirty minutes on two cores
FULL = Plan(size=400, seeds=4, growth=4, cap=40, reference=60)  # some four hours


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true", help=f"{FULL}, instead of {SHORT}")
    parser.add_argument("--scene", action="append", choices=list(convergence_tables.SCENES), metavar="NAME",
                        help="only these: " + ", ".join(convergence_tables.SCENES))
    parser.add_argument("--peer", action="append", choices=[*PEERS, "none"], metavar="NAME",
                        help="only these: " + ", ".join(PEERS) + "; none: limn alone")
    parser.add_argument("--again", action="store_true", help="write the report from what was measured last")
    for name in ("size", "seeds", "cap", "reference"):
        parser.add_argument(f"--{name}", type=float, metavar="X", help="instead of what the form has: see --full")
    return parser.parse_args()


def plan_of(arguments):
    plan = FULL if arguments.full else SHORT
    given = {name: value for name in ("size", "seeds", "cap", "reference")
             if (value := getattr(arguments, name)) is not None}
    whole = {name: int(value) for name, value in given.items() if name in ("size", "seeds")}
    return Plan(**{**vars(plan), **given, **whole})


def earlier(plan):
    """What was measured with the same plan."""
    if RESULTS.exists():
        raw = json.loads(RESULTS.read_text())
        if raw["plan"] == vars(plan):
            return raw
    return {"plan": vars(plan), "scenes": {}}


def measure_all(arguments):
    plan, wanted = plan_of(arguments), [p for p in arguments.peer or PEERS if p != "none"]
    head = {**origin("convergence", " ".join(["./build.sh convergence", *sys.argv[1:]])), "size": plan.size,
            "seeds": plan.seeds, "session": datetime.datetime.now().isoformat("T", "minutes")}
    raw = earlier(plan)
    peers, raw["missing"] = start_peers(wanted)
    kept = Kept(RAW / "kept.json", sources=head["sources"], plan=vars(plan),
                peers=[[peer.key, peer.about["version"]] for peer in peers])
    head = kept("head", lambda: head)
    for scene in arguments.scene or convergence_tables.SCENES:
        say(f"{scene}, {kept.minutes():.0f} minutes so far")
        rows = kept(scene, lambda: measure(scene, limn_ladder() + peers, plan))
        for row in rows.values():
            row["session"], row["sources"] = head["session"], head["sources"]
        # Limn's rows go together; peers that were not asked this time keep theirs.
        others = {k: row for k, row in raw["scenes"].get(scene, {}).items() if k in PEERS and k not in rows}
        raw["scenes"][scene] = {**rows, **others}
    for peer in peers:
        peer.close()
    if any(rows["limn"].get("sources") != head["sources"] for rows in raw["scenes"].values()):
        head["sources"] = "of several sessions"
    raw["head"] = {**head, "minutes": kept.minutes()}
    RESULTS.write_text(json.dumps(raw, indent=1))
    kept.forget()
    return raw


def main():
    arguments = parse_arguments()
    RAW.mkdir(parents=True, exist_ok=True)
    try:
        raw = json.loads(RESULTS.read_text()) if arguments.again else measure_all(arguments)
    except (Failed, FileNotFoundError) as problem:
        sys.exit(f"convergence: {problem}")
    convergence_plots.draw(raw["scenes"], ROOT / "docs/speed-against-error/curves.svg")
    write("convergence", convergence_tables.report(raw))
    say("docs/speed-against-error.md")


if __name__ == "__main__":
    main()
