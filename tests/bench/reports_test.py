"""Reports know when their sources have changed, long ones go on where they were, and a release finds what is untrue."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "apps/bench"))
import release
import reports

REPORT = reports.Report("accuracy", "docs/accuracy.md", "./build.sh accuracy --full", 1,
                        ("CMakeLists.txt", "lib", "-lib/io"))


class Tree(unittest.TestCase):
    """A small tree of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.put("lib/a.cpp", '// Adds.\nint a(int x) {\n    return x + 1;\n}\nconst char* s = "// no comment";\n')
        self.put("lib/io/b.cpp", "int b;\n")
        self.put("CMakeLists.txt", "# All.\nproject(limn VERSION 0.1.0 LANGUAGES CXX)\nadd_subdirectory(lib)\n")
        self.put("docs/accuracy.md",
                 "# Accuracy\n\nBefore.\n\n<!-- accuracy: begin -->\n<!-- accuracy: end -->\n\nAfter.\n")

    def put(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def change(self, name, old, new):
        text = (self.root / name).read_text()
        self.assertIn(old, text)
        (self.root / name).write_text(text.replace(old, new))


class Freshness(Tree):
    def setUp(self):
        super().setUp()
        self.write()
        self.assertEqual(self.state(), "fresh")

    def write(self, command=REPORT.command, faults=0):
        head = {"command": command, "date": "d", "commit": "abc", "processor": "p", "cores": 2, "faults": faults,
                "sources": reports.digest(REPORT.sources, self.root)}
        reports.write("accuracy", reports.stamp(head) + ".\n\nnumbers", self.root)

    def state(self):
        return reports.state(REPORT, self.root)

    def test_ends_with_every_change_of_what_is_measured(self):
        for name, old, new in (("lib/a.cpp", "x + 1", "x + 2"), ("lib/a.cpp", "// no", "// another"),
                               ("CMakeLists.txt", "add_subdirectory(lib)", "add_subdirectory(lib EXCLUDE_FROM_ALL)")):
            self.change(name, old, new)
            self.assertEqual(self.state(), "older than its sources", new)
            self.change(name, new, old)
            self.assertEqual(self.state(), "fresh")

    def test_ends_with_a_file_that_comes_goes_or_is_renamed(self):
        self.put("lib/c.h", "int c;\n")
        self.assertEqual(self.state(), "older than its sources")
        self.write()
        (self.root / "lib/c.h").rename(self.root / "lib/d.h")
        self.assertEqual(self.state(), "older than its sources")
        self.write()
        (self.root / "lib/d.h").unlink()
        self.assertEqual(self.state(), "older than its sources")

    def test_survives_comments_the_layout_of_code_and_a_new_version(self):
        self.change("lib/a.cpp", "// Adds.\n", "/* Adds\n   one. */\n\n")
        self.change("lib/a.cpp", "{\n    return x + 1;\n}", "{ return x + 1;  /* so */ }")
        self.change("CMakeLists.txt", "# All.\n", "\n# Everything.\n")
        self.change("CMakeLists.txt", "0.1.0", "0.2.0")
        self.assertEqual(self.state(), "fresh")

    def test_survives_what_is_not_measured(self):
        self.put("lib/io/b.cpp", "int c;\n")
        self.put("tests/a.cpp", "int t;\n")
        self.put("build/lib/a.cpp", "int t;\n")
        self.put("lib/__pycache__/a.pyc", "x")
        self.assertEqual(self.state(), "fresh")

    def test_is_that_of_the_command_that_is_wanted(self):
        self.write("./build.sh accuracy")
        self.assertEqual(self.state(), "written by ./build.sh accuracy")

    def test_lacks_where_something_is_wrong(self):
        self.write(faults=3)
        self.assertEqual(self.state(), "3 wrong")

    def test_needs_a_digest_and_a_place(self):
        reports.write("accuracy", "Written by `./build.sh accuracy`, once.", self.root)
        self.assertEqual(self.state(), "does not say what it measured")
        self.change("docs/accuracy.md", "<!-- accuracy: end -->", "")
        self.assertEqual(self.state(), "not in its document")

    def test_leaves_the_prose_alone(self):
        text = (self.root / "docs/accuracy.md").read_text()
        self.assertTrue(text.startswith("# Accuracy\n\nBefore.\n\n<!-- accuracy: begin -->\n\nWritten by `./build.sh"))
        self.assertTrue(text.endswith("numbers\n\n<!-- accuracy: end -->\n\nAfter.\n"))


class LongReport(Tree):
    def kept(self, **key):
        return reports.Kept(self.root / "kept.json", **key)

    def test_goes_on_where_it_was_interrupted(self):
        asked = []
        for _ in range(2):
            kept = self.kept(sources="abc", full=True)
            self.assertEqual(kept("a", lambda: asked.append("a") or [1, (2, 3)]), [1, [2, 3]])
        self.assertEqual(asked, ["a"])
        self.assertEqual(self.kept(sources="abc", full=True)("b", lambda: 7), 7)

    def test_forgets_what_was_measured_on_other_sources_or_in_another_form(self):
        self.kept(sources="abc", full=True)("a", lambda: 1)
        self.assertEqual(self.kept(sources="abd", full=True)("a", lambda: 2), 2)
        self.assertEqual(self.kept(sources="abd", full=False)("a", lambda: 3), 3)

    def test_measures_again_what_was_not_good_and_what_was_written(self):
        self.assertEqual(self.kept(sources="abc")("a", lambda: 1, lambda value: value > 1), 1)
        kept = self.kept(sources="abc")
        self.assertEqual(kept("a", lambda: 2, lambda value: value > 1), 2)
        kept.forget()
        self.assertEqual(self.kept(sources="abc")("a", lambda: 3), 3)


class Release(Tree):
    def setUp(self):
        super().setUp()
        self.put("tests/mutants/a.patch", "")
        self.put("tests/mutants/b.patch", "")
        self.put("CHANGELOG.md", "# Changes\n\n## 0.1.0, unreleased\n\n- 2 known faults, each noticed.\n")
        self.put("README.md", "FetchContent_Declare(limn GIT_TAG v0.1.0)\n")
        self.put("tests/core/a_test.cpp", 'TEST_CASE("Vec: is | long, "\n          "and \\"split\\"", "[core]") {\n}\n')
        self.put("tests/core/CMakeLists.txt", 'add_test(NAME "digest on ${target}" COMMAND test_digest)\n')
        self.put("docs/mutants.md", "2 faults\n\n| room | fault | caught by | seconds |\n|---|---|---|---:|\n"
                 '| core | A. | core: Vec: is \\| long, and "split" (hangs) | 3 |\n'
                 "| core | B. | digest on SSE4 | 3 |\n")

    def test_finds_no_fault_where_all_is_so(self):
        for find in (release.version_faults, release.claim_faults, release.killer_faults):
            self.assertEqual(find(self.root), [], find.__name__)

    def test_finds_another_version(self):
        self.change("CMakeLists.txt", "0.1.0", "0.2.0")
        self.assertEqual(len(release.version_faults(self.root)), 2)

    def test_finds_another_number_of_mutants(self):
        self.put("tests/mutants/c.patch", "")
        self.assertEqual([fault.split()[0] for fault in release.claim_faults(self.root)],
                         ["CHANGELOG.md", "docs/mutants.md"])

    def test_finds_tests_that_are_gone(self):
        self.change("tests/core/a_test.cpp", "is | long", "is short")
        self.change("tests/core/CMakeLists.txt", "digest", "digests")
        self.assertEqual([fault.split("'")[1] for fault in release.killer_faults(self.root)],
                         ['core: Vec: is | long, and "split"', "digest on SSE4"])


class Table(unittest.TestCase):
    def test_names_documents_that_have_a_place_for_each_report(self):
        for report in reports.REPORTS:
            self.assertIsNotNone(reports.part(report), report.name)

    def test_names_sources_that_are_there(self):
        for report in reports.REPORTS:
            for pattern in report.sources:
                self.assertTrue(reports.files([pattern.removeprefix("-")]), f"{report.name}: {pattern}")

    def test_names_commands_of_the_build_script(self):
        usage = subprocess.run([ROOT / "build.sh"], capture_output=True, text=True, check=False).stderr
        for report in reports.REPORTS:
            self.assertRegex(usage, rf"(?m)^  {report.command.split()[1]} ", report.name)


if __name__ == "__main__":
    unittest.main()
