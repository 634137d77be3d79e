"""Speed against error, limn beside its peers: generated parts of docs/speed-against-error.md, and their plots.

Fourteen scenes, described once (transport_scenes.cpp) and written for each renderer that can express them (peers/).
Everybody renders a converged reference in two halves, then a ladder of growing sample counts on one thread, with
several seeds, all taking turns. Raw numbers go to build/convergence/results-SIZE.json, from which --again writes the
report anew. Interrupted, it goes on with the scene where it was. References are kept as long as scene and renderer stay
the same.

Needs limn's programs in build/release/bin, matplotlib, numpy and OpenImageIO for Python; Mitsuba, Blender and LuxCore
come from PyPI into build/peers where they can. Run through ./build.sh convergence [--size 400] [--scene NAME ...]
[--peer NAME ...] [--again]. On a machine that does something else meanwhile its times say little.
"""

import argparse
import datetime
import json
import sys
from dataclasses import dataclass, replace

import convergence_plots
import convergence_tables
from convergence_measure import Plan, measure
from convergence_renderers import PEERS, RAW, Failed, limn_ladder, say, start_peers
from machine import ROOT
from reports import Kept, origin, write


@dataclass(frozen=True)
class Form:
    """A part of the report."""
    name: str
    plan: Plan
    scenes: tuple
    peers: tuple
    steps: bool  # limn without this and that, too

    def results(self):
        return RAW / f"results-{self.plan.size}.json"


FORMS = {form.plan.size: form for form in (
    Form("convergence", Plan(size=100, seeds=4, growth=4, cap=5, reference=6), tuple(convergence_tables.SCENES),
         tuple(PEERS), True),
    Form("convergence-400", Plan(size=400, seeds=4, growth=4, cap=40, reference=30),
         ("cornell", "lamps", "three-spheres", "still-spheres", "many-lights"), ("mitsuba", "cycles"), False))}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, choices=list(FORMS), default=100,
                        help="pixels a side; 400: five scenes, fewer peers")
    parser.add_argument("--scene", action="append", choices=list(convergence_tables.SCENES), metavar="NAME",
                        help="only these: " + ", ".join(convergence_tables.SCENES))
    parser.add_argument("--peer", action="append", choices=[*PEERS, "none"], metavar="NAME",
                        help="only these: " + ", ".join(PEERS) + "; none: limn alone")
    parser.add_argument("--again", action="store_true", help="write the report from what was measured last")
    for name, kind in (("seeds", int), ("cap", float), ("reference", float)):
        parser.add_argument(f"--{name}", type=kind, metavar="X", help="instead of what the form has: see its Plan")
    return parser.parse_args()


def form_of(arguments):
    form = FORMS[arguments.size]
    given = {name: value for name in ("seeds", "cap", "reference") if (value := getattr(arguments, name)) is not None}
    return replace(form, plan=replace(form.plan, **given))


def earlier(form):
    """What was measured with the same plan."""
    if form.results().exists():
        raw = json.loads(form.results().read_text())
        if raw["plan"] == vars(form.plan):
            return raw
    return {"plan": vars(form.plan), "scenes": {}}


def measure_all(form, arguments):
    plan, wanted = form.plan, [p for p in arguments.peer or form.peers if p != "none"]
    head = {**origin(form.name, " ".join(["./build.sh convergence", *sys.argv[1:]])), "size": plan.size,
            "seeds": plan.seeds, "session": datetime.datetime.now().isoformat("T", "minutes")}
    raw = earlier(form)
    peers, raw["missing"] = start_peers(wanted)
    kept = Kept(RAW / f"kept-{plan.size}.json", sources=head["sources"], plan=vars(plan),
                peers=[[peer.key, peer.about["version"]] for peer in peers])
    head = kept("head", lambda: head)
    limn = [limn for limn in limn_ladder() if form.steps or limn.key == "limn"]
    for scene in arguments.scene or form.scenes:
        say(f"{scene}, {kept.minutes():.0f} minutes so far")
        rows = kept(scene, lambda: measure(scene, limn + peers, plan))
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
    form.results().write_text(json.dumps(raw, indent=1))
    kept.forget()
    return raw


def main():
    arguments = parse_arguments()
    form = form_of(arguments)
    RAW.mkdir(parents=True, exist_ok=True)
    try:
        raw = json.loads(form.results().read_text()) if arguments.again else measure_all(form, arguments)
    except (Failed, FileNotFoundError) as problem:
        sys.exit(f"convergence: {problem}")
    convergence_plots.draw(raw["scenes"], ROOT / "docs" / convergence_tables.plot(raw["head"]))
    write(form.name, convergence_tables.report(raw))
    say("docs/speed-against-error.md")


if __name__ == "__main__":
    main()
