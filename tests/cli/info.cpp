// What `limn info` says of a model or an image.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "house.h"
#include "limn/io/image_io.h"
#include "process.h"
#include "support/folder.h"
#include "table.h"

namespace limn::test::info_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST_CASE("limn info: a model's parts are counted, in the table and in the JSON", "[cli][info]") {
    const Folder folder;
    // The house, closed, and a triangle with an unknown material standing on its ridge, whose edge it shares; then
    // faces that get dropped.
    const std::string model = folder.write("a.obj", house_obj() +
                                                        "v 0 7 0\nusemtl red\nf 9 10 11\nusemtl blue\n"
                                                        "f 1 1 2\nf 1 2\nusemtl red\nf 1 2 1\n");
    const Outcome outcome = limn({"info", model, "--json", folder.path("a.json")});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    const std::string& table = outcome.out;
    CHECK(row(table, "vertices") == "11");
    CHECK(row(table, "faces") == "13");
    CHECK(row(table, "dropped faces") == "3");
    CHECK(row(table, "triangles") == "17");  // six quads, two gables, and the one on the ridge
    CHECK(row(table, "degenerate triangles") == "2");
    CHECK(row(table, "bounds") == "(-3, 0, -2) to (3, 7, 2)");
    CHECK(row(table, "edges") == "26");  // Euler: 10 - E + 16 = 2 for the house, and two more
    CHECK(row(table, "open edges") == "2");
    CHECK(row(table, "non-manifold edges") == "1");
    CHECK(row(table, "closed") == "no");
    CHECK(row(table, "normals") == "no");
    CHECK(row(table, "texture coordinates") == "no");
    CHECK(row(table, "materials") == "red, blue");
    CHECK(row(table, "warning").find("unknown material 'red'") != std::string::npos);

    const Json json = Json::parse(folder.read("a.json"));
    CHECK(json["kind"] == "model");
    CHECK(json["file"] == model);
    CHECK(json["vertices"] == 11);
    CHECK(json["faces"] == 13);
    CHECK(json["dropped_faces"] == 3);
    CHECK(json["triangles"] == 17);
    CHECK(json["degenerate_triangles"] == 2);
    CHECK(json["bounds"]["lower"] == Json{-3, 0, -2});
    CHECK(json["bounds"]["upper"] == Json{3, 7, 2});
    CHECK(json["edges"] == 26);
    CHECK(json["open_edges"] == 2);
    CHECK(json["nonmanifold_edges"] == 1);
    CHECK(json["closed"] == false);
    CHECK(json["normals"] == false);
    CHECK(json["texture_coordinates"] == false);
    CHECK(json["materials"] == Json{"red", "blue"});
    CHECK(json["warnings"].size() == 2);
}

TEST_CASE("limn info: normals and texture coordinates split vertices and open no edge", "[cli][info]") {
    const Folder folder;
    const std::string model =
        folder.write("a.OBJ",
                     "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvn 0 0 1\nvn 1 0 0\n"
                     "f 1/1/1 3/1/1 2/1/1\nf 1/2/2 2/2/2 4/2/2\nf 2//1 3//2 4\nf 1//1 4//1 3//1\n");
    const Outcome outcome = limn({"info", model, "--json", "-"});
    REQUIRE(outcome.status == 0);
    const Json json = Json::parse(outcome.out);  // which stands alone
    CHECK(json["vertices"] == 4);
    CHECK(json["edges"] == 6);
    CHECK(json["open_edges"] == 0);
    CHECK(json["closed"] == true);
    CHECK(json["normals"] == true);
    CHECK(json["texture_coordinates"] == true);
    CHECK(json["materials"].empty());
    const std::string table = limn({"info", model}).out;
    CHECK(row(table, "closed") == "yes");
    CHECK(row(table, "normals") == "yes");
    CHECK(row(table, "texture coordinates") == "yes");
    CHECK(row(table, "materials") == "none");
}

TEST_CASE("limn info: an image has a size, channels and the facts of its render", "[cli][info]") {
    const Folder folder;
    const SaveOptions half{.half = true, .facts = {{"spp", "16"}, {"notes", "one\ntwo"}}};
    save_image(Image(5, 3), folder.path("a.exr"), half);
    const Outcome outcome = limn({"info", folder.path("a.exr"), "--json", folder.path("a.json")});
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(row(outcome.out, "size") == "5 x 3");
    CHECK(row(outcome.out, "channels") == "R, G, B");
    CHECK(row(outcome.out, "pixel type") == "half");
    CHECK(row(outcome.out, "spp") == "16");
    CHECK(row(outcome.out, "notes") == "one two");  // a row is a line
    const Json json = Json::parse(folder.read("a.json"));
    CHECK(json["kind"] == "image");
    CHECK(json["width"] == 5);
    CHECK(json["height"] == 3);
    CHECK(json["channels"].size() == 3);
    CHECK(json["channels"][2] == Json{{"name", "B"}, {"type", "half"}});
    CHECK(json["facts"] == Json{{"spp", "16"}, {"notes", "one\ntwo"}});
}

TEST_CASE("limn info: a picture says how many of its samples and rays were unusable", "[cli][info]") {
    const Folder folder;
    const std::string model = folder.write("a.obj", house_obj());
    REQUIRE(limn({"render", model, "-o", folder.path("a.exr"), "--size", "8x8", "--spp", "1"}).status == 0);
    const std::string table = limn({"info", folder.path("a.exr")}).out;
    CHECK(row(table, "nonfinite_samples") == "0");
    CHECK(row(table, "unusable_rays") == "0");
}

TEST_CASE("limn info: a film says its crop, in the table and in the JSON", "[cli][info]") {
    const Folder folder;
    const std::string model = folder.write("a.obj", house_obj()), film = folder.path("a.film");
    const Words render = {"render", model, "--film", film, "--size", "8x8", "--spp", "1", "--quiet"};
    const auto json = [&] { return Json::parse(limn({"info", film, "--json", "-"}).out); };
    REQUIRE(limn(render).status == 0);
    CHECK(json().at("crop") == nullptr);
    Words cropped = render;
    cropped.insert(cropped.end(), {"--crop", "1,2,7,8"});
    REQUIRE(limn(cropped).status == 0);
    CHECK(json().at("crop") == Json{1, 2, 7, 8});
    CHECK(row(limn({"info", film}).out, "crop") == "1,2,7,8");
}

TEST_CASE("limn info: a model with a vertex that is no number, or too large for one, is refused with its line",
          "[cli][info]") {
    const Folder folder;
    for (const char* number : {"nan", "inf", "-inf", "1e40", "1e999"}) {
        const std::string model =
            folder.write("a.obj", house_obj() + "v 0 0 0\nv 1 " + number + " 0\nv 0 1 0\nf 11 12 13\n");
        const std::string text = folder.read("a.obj");
        const std::string before = text.substr(0, text.find("v 1 " + std::string(number)));
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const Outcome outcome = limn({"info", model});
        CAPTURE(number, outcome.err);
        CHECK(outcome.status == 1);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.find(model + ": line " + std::to_string(line) + ": ") != std::string::npos);
    }
}

TEST_CASE("limn info: the contents tell a model from an image, whatever the name", "[cli][info]") {
    const Folder folder;
    save_image(Image(5, 3), folder.path("a.png"));
    fs::rename(folder.path("a.png"), folder.path("a.obj"));
    CHECK(row(limn({"info", folder.path("a.obj")}).out, "size") == "5 x 3");
    for (const char* name : {"b.png", "b.txt", "b"})
        CHECK(row(limn({"info", folder.write(name, house_obj())}).out, "vertices") == "10");
}

TEST_CASE("limn info: what is no model and no image is refused with status 1", "[cli][info]") {
    const Folder folder;
    const std::pair<std::string, std::string> cases[] = {
        {folder.write("a.txt", "some text\n"),
         "a.txt: is not a readable image: those that are read are EXR, PNG, JPEG, HDR, BMP, TGA; as a model: " +
             folder.path("a.txt") + ": line 1: 'some' is no statement of an OBJ"},
        {folder.write("damaged.obj", "\x89PNG\r\n\x1a\n"), "damaged.obj: is not a whole PNG: "},
        {folder.write("b.exr", "no picture"), "is not a readable image"},
        {folder.write("c.png", ""), "is not a readable image"},
        {folder.write("d.obj", "no model\n"), "is no statement of an OBJ"},
        {folder.write("e", ""), "is not a readable image"},
        {folder.path("none.obj"), "none.obj: there is no such file\n"},
        {folder.path("none.png"), "none.png: there is no such file\n"},
        {folder.path(), "is a folder"},
    };
    for (const auto& [file, message] : cases) {
        CAPTURE(file);
        const Outcome outcome = limn({"info", file, "--json", folder.path("j.json")});
        CHECK(outcome.status == 1);
        CHECK(outcome.err.starts_with("limn: " + file + ": "));
        CHECK(outcome.err.find(message) != std::string::npos);
        CHECK(outcome.out.empty());
    }
    CHECK(folder.names().count("j.json") == 0);
}

}  // namespace
}  // namespace limn::test::info_test
