// The house as it is, and made-up houses that show that each rule can be broken.
#include <fstream>
#include <iterator>

#include "architecture/rules.h"
#include "catch.h"

using namespace limn::architecture;

namespace {

std::string read_file(const std::string& path) {
    std::ifstream in(std::string(LIMN_SOURCE_DIR) + "/" + path);
    REQUIRE(in.is_open());
    return {std::istreambuf_iterator<char>(in), {}};
}

const SourceTree& the_house() {
    static const SourceTree tree = read_tree(LIMN_SOURCE_DIR, {"include", "lib", "apps", "examples", "tests", "cmake"});
    return tree;
}

void require_none(const Violations& violations) {
    for (const std::string& violation : violations) UNSCOPED_INFO(violation);
    REQUIRE(violations.empty());
}

const Floors& the_floors() {
    static const Floors floors(read_file("tests/architecture/floors.txt"));
    return floors;
}

}  // namespace

TEST_CASE("No room includes one above it", "[architecture]") { require_none(check_floors(the_house(), the_floors())); }

TEST_CASE("Public headers know public headers alone, and programs no private one", "[architecture]") {
    require_none(check_quoted_includes(the_house()));
}

TEST_CASE("Public headers need std alone, and each library stays in its rooms", "[architecture]") {
    require_none(check_libraries(the_house()));
}

TEST_CASE("The umbrella includes every public header", "[architecture]") { require_none(check_umbrella(the_house())); }

TEST_CASE("No base class has more than four virtual functions", "[architecture]") {
    require_none(check_virtuals(the_house()));
}

TEST_CASE("The flat scene has no virtual function and no pointer to an object", "[architecture]") {
    require_none(check_flat(the_house()));
}

TEST_CASE("No pointer reaches beyond the member that it was taken of", "[architecture]") {
    require_none(check_pointers(the_house()));
}

TEST_CASE("Nothing that renders asks for the date", "[architecture]") { require_none(check_clocks(the_house())); }

TEST_CASE("No picture depends on the C library's last bits", "[architecture]") {
    require_none(check_elementary(the_house()));
}

TEST_CASE("Every file can be read in one sitting", "[architecture]") { require_none(check_lengths(the_house())); }

TEST_CASE("The floors stand in the architecture paper word for word", "[architecture]") {
    const std::string paper = read_file("docs/architecture.md"), floors = read_file("tests/architecture/floors.txt");
    CHECK(paper.find(floors) != std::string::npos);
}

TEST_CASE("build.sh runs every fuzz target", "[architecture]") {
    const std::string script = read_file("build.sh"), beginning = "readers=(film";
    const std::size_t list = script.find(beginning);
    REQUIRE(list != std::string::npos);
    const std::string run = script.substr(list, script.find(')', list) - list);
    int targets = 0;
    for (const SourceFile& file : the_house()) {
        if (!file.path.starts_with("tests/fuzz/") || !file.path.ends_with(".cpp")) continue;
        const std::string name = file.path.substr(11, file.path.size() - 15);
        CAPTURE(name);
        ++targets;
        CHECK(run.find(name) != std::string::npos);
    }
    CHECK(targets > 5);
}

TEST_CASE("The house is read whole", "[architecture]") {
    std::size_t headers = 0, rooms = 0;
    for (const SourceFile& file : the_house()) {
        headers += file.path.starts_with("include/limn/") ? 1 : 0;
        rooms += room_of(file.path).empty() ? 0 : 1;
    }
    CHECK(headers == LIMN_PUBLIC_HEADERS);
    CHECK(rooms > LIMN_PUBLIC_HEADERS);
}

TEST_CASE("The floors are read as they are written", "[architecture]") {
    const Floors& floors = the_floors();
    CHECK(floors.allows("scene", "texture", false));  // down a chain
    CHECK(floors.allows("material", "records", false));
    CHECK(floors.allows("io", "shape", false));
    CHECK(floors.allows("pattern", "image", false));  // the second chain of its line
    CHECK_FALSE(floors.allows("accel", "image", true));
    CHECK_FALSE(floors.allows("texture", "material", true));  // up
    CHECK_FALSE(floors.allows("trace", "shape", true));
    CHECK_FALSE(floors.allows("render", "shape", true));
    CHECK_FALSE(floors.allows("flat", "compile", true));
    CHECK_FALSE(floors.allows("core", "image", true));
    CHECK(floors.allows("shape", "accel", true));  // sources may, headers may not
    CHECK_FALSE(floors.allows("shape", "accel", false));
    CHECK_FALSE(floors.allows("core", "bsdf", true));
    CHECK_FALSE(floors.knows("cellar"));
    CHECK(floors.knows("record_sink"));
}

TEST_CASE("Floors in a circle are refused", "[architecture]") {
    CHECK_THROWS_WITH(Floors("attic -> b  ->  c\nc -> d\nd -> b"), "the floors have a cycle: b c d b");
    CHECK_THROWS_WITH(Floors("a -> a"), "the floors have a cycle: a a");
    CHECK_THROWS_WITH(Floors("a -> b     (sources may use c)\nc -> a"), "the floors have a cycle: a c a");
    CHECK_NOTHROW(Floors("a -> b -> d\na -> c -> d"));  // two ways down
}

TEST_CASE("An include up the stairs is reported", "[architecture]") {
    const SourceTree tree{{"include/limn/core/a.h", "#pragma once\n#include \"limn/shape/b.h\"\n"},
                          {"include/limn/shape/b.h", "#pragma once\n#include \"limn/core/a.h\"\n"},
                          {"include/limn/limn.h", ""},
                          {"lib/accel/tree.h", "#include \"limn/limn.h\"\n"},
                          {"lib/shape/b.cpp", "#include \"accel/tree.h\"\n// #include \"trace/traverse.h\"\n"},
                          {"lib/shape/b.h", "  #  include \"accel/tree.h\"\n"},
                          {"lib/trace/traverse.h", ""},
                          {"lib/shape/c.cpp", "#include \"trace/traverse.h\"\n"},
                          {"lib/records/record_sink.cpp", "#include \"limn/shape/b.h\"\n"},
                          {"lib/cellar/wine.h", ""}};
    CHECK(check_floors(tree, the_floors()) ==
          Violations{"include/limn/core/a.h:2: core -> shape is no arrow of the floors",
                     "lib/accel/tree.h:1: a room includes the umbrella",
                     "lib/shape/b.h:1: shape -> accel is no arrow of the floors",
                     "lib/shape/c.cpp:1: shape -> trace is no arrow of the floors",
                     "lib/records/record_sink.cpp:1: record_sink -> shape is no arrow of the floors",
                     "lib/cellar/wine.h:1: the floors do not know the room cellar"});
}

TEST_CASE("A private or missing header is reported where it does not belong", "[architecture]") {
    const SourceTree tree{
        {"include/limn/core/a.h", "#include \"limn/core/none.h\"\n#include \"core/secret.h\"\n"},
        {"lib/core/secret.h", "#include \"limn/core/a.h\"\n#include \"core/none.h\"\n"},
        {"lib/io/x.cpp", "#include \"core/secret.h\"\n#include \"stb_image.h\"\n"},
        {"lib/io/image_codec.h", ""},
        {"apps/common/image_loader.cpp", "#include \"io/image_codec.h\"\n#include \"core/secret.h\"\n"},
        {"apps/common/other.cpp", "#include \"io/image_codec.h\"\n"},
        {"apps/limn/main.cpp", "#include <limn/core/a.h>\n#include \"core/secret.h\"\n"},
        {"examples/e.cpp", "#include \"../lib/core/secret.h\"\n#include \"common/f.h\"\n"}};
    CHECK(check_quoted_includes(tree) ==
          Violations{"include/limn/core/a.h:1: there is no public header limn/core/none.h",
                     "include/limn/core/a.h:2: core/secret.h is private to lib",
                     "lib/core/secret.h:2: there is no header core/none.h",
                     "apps/common/image_loader.cpp:2: core/secret.h is private to lib",
                     "apps/common/other.cpp:1: io/image_codec.h is private to lib",
                     "apps/limn/main.cpp:2: core/secret.h is private to lib",
                     "examples/e.cpp:1: ../lib/core/secret.h climbs out of its folder"});
}

TEST_CASE("A library outside its rooms is reported", "[architecture]") {
    const SourceTree tree{
        {"include/limn/core/a.h", "#include <tbb/parallel_for.h>\n#include <vector>\n#include <Imath/ImathVec.h>\n"},
        {"include/limn/core/b.h", "// tbb::task_arena in a comment\nnamespace tbb { class task_arena; }\n"},
        {"include/limn/io/c.h", "struct Reader {\n    OIIO::ImageSpec* spec;\n};\nconst char* n = \"OIIO::x\";\n"},
        {"lib/io/d.h", "#include \"stb_image.h\"\n"},
        {"lib/io/d.cpp", "#include \"stb_image.h\"\n#include <OpenImageIO/imageio.h>\n"},
        {"lib/core/file_lock.cpp", "#include <unistd.h>\n"},
        {"lib/scene/e.cpp", "#include <Random123/philox.h>\n#include <unistd.h>\n"},
        {"lib/render/f.cpp", "#include <Random123/philox.h>\n#include <tbb/task_arena.h>\n#include <fmt/core.h>\n"},
        {"apps/limn/main.cpp", "#include <CLI/CLI.hpp>\n"}};
    const Violations found = check_libraries(tree);
    CHECK(found == Violations{"include/limn/core/a.h:1: oneTBB does not belong here: tbb/parallel_for.h",
                              "include/limn/core/a.h:3: not a header of std: Imath/ImathVec.h",
                              "include/limn/core/b.h:2: oneTBB does not belong here: namespace tbb",
                              "include/limn/io/c.h:2: OpenImageIO does not belong here: OIIO",
                              "lib/io/d.h:1: stb does not belong here: stb_image.h",
                              "lib/scene/e.cpp:1: Random123 does not belong here: Random123/philox.h",
                              "lib/scene/e.cpp:2: not a header of std: unistd.h",
                              "lib/render/f.cpp:3: fmt does not belong here: fmt/core.h"});
}

TEST_CASE("A header that the umbrella forgot is reported", "[architecture]") {
    CHECK(check_umbrella({{"include/limn/limn.h", "#include \"limn/core/a.h\"\n// #include \"limn/core/b.h\"\n"},
                          {"include/limn/core/a.h", ""},
                          {"include/limn/core/b.h", ""}}) ==
          Violations{"include/limn/limn.h:1: does not include limn/core/b.h"});
    CHECK(check_umbrella({}) == Violations{"include/limn/limn.h: missing"});
}

TEST_CASE("A fifth virtual function is reported", "[architecture]") {
    const std::string four =
        "virtual ~A();\nvirtual int a() = 0;\nvirtual int b() { return 1; }\n"
        "virtual int c();\nvirtual int d();\n";
    const SourceTree tree{
        {"include/limn/core/a.h", "class A {\npublic:\n" + four + "};\n"},
        {"lib/core/b.h", "struct S {};\nclass B final : public A {\n" + four + "virtual int e();\n};"}};
    CHECK(check_virtuals(tree) == Violations{"lib/core/b.h:2: B has 5 virtual functions"});
}

TEST_CASE("An object in the flat scene is reported", "[architecture]") {
    const SourceTree tree{{"lib/flat/a.h", "struct A { const Material* m; };\nstruct B { virtual int f(); };\n"},
                          {"lib/flat/b.h", "std::shared_ptr<const Hittable> h;\nMaterialId id; TextureRecord* r;\n"},
                          {"lib/shape/c.h", "const Material* m;\n"}};
    CHECK(check_flat(tree) == Violations{"lib/flat/a.h:2: dispatch in the flat scene: virtual",
                                         "lib/flat/a.h:1: a described object in the flat scene: Material*",
                                         "lib/flat/b.h:1: a described object in the flat scene: _ptr<const Hittable"});
}

TEST_CASE("A pointer that reaches beyond its member is reported", "[architecture]") {
    const SourceTree tree{
        {"lib/trace/a.h",
         "double d = (&v.x)[axis];\nconst double* p = &ray.origin.x;\nload(&rays[i].direction.x);\nload(&p->y, &x);\n"
         "const float* p = &color.r;\nconst double* q = &hit.u;\n"},
        {"lib/trace/b.h",
         "auto* f = reinterpret_cast<const float*>(words);\n"
         "auto* c = reinterpret_cast<const char*>(words);\nauto* g = (&t.row)[1];\nvoid h(int (&row)[2]);\n"},
        {"lib/shade/light_choice.cpp",
         "g = hn::GatherIndex(Floats(),\n  reinterpret_cast<const float*>(nodes) + i / 4, at);\n"
         "auto* f = reinterpret_cast<const float*>(nodes);\n"},
        {"lib/trace/c.h", "bool b = a.y && p.x;\nauto n = bits & m.x;\nauto* q = &x;\nfloat& r = v.x;\n"},
        {"apps/bench/d.cpp", "double d = (&v.x)[1];\n"}};
    CHECK(check_pointers(tree) ==
          Violations{"lib/trace/a.h:1: no pointer to one coordinate reaches another: &v.x",
                     "lib/trace/a.h:2: no pointer to one coordinate reaches another: &ray.origin.x",
                     "lib/trace/a.h:3: no pointer to one coordinate reaches another: &rays[i].direction.x",
                     "lib/trace/a.h:4: no pointer to one coordinate reaches another: &p->y",
                     "lib/trace/a.h:5: no pointer to one coordinate reaches another: &color.r",
                     "lib/trace/a.h:6: no pointer to one coordinate reaches another: &hit.u",
                     "lib/trace/a.h:1: no pointer to a member reaches another: (&v.x)[",
                     "lib/trace/b.h:3: no pointer to a member reaches another: (&t.row)[",
                     "lib/trace/b.h:1: objects are read as what they are, or as bytes: "
                     "reinterpret_cast<const float*>",
                     "lib/shade/light_choice.cpp:3: objects are read as what they are, or as bytes: "
                     "reinterpret_cast<const float*>"});
}

TEST_CASE("A question for the date is reported", "[architecture]") {
    const SourceTree tree{
        {"lib/core/a.cpp", "const auto now = std::chrono::system_clock::now();\n"},
        {"include/limn/core/a.h", "inline bool old() { return last_write_time(\"a\") < b; }\n"},
        {"apps/limn/a.cpp", "const auto seed = time(nullptr);\nif (a.st_mtime > b.st_mtim.tv_sec) c();\n"},
        {"apps/common/a.cpp", "const auto now = std::chrono::steady_clock::now();\nray.time(0.5);\n"},
        {"apps/bench/a.cpp", "const auto now = std::chrono::system_clock::now();\n"}};
    CHECK(check_clocks(tree) == Violations{"lib/core/a.cpp:1: a date can go back: system_clock",
                                           "include/limn/core/a.h:1: a date can go back: last_write_time",
                                           "apps/limn/a.cpp:1: a date can go back: time(nullptr)",
                                           "apps/limn/a.cpp:2: a date can go back: st_mtime",
                                           "apps/limn/a.cpp:2: a date can go back: st_mtim"});
}

TEST_CASE("A sine of the C library is reported", "[architecture]") {
    const SourceTree tree{
        {"lib/core/a.cpp", "const double s = std::sin(x), e = std::exp(-x) + exponential(x) + std::expm1(x);\n"},
        {"include/limn/core/a.h", "inline double f(double x) { return sine(x) * std::sqrt(x) + std::log1p(x); }\n"},
        {"lib/image/compare.cpp", "const double decibels = std::log10(x);\n"},
        {"tests/core/a.cpp", "CHECK(sine(x) == std::sin(x));\n"}};
    const std::string what = " core/elementary.h has the same bits everywhere: std::";
    CHECK(check_elementary(tree) == Violations{"lib/core/a.cpp:1:" + what + "sin", "lib/core/a.cpp:1:" + what + "exp",
                                               "lib/core/a.cpp:1:" + what + "expm1",
                                               "include/limn/core/a.h:1:" + what + "log1p"});
}

TEST_CASE("A file that is too long is reported", "[architecture]") {
    const auto lines = [](int count) {
        std::string text;
        for (int i = 0; i < count; ++i) text += "x;\n";
        return text;
    };
    const SourceTree tree{{"lib/core/a.cpp", lines(400)},
                          {"lib/core/b.cpp", lines(401)},
                          {"examples/minimal.cpp", lines(26)},
                          {"examples/custom_shape.cpp", lines(61)},
                          {"cmake/Long.cmake", lines(81)},
                          {"examples/figures/fig01_a.cpp", "#if 1\n\n" + lines(60)},
                          {"examples/figures/fig02_b.cpp", lines(61)}};
    CHECK(check_lengths(tree) == Violations{"lib/core/b.cpp:401: 401 lines, more than 400",
                                            "examples/minimal.cpp:26: 26 lines, more than 25",
                                            "examples/custom_shape.cpp:61: 61 lines, more than 60",
                                            "cmake/Long.cmake:81: 81 lines, more than 80",
                                            "examples/figures/fig02_b.cpp:61: 61 lines, more than 60"});
}

TEST_CASE("Comments and literals are no code", "[architecture]") {
    const SourceFile file("lib/core/a.cpp", R"x(/* a
 b */ int n = 1'000; // c
char q = '"'; auto s = "d // \" e"; auto r = R"(f)"; int g;
)x");
    CHECK(file.code == "\n int n = 1'000; \nchar q = ''; auto s = \"\"; auto r = \"\"; int g;\n");
    CHECK(file.lines == 3);
}
