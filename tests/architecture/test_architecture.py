"""The house as it is, and made-up houses that show that each rule can be broken."""

import re
import unittest
from pathlib import Path

import rules
from house import Floors, SourceFile, read_tree, room_of

ROOT = Path(__file__).resolve().parents[2]
HOUSE = read_tree(ROOT, ["include", "lib", "apps", "examples", "tests", "cmake"])
TABLE = Path(__file__).with_name("floors.txt").read_text()
FLOORS = Floors(TABLE)


class TheHouse(unittest.TestCase):
    def test_every_rule_is_kept(self):
        for rule in (lambda tree: rules.check_floors(tree, FLOORS),
                     lambda tree: rules.check_forward_declarations(tree, FLOORS), rules.check_description,
                     rules.check_quoted_includes, rules.check_libraries,
                     rules.check_umbrella, rules.check_once, rules.check_virtuals, rules.check_flat,
                     rules.check_pointers, rules.check_lobes, rules.check_clocks, rules.check_elementary,
                     rules.check_lengths):
            self.assertEqual(list(rule(HOUSE)), [])

    def test_it_is_read_whole(self):
        self.assertEqual(sum(file.is_public for file in HOUSE), len(list((ROOT / "include").rglob("*.h"))))
        self.assertGreater(sum(bool(room_of(file.path)) for file in HOUSE), 150)

    def test_the_floors_are_in_the_architecture_paper(self):
        self.assertIn(TABLE, (ROOT / "docs/architecture.md").read_text())

    def test_build_sh_runs_every_fuzz_target(self):
        run = re.search(r"readers=\((film[^)]*)\)", (ROOT / "build.sh").read_text())[1].split()
        self.assertEqual(sorted(run), sorted(path.stem for path in (ROOT / "tests/fuzz").glob("*.cpp")))


class TheFloors(unittest.TestCase):
    def test_they_are_read_as_they_are_written(self):
        self.assertEqual(str(Floors("a -> b c\nb -> c\nc ->")),
                         "3 rooms, 3 arrows, 3 floors\n3  a        -> b c\n2  b        -> c\n1  c        -> ")

    def test_floors_in_a_circle_are_refused(self):
        for table, circle in (("attic -> b\nb -> c\nc -> d\nd -> b", "b c d b"), ("a -> a", "a a")):
            with self.assertRaisesRegex(ValueError, f"^the floors have a cycle: {circle}$"):
                Floors(table)
        Floors("a -> b c d\nb -> d\nc -> d\nd ->")  # two ways down


def lines(count):
    return count * "x;\n"


class MadeUpHouses(unittest.TestCase):
    def reports(self, rule, expected, tree, *more):
        self.assertEqual(list(rule([SourceFile(path, text) for path, text in tree.items()], *more)), expected)

    def test_an_include_up_the_stairs(self):
        self.reports(rules.check_floors, [
            "include/limn/math/a.h:2: math -> scene is no arrow of the floors",
            "include/limn/math/a.h:3: math -> scene is no arrow of the floors",
            "lib/flat/tree.h:1: a room includes the umbrella",
            "lib/scene/b.cpp:2: scene -> flat is no arrow of the floors",
            "lib/cellar/wine.h:1: the floors do not know the room cellar",
            "floors.txt: no file of flat includes one of math"], {
                "include/limn/math/a.h": '#pragma once\n#include "limn/scene/shape/b.h"\n'
                                         '#include <limn/scene/shape/b.h>\n',
                "include/limn/scene/shape/b.h": '#pragma once\n#include "limn/math/a.h"\n',
                "include/limn/limn.h": "",
                "lib/flat/tree.h": '#include "limn/limn.h"\n#include "limn/scene/shape/b.h"\n',
                "lib/scene/b.cpp": '#include "scene/c.h"\n  #  include "flat/tree.h"\n// #include "flat/tree.h"\n',
                "lib/scene/c.h": "",
                "lib/cellar/wine.h": ""}, Floors("flat -> scene math\nscene -> math\nmath ->"))

    def test_a_class_of_a_higher_floor_that_is_declared(self):
        declared = "".join(f"struct {name};\n" for name in sorted(rules.DECLARED_FROM_BELOW["records"]))
        self.reports(rules.check_forward_declarations, [
            "include/limn/math/b.h:2: math declares Camera of scene",
            "DECLARED_FROM_BELOW: math does not declare Material of a higher floor",
            "DECLARED_FROM_BELOW: math does not declare MaterialThunks of a higher floor"], {
                "include/limn/math/a.h": "struct RayFrame;  // defined upstairs\nstruct Later;\nstruct Later {};\n",
                "include/limn/math/b.h": "// class Camera;\nclass Camera;\nclass Own;\nclass Nowhere;\n  class Camera;\n",
                "include/limn/records/c.h": declared + "struct Later;\n",
                "lib/math/d.cpp": "class Own final : public Later {};\n",
                "lib/scene/e.h": "class Camera {};\nstruct RayFrame {};\n" + declared.replace(";", " {};")},
            Floors("scene -> records math\nrecords -> math\nmath ->"))

    def test_a_texture_that_knows_a_material(self):
        self.reports(rules.check_description, ["lib/scene/texture/a.cpp:2: scene/texture includes scene/material",
                                               "include/limn/scene/shape/b.h:1: scene/shape includes scene"], {
            "lib/scene/texture/a.cpp": '#include "scene/texture/a.h"\n#include "limn/scene/material/metal.h"\n',
            "include/limn/scene/shape/b.h": '#include "limn/scene/camera.h"\n',
            "lib/scene/scene.cpp": '#include "limn/scene/texture/texture.h"\n',
            "lib/flat/c.cpp": '#include "limn/scene/camera.h"\n'})

    def test_a_private_or_missing_header(self):
        self.reports(rules.check_quoted_includes, [
            "include/limn/math/a.h:1: there is no public header limn/math/none.h",
            "include/limn/math/a.h:2: math/secret.h is private to lib",
            "lib/math/secret.h:2: there is no header math/none.h",
            "apps/common/image_loader.cpp:2: math/secret.h is private to lib",
            "apps/common/other.cpp:1: io/image_codec.h is private to lib",
            "apps/limn/main.cpp:2: math/secret.h is private to lib",
            "examples/e.cpp:1: ../lib/math/secret.h climbs out of its folder"], {
                "include/limn/math/a.h": '#include "limn/math/none.h"\n#include "math/secret.h"\n',
                "lib/math/secret.h": '#include "limn/math/a.h"\n#include "math/none.h"\n',
                "lib/io/x.cpp": '#include "math/secret.h"\n#include "stb_image.h"\n',
                "lib/io/image_codec.h": "",
                "apps/common/image_loader.cpp": '#include "io/image_codec.h"\n#include "math/secret.h"\n',
                "apps/common/other.cpp": '#include "io/image_codec.h"\n',
                "apps/limn/main.cpp": '#include <limn/math/a.h>\n#include "math/secret.h"\n',
                "examples/e.cpp": '#include "../lib/math/secret.h"\n#include "common/f.h"\n'})

    def test_a_library_outside_its_rooms(self):
        self.reports(rules.check_libraries, [
            "include/limn/math/a.h:1: oneTBB does not belong here: tbb/parallel_for.h",
            "include/limn/math/a.h:3: not a header of std: Imath/ImathVec.h",
            "include/limn/math/b.h:2: oneTBB does not belong here: namespace tbb",
            "include/limn/io/c.h:2: OpenImageIO does not belong here: OIIO",
            "lib/io/d.h:1: stb does not belong here: stb_image.h",
            "lib/scene/e.cpp:1: Random123 does not belong here: Random123/philox.h",
            "lib/scene/e.cpp:2: not a header of std: unistd.h",
            "lib/render/f.cpp:3: fmt does not belong here: fmt/core.h"], {
                "include/limn/math/a.h": "#include <tbb/parallel_for.h>\n#include <vector>\n#include <Imath/ImathVec.h>\n",
                "include/limn/math/b.h": "// tbb::task_arena in a comment\nnamespace tbb { class task_arena; }\n",
                "include/limn/io/c.h": 'struct Reader {\n    OIIO::ImageSpec* spec;\n};\nconst char* n = "OIIO::x";\n',
                "lib/io/d.h": '#include "stb_image.h"\n',
                "lib/io/d.cpp": '#include "stb_image.h"\n#include <OpenImageIO/imageio.h>\n',
                "lib/math/system/file_lock.cpp": "#include <unistd.h>\n",
                "lib/scene/e.cpp": "#include <Random123/philox.h>\n#include <unistd.h>\n",
                "lib/render/f.cpp": "#include <Random123/philox.h>\n#include <tbb/task_arena.h>\n#include <fmt/core.h>\n",
                "apps/limn/main.cpp": "#include <CLI/CLI.hpp>\n"})

    def test_a_header_that_the_umbrella_forgot(self):
        self.reports(rules.check_umbrella, ["include/limn/limn.h:1: does not include limn/math/b.h"], {
            "include/limn/limn.h": '#include "limn/math/a.h"\n// #include "limn/math/b.h"\n',
            "include/limn/math/a.h": "",
            "include/limn/math/b.h": ""})
        self.reports(rules.check_umbrella, ["include/limn/limn.h: missing"], {})

    def test_a_header_that_may_not_be_included_twice(self):
        self.reports(rules.check_once, ["include/limn/math/b.h:1: no #pragma once"], {
            "include/limn/math/a.h": "// A\n#pragma once\nint a();\n",
            "include/limn/math/b.h": "// #pragma once\nint b();\n",
            "lib/math/c.h": ""})

    def test_a_fifth_virtual_function(self):
        four = ("virtual ~A();\nvirtual int a() = 0;\nvirtual int b() { return 1; }\nvirtual int c();\n"
                "virtual int d();\n")
        self.reports(rules.check_virtuals, ["lib/math/b.h:2: B has 5 virtual functions"], {
            "include/limn/math/a.h": f"class A {{\npublic:\n{four}}};\n",
            "lib/math/b.h": f"struct S {{}};\nclass B final : public A {{\n{four}virtual int e();\n}};"})

    def test_an_object_in_the_flat_scene(self):
        self.reports(rules.check_flat, [
            "lib/flat/scene.h:2: dispatch in the flat scene: virtual",
            "lib/flat/scene.h:1: a described object in the flat scene: Material*",
            "lib/flat/lights.h:1: a described object in the flat scene: _ptr<const Hittable"], {
                "lib/flat/scene.h": "struct A { const Material* m; };\nstruct B { virtual int f(); };\n",
                "lib/flat/lights.h": "std::shared_ptr<const Hittable> h;\nMaterialId id; TextureRecord* r;\n",
                "lib/scene/shape/c.h": "const Material* m;\n"})

    def test_a_pointer_that_reaches_beyond_its_member(self):
        one, cast = "no pointer to one coordinate reaches another", "objects are read as what they are, or as bytes"
        self.reports(rules.check_pointers, [
            f"lib/trace/a.h:1: {one}: &v.x", f"lib/trace/a.h:2: {one}: &ray.origin.x",
            f"lib/trace/a.h:3: {one}: &rays[i].direction.x", f"lib/trace/a.h:4: {one}: &p->y",
            f"lib/trace/a.h:5: {one}: &color.r", f"lib/trace/a.h:6: {one}: &hit.u",
            "lib/trace/a.h:1: no pointer to a member reaches another: (&v.x)[",
            "lib/trace/b.h:3: no pointer to a member reaches another: (&t.row)[",
            f"lib/trace/b.h:1: {cast}: reinterpret_cast<const float*>",
            f"lib/shading/light_choice.cpp:3: {cast}: reinterpret_cast<const float*>"], {
                "lib/trace/a.h": "double d = (&v.x)[axis];\nconst double* p = &ray.origin.x;\n"
                                 "load(&rays[i].direction.x);\nload(&p->y, &x);\nconst float* p = &color.r;\n"
                                 "const double* q = &hit.u;\n",
                "lib/trace/b.h": "auto* f = reinterpret_cast<const float*>(words);\n"
                                 "auto* c = reinterpret_cast<const char*>(words);\nauto* g = (&t.row)[1];\n"
                                 "void h(int (&row)[2]);\n",
                "lib/shading/light_choice.cpp": "g = hn::GatherIndex(Floats(),\n"
                                              "  reinterpret_cast<const float*>(nodes) + i / 4, at);\n"
                                              "auto* f = reinterpret_cast<const float*>(nodes);\n",
                "lib/trace/c.h": "bool b = a.y && p.x;\nauto n = bits & m.x;\nauto* q = &x;\nfloat& r = v.x;\n",
                "apps/bench/d.cpp": "double d = (&v.x)[1];\n"})

    def test_a_lobe_that_is_not_compared(self):
        source = "LIMN_LOBE(Diffuse)\nMaterialRecord {}::lower(RecordSink& sink) const {{}}\n"
        self.reports(rules.check_lobes, ["lib/scene/material/b.cpp:1: B is not in tests/render/lobe_examples.h"], {
            "lib/scene/material/a.cpp": source.format("A"),
            "lib/scene/material/b.cpp": source.format("B"),
            "lib/scene/material/c.cpp": "MaterialRecord C::lower(RecordSink& sink) const {}\n",
            "tests/render/lobe_examples.h": "return {std::make_shared<A>(1)};  // std::make_shared<B>(1)\n"})

    def test_a_question_for_the_date(self):
        self.reports(rules.check_clocks, [
            "lib/math/a.cpp:1: a date can go back: system_clock",
            "include/limn/math/a.h:1: a date can go back: last_write_time",
            "apps/limn/a.cpp:1: a date can go back: time(nullptr)",
            "apps/limn/a.cpp:2: a date can go back: st_mtime", "apps/limn/a.cpp:2: a date can go back: st_mtim"], {
                "lib/math/a.cpp": "const auto now = std::chrono::system_clock::now();\n",
                "include/limn/math/a.h": 'inline bool old() { return last_write_time("a") < b; }\n',
                "apps/limn/a.cpp": "const auto seed = time(nullptr);\nif (a.st_mtime > b.st_mtim.tv_sec) c();\n",
                "apps/common/a.cpp": "const auto now = std::chrono::steady_clock::now();\nray.time(0.5);\n",
                "apps/bench/a.cpp": "const auto now = std::chrono::system_clock::now();\n"})

    def test_a_sine_of_the_c_library(self):
        what = "math/elementary.h has the same bits everywhere: std::"
        self.reports(rules.check_elementary, [
            f"lib/math/a.cpp:1: {what}sin", f"lib/math/a.cpp:1: {what}exp", f"lib/math/a.cpp:1: {what}expm1",
            f"include/limn/math/a.h:1: {what}log1p"], {
                "lib/math/a.cpp": "const double s = std::sin(x), e = std::exp(-x) + exponential(x) + std::expm1(x);\n",
                "include/limn/math/a.h": "inline double f(double x) { return sine(x) * std::sqrt(x) + std::log1p(x); }\n",
                "lib/image/compare.cpp": "const double decibels = std::log10(x);\n",
                "tests/math/a.cpp": "CHECK(sine(x) == std::sin(x));\n"})

    def test_a_file_that_is_too_long(self):
        self.reports(rules.check_lengths, [
            "lib/math/b.cpp:401: 401 lines, more than 400", "examples/minimal.cpp:26: 26 lines, more than 25",
            "examples/custom_shape.cpp:61: 61 lines, more than 60", "cmake/Long.cmake:81: 81 lines, more than 80",
            "examples/figures/fig02_b.cpp:61: 61 lines, more than 60"], {
                "lib/math/a.cpp": lines(400), "lib/math/b.cpp": lines(401), "examples/minimal.cpp": lines(26),
                "examples/custom_shape.cpp": lines(61), "cmake/Long.cmake": lines(81),
                "examples/figures/fig01_a.cpp": "#if 1\n\n" + lines(60), "examples/figures/fig02_b.cpp": lines(61)})

    def test_comments_and_literals_are_no_code(self):
        file = SourceFile("lib/math/a.cpp", "/* a\n b */ int n = 1'000; // c\n"
                                            "char q = '\"'; auto s = \"d // \\\" e\"; auto r = R\"(f)\"; int g;\n")
        self.assertEqual(file.code, "\n int n = 1'000; \nchar q = ''; auto s = \"\"; auto r = \"\"; int g;\n")
        self.assertEqual(file.lines, 3)


if __name__ == "__main__":
    print(FLOORS)
    unittest.main()
