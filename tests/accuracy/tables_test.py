"""What the accuracy report counts as a fault, and that its tables hold every row and column."""

import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "apps/bench"))
import accuracy_tables as tables


def cell(**values):
    zero = dict.fromkeys(("false_hits", "false_misses", "self_hits", "lost", "aborts"), 0)
    return {**zero, "asked": 10, "t_ulps": 0.5, "uv_ulps": 0, "figure": 0, "figure_error": 0, **values}


def group(name="spheres", measure="decisions", columns=("limn", "Embree"), rays=10, judged=10, cells=None):
    cells = cells or [cell() for _ in columns]
    return {"group": name, "measure": measure, "columns": list(columns),
            "rows": [{"case": "a row", "x": 0, "rays": rays, "judged": judged, "cells": cells}]}


class Faults(unittest.TestCase):
    def test_none_where_limn_is_right(self):
        self.assertEqual(tables.faults([group()]), [])

    def test_whatever_limn_gets_wrong(self):
        for wrong in ({"false_hits": 1}, {"false_misses": 1}, {"self_hits": 1}, {"lost": 1}, {"aborts": 1},
                      {"t_ulps": 1.01}, {"uv_ulps": 2}, {"t_ulps": math.inf}, {"t_ulps": math.nan}):
            self.assertEqual(tables.faults([group(cells=[cell(**wrong), cell()])]), ["spheres: a row: limn"], wrong)

    def test_not_what_others_get_wrong(self):
        self.assertEqual(tables.faults([group(cells=[cell(), cell(false_hits=5, aborts=5, t_ulps=9)])]), [])

    def test_rays_that_were_not_judged(self):
        self.assertEqual(len(tables.faults([group(judged=9)])), 1)

    def test_light_lost_in_a_furnace(self):
        def furnace(deep, unlimited):
            cells = [cell(figure=-0.5), cell(figure=deep), cell(figure=unlimited, figure_error=1e-3)]
            return group("furnace", "furnace", ("depth 4", "depth 1000", "unlimited"), cells=cells)
        self.assertEqual(tables.faults([furnace(9e-4, -5e-3)]), [])
        self.assertEqual(tables.faults([furnace(-2e-3, 0)]), ["furnace: a row: depth 1000"])
        self.assertEqual(tables.faults([furnace(0, 6e-3)]), ["furnace: a row: unlimited"])


class Report(unittest.TestCase):
    head = {"command": "./build.sh accuracy", "date": "d", "commit": "c", "processor": "p", "cores": 2, "sources": "s",
            "compiler": "12", "embree": "3", "minutes": 3}

    def test_every_group_has_its_table(self):
        measures = {"leaks": "leaks", "quad leaks": "leaks", "slabs": "leaks", "leaving": "leaving", "bad rays": "bad",
                    "furnace": "furnace"}
        for name, (title, _) in tables.TEXTS.items():
            text = tables.report(self.head, [group(name, measures.get(name, "decisions"))], None, False, [])
            self.assertIn(f"## {title}\n", text)
            self.assertRegex(text, r"\n\| a row \| 10 \| 10 \|.*\|\n")
            self.assertIn("| limn | Embree |", text)

    def test_what_is_wrong_stands_out(self):
        wrong = group(cells=[cell(false_hits=3), cell(false_misses=4)])
        text = tables.report(self.head, [wrong], None, False, tables.faults([wrong]))
        self.assertIn("| **3 / 0** | 0 / 4 |", text)
        self.assertIn("- spheres: a row: limn", text)
        self.assertNotIn("no wrong decision", text)

    def test_who_was_not_asked_has_no_answer(self):
        text = tables.report(self.head, [group(cells=[cell(), cell(asked=0)])], None, False, [])
        self.assertEqual(text.count("| – |"), 2)

    def test_hard_cases_that_failed_are_named(self):
        cases = [{"case": "one", "passed": True, "seconds": 1}, {"case": "two", "passed": False, "seconds": 1}]
        text = tables.report(self.head, [group()], cases, False, [])
        self.assertIn("2 cases, 1 failed", text)
        self.assertIn("- failed: two", text)


if __name__ == "__main__":
    unittest.main()
