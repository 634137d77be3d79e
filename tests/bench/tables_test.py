"""What the performance report counts as a fault and as a missed goal, and that its tables hold every row."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "apps/bench"))
import performance_instructions as instructions
import performance_tables as tables


def ratio(median, of="limn", to="Embree"):
    return {"median": median, "low": median - 0.1, "high": median + 0.1, "of": of, "to": to}


def row(threads=1, single=1.0, robust=1.3, batch=1.3, rate=10.0, differences=0):
    subjects = [{"name": name, "million_a_second": rate * threads, "mismatches": 0, "seconds": [1]}
                for name in ("limn", "limn batch", "Embree", "Embree 16", "Embree robust")]
    return {"rays": "primary", "count": 1000, "any": False, "threads": threads, "differences": differences,
            "single_to_default": ratio(single), "single_to_robust": ratio(robust, to="Embree robust"),
            "batch_to_best": ratio(batch, "limn batch", "Embree 16"), "subjects": subjects}


def scene(rows=None, build=1.0, size=64):
    return {"name": "soup", "primitives": 100, "bytes": {"limn": 100 * size, "Embree": 9000},
            "builds": [{"threads": 1, "seconds": {"limn": [1.0], "Embree": [build]},
                        "ratios": {"Embree": ratio(build)}}],
            "rows": rows or [row()]}


def raw(scenes=None, more=1.0, aside=1.0):
    counts = {"primary_single": 100.0}
    times = {"primary_single": [1.0]}
    return {"table": {"versions": {}, "scenes": scenes or [scene()]}, "growth": {"soup": [scene()]}, "faults": [],
            "truth": [{"scene": "soup", "rays": "primary", "judged": 40, "hits": 9, "wrong": 0, "first": ""}],
            "instructions": {"whole": {"primary_single": 100.0 * more},
                             "without": {"media": {"counts": counts, "times": times}},
                             "user_defined": {"counts": {"primary_single": 100.0 * more * aside}, "times": times}},
            "head": {"command": "x", "date": "today", "commit": "c", "processor": "p", "cores": 2, "sources": "s",
                     "minutes": 1}}


class Goals(unittest.TestCase):
    def test_none_is_missed_where_all_are_just_reached(self):
        self.assertEqual(tables.missed(raw()), [])

    def test_each_ratio_has_its_own(self):
        for short in ({"single": 0.99}, {"robust": 1.29}, {"batch": 1.29}):
            self.assertEqual(len(tables.missed(raw([scene([row(**short)])]))), 1, short)

    def test_building_bytes_and_instructions_have_one(self):
        self.assertEqual(tables.missed(raw([scene(build=0.9)])), ["soup, built by 1 threads"])
        self.assertEqual(tables.missed(raw([scene(size=65)])), ["soup: bytes"])
        self.assertEqual(tables.missed(raw(more=1.02)), ["instructions, media: primary_single"])
        self.assertEqual(tables.missed(raw(aside=1.02)), ["instructions, a user-defined sphere aside: primary_single"])

    def test_two_threads_are_nearly_twice_as_fast_as_one(self):
        self.assertEqual(tables.missed(raw([scene([row(), row(threads=2)])])), [])
        slow = row(threads=2, rate=9.4)
        self.assertEqual(tables.missed(raw([scene([row(), slow])])), ["soup, primary: scaling"])

    def test_what_is_not_there_misses_none(self):
        alone = row()
        alone.update(single_to_default=None, single_to_robust=None, batch_to_best=None)
        alone["subjects"] = alone["subjects"][:2]
        self.assertEqual(tables.missed(raw([scene([alone])])), [])
        tables.report(raw([scene([alone])]))


class Faults(unittest.TestCase):
    def test_none_where_all_agree(self):
        self.assertEqual(tables.faults(raw()["table"], True, raw()["truth"]), [])

    def test_wrong_answers_and_batches_that_differ_are_faults(self):
        wrong = [dict(raw()["truth"][0], wrong=2)]
        self.assertEqual(len(tables.faults(raw()["table"], True, wrong)), 1)
        self.assertEqual(len(tables.faults({"scenes": [scene([row(differences=1)])]}, False, [])), 2)


class Report(unittest.TestCase):
    def test_has_a_row_for_each_and_marks_what_is_short(self):
        text = tables.report(raw([scene([row(single=0.5), row(threads=2)])]))
        self.assertIn("### soup, 1 thread\n", text)
        self.assertIn("### soup, 2 threads\n", text)
        self.assertIn("**0.50 (0.40..0.60)**", text)
        self.assertIn("| soup | primary | 2 | 2.00 | 2.00 | 2.00 |", text)
        self.assertIn("5 reach their goal", text)
        self.assertIn("| soup | 0.50 | 1.30 | 1.30 | – | 1.00 | 1.41 |", text)
        self.assertNotIn("None", text)


class Callgrind(unittest.TestCase):
    def test_counts_are_read_from_its_listing(self):
        line = "14,104,481 (29.78%)  ???:measure_render [/work/limn_count_instructions]"
        match = instructions.FUNCTION.match(line)
        self.assertEqual((match[1], match[2]), ("14,104,481", "render"))
        line = " 6,246,050 (13.19%)  /work/count_instructions.cpp:measure_diffuse_batch"
        self.assertEqual(instructions.FUNCTION.match(line)[2], "diffuse_batch")


if __name__ == "__main__":
    unittest.main()
