// Names of an OBJ's objects and groups, and models out of memory.
#include "catch.h"
#include "limn/io/model.h"
#include "limn/math/error.h"
#include "support/folder.h"

namespace limn::model_parts_test {

using namespace test;

namespace {

Model from_text(const std::string& text) {
    return load_model_from_memory(std::as_bytes(std::span(text)), "standard input");
}

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("OBJ: faces belong to what o and g say before them", "[io][obj]") {
    const Model model = from_text(kCorners +
                                  "f 1 2 3\no house\nf 1 2 3\nf 1 2 3\ng roof tiles\nf 1 2 3\ng empty\no tree\ng\n"
                                  "f 1 2 3\ng roof tiles\no tree\nf 1 2 3\n");
    REQUIRE(model.parts.size() == 3);
    const auto name = [&](std::size_t face) {
        const ModelPart* part = model.part_of(face);
        return part ? part->object + "/" + part->group : "none";
    };
    CHECK(name(0) == "none");
    CHECK(name(1) == "house/");
    CHECK(name(2) == "house/");
    CHECK(name(3) == "house/roof tiles");
    CHECK(name(4) == "tree/");
    CHECK(name(5) == "tree/");
    CHECK(from_text(kCorners + "f 1 2 3\n").parts.empty());
}

TEST_CASE("Model: from memory it is that of the file, and messages call it what the caller does", "[io][model]") {
    const Folder folder;
    const std::string text = kCorners + "o a\nf 1 2 3\n";
    const Model file = load_model(folder.write("a.obj", text)), memory = from_text(text);
    CHECK(memory.meshes[0]->data().vertices == file.meshes[0]->data().vertices);
    CHECK(memory.faces == 1);
    CHECK_THROWS_WITH(from_text("v 0 0\n"), Catch::Contains("standard input") && Catch::Contains("line 1"));
    CHECK_THROWS_WITH(from_text(""), Catch::Contains("standard input"));
    const std::string utf16("\xff\xfev\0 \0", 6);
    CHECK_THROWS_WITH(from_text(utf16), Catch::Contains("UTF-16"));
}

}  // namespace limn::model_parts_test
