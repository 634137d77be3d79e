// What `limn render` shows, and of which pixels.
#include <signal.h>

#include <chrono>
#include <functional>
#include <thread>

#include "catch.h"
#include "house.h"
#include "limn/io/image_io.h"
#include "limn/render/film.h"
#include "process.h"
#include "support/folder.h"
#include "table.h"

namespace limn::test::view_test {
namespace {

// Renders the house with these options to a.exr, small.
class House {
public:
    Outcome render(const Words& options, const std::string& name = "a.exr") const {
        Words words = {"render", model_, "-o", path(name), "--size", "32x24", "--spp", "8", "--quiet"};
        words.insert(words.end(), options.begin(), options.end());
        return limn(words);
    }
    Image image(const Words& options = {}) const {
        const Outcome outcome = render(options);
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        return load_image(path());
    }
    std::string path(const std::string& name = "a.exr") const { return folder_.path(name); }
    const std::string& model() const { return model_; }
    const Folder& folder() const { return folder_; }

private:
    Folder folder_;
    std::string model_ = folder_.write("house.obj", house_obj());
};

std::vector<std::string> channels_of(const std::string& path) {
    std::vector<std::string> names;
    for (const ImageChannel& channel : load_image_info(path).channels) names.push_back(channel.name);
    return names;
}

TEST_CASE("limn render: --crop gives the pixels of the whole picture, and the file says where they lie", "[cli]") {
    const House house;
    const Image whole = house.image(), part = house.image({"--crop", "5,3,30,20"});
    REQUIRE(part.width() == 25);
    REQUIRE(part.height() == 17);
    for (int y = 0; y < 17; ++y)
        for (int x = 0; x < 25; ++x) CHECK(part.at(x, y) == whole.at(x + 5, y + 3));
    CHECK(load_image_info(house.path()).part_of == PartOf{5, 3, 32, 24});
    const std::string info = limn({"info", house.path()}).out;
    CHECK(info.find("32 x 24, from (5, 3) on") != std::string::npos);
    CHECK(info.find("5,3,30,20 of 32x24") != std::string::npos);
}

TEST_CASE("limn render: without a background the picture has alpha, in EXR and PNG", "[cli]") {
    const House house;
    CHECK(house.render({"--background", "none", "--ground", "none", "-o", house.path("a.png")}).status == 0);
    CHECK(channels_of(house.path()) == std::vector<std::string>{"R", "G", "B", "A"});
    CHECK(channels_of(house.path("a.png")) == std::vector<std::string>{"R", "G", "B", "A"});
    CHECK(load_image(house.path()).at(0, 0) == Color{});
    house.image({"--background", "none", "--ground", "none", "--crop", "0,0,4,4"});
    CHECK(channels_of(house.path()).size() == 4);
}

TEST_CASE("limn render: --background is what is seen behind, and light, and the ground hides it unless there is none",
          "[cli]") {
    const House house;
    CHECK(house.image({"--background", "0.25,0.5,1", "--ground", "none"}).at(0, 0) == Color{0.25, 0.5, 1});
    const Image with_ground = house.image({"--background", "0.25,0.5,1"});
    CHECK(with_ground.at(0, 23) != Color{0.25, 0.5, 1});
    CHECK(with_ground.at(0, 23) != house.image().at(0, 23));
}

TEST_CASE("limn render: an environment map takes the place of sky and key light, and is refused by its name", "[cli]") {
    const House house;
    const std::string map = house.path("map.exr");
    save_image(Image(4, 2, {3, 2, 1}), map);
    CHECK(house.image({"--environment", map, "--ground", "none"}).at(0, 0) == Color{3, 2, 1});
    const Color ground = house.image({"--environment", map}).at(0, 0);  // of albedo 0.4, far from the house
    CHECK(ground.r == Approx(1.2).epsilon(0.1));
    CHECK(ground.b == Approx(0.4).epsilon(0.1));
    const Image cut_out = house.image({"--environment", map, "--background", "none", "--ground", "none"});
    CHECK(cut_out.at(0, 0) == Color{});
    CHECK(cut_out.at(16, 12).r > cut_out.at(16, 12).b);

    const Outcome missing = house.render({"--environment", house.path("none.exr")});
    CHECK(missing.status == 1);
    CHECK(missing.err.find("none.exr") != std::string::npos);
    save_image(Image(4, 2, {-3, 2, 1}), map);
    const Outcome negative = house.render({"--environment", map});
    CHECK(negative.status == 1);
    CHECK(negative.err.find(map) != std::string::npos);
    CHECK(house.render({"--environment", house.path()}).status == 2);  // an output must not replace an input
    CHECK(house.render({"--environment", map, "--background", "1,1,1"}).status == 2);
}

TEST_CASE("limn render: each projection shows the house in its own way", "[cli]") {
    const House house;
    const Image perspective = house.image(), flat = house.image({"--projection", "orthographic"}),
                low = house.image({"--projection", "orthographic", "--height", "40"}),
                panorama = house.image({"--projection", "panorama"});
    CHECK(perspective == house.image({"--projection", "perspective"}));
    CHECK_FALSE(flat == perspective);
    CHECK_FALSE(low == flat);
    CHECK_FALSE(panorama == perspective);
}

TEST_CASE("limn render: a film of another projection is refused", "[cli]") {
    const House house;
    REQUIRE(house.render({"--film", house.path("a.film")}).status == 0);
    const Outcome other = house.render({"--projection", "orthographic", "--resume", house.path("a.film")});
    CHECK(other.status == 1);
    CHECK(other.err.find("is not of this render: its ") != std::string::npos);
}

TEST_CASE("limn render: --channels of the first hit are in the EXR, beside error and samples", "[cli]") {
    const House house;
    house.image({"--channels", "albedo,normal,depth,position,object,primitive,error,samples"});
    const std::vector<std::string> names = channels_of(house.path());
    for (const char* name :
         {"R", "albedo.R", "albedo.B", "normal.X", "position.Z", "depth", "object", "primitive", "error", "samples"})
        CHECK(std::ranges::count(names, name) == 1);
    CHECK(names.size() == 3 + 9 + 3 + 2);
}

TEST_CASE("limn render: --exposure brightens the PNG alone", "[cli]") {
    const House house;
    const Image exr = house.image({"-o", house.path("a.png")});
    const Image png = load_image(house.path("a.png"));
    CHECK(house.image({"-o", house.path("b.png"), "--exposure", "-1"}) == exr);
    const Image darker = load_image(house.path("b.png"));
    for (int x = 0; x < 32; ++x)
        if (max_component(png.at(x, 12)) < 1) CHECK(darker.at(x, 12).g == Approx(png.at(x, 12).g / 2).margin(0.01));
}

TEST_CASE("limn render: a model from standard input is that of the file, and is named so in messages", "[cli]") {
    const House house;
    const Image wanted = house.image();
    const Words words = {"render", "-", "-o", house.path("b.exr"), "--size", "32x24", "--spp", "8"};
    REQUIRE(limn_reads(house_obj(), words).status == 0);
    CHECK(load_image(house.path("b.exr")) == wanted);
    const Outcome broken = limn_reads("v 1 2\n", words);
    CHECK(broken.status == 1);
    CHECK(broken.err.find("standard input: line 1") != std::string::npos);
    const std::string rays = house.folder().write("rays.txt", "0 9 0 0 -1 0\n");
    CHECK(limn_reads(house_obj(), {"trace", "-", "--rays", rays}).out ==
          limn_reads("", {"trace", house.model(), "--rays", rays}).out);
    CHECK(limn_reads(house_obj(), {"info", "-"}).out == limn({"info", house.model()}).out);
    CHECK(limn_reads(house.folder().read("b.exr"), {"info", "-"}).out == limn({"info", house.path("b.exr")}).out);
    const Outcome neither = limn_reads("GIF89a", {"info", "-"});
    CHECK(neither.status == 1);
    CHECK(neither.err.starts_with("limn: standard input: is not a readable image: it appears to be a GIF picture"));
    CHECK(neither.err.find("; as a model: standard input: ") != std::string::npos);
}

TEST_CASE("limn render: --smooth gives a mesh without normals smooth ones", "[cli]") {
    const House house;
    CHECK_FALSE(house.image({"--smooth", "180"}) == house.image());
    CHECK(house.image({"--smooth", "0"}) == house.image());
}

// A triangle, and a camera in the node `front`.
const std::string kSeen = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
"nodes": [{"mesh": 0}, {"camera": 0, "name": "front", "translation": [0.5, 0.5, 4]}],
"cameras": [{"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 1, "zfar": 9, "znear": 0}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

std::string seen_with(const std::string& what, const std::string& by) {
    return std::string(kSeen).replace(kSeen.find(what), what.size(), by);
}

TEST_CASE("limn render: --camera takes a camera of the model, with the shape of its picture", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("a.gltf", kSeen);
    const auto render = [&](const Words& options) {
        Words words = {"render", model, "-o", folder.path("a.exr"), "--spp", "1", "--ground", "none"};
        words.insert(words.end(), options.begin(), options.end());
        return limn(words);
    };
    REQUIRE(render({"--camera", "front", "--channels", "depth"}).status == 0);
    const Image image = load_image(folder.path("a.exr"));
    CHECK(image.width() == 800);
    CHECK(image.height() == 400);
    const Outcome other = render({"--camera", "side"});
    CHECK(other.status == 1);
    CHECK(other.err.find("has no camera 'side'; it has front") != std::string::npos);

    folder.write("a.gltf", seen_with(R"("xmag": 2)", R"("xmag": 1e300)"));
    const Outcome wide = render({"--camera", "front"});
    CHECK(wide.status == 1);
    CHECK(wide.err.find(model + ": camera 'front' is 1e+300 times as wide as high: --size is needed") !=
          std::string::npos);
    CHECK(render({"--camera", "front", "--size", "4x4"}).status == 0);

    folder.write("a.gltf", seen_with(R"({"camera": 0, "name": "front", "translation": [0.5, 0.5, 4]})",
                                     R"({"mesh": 0, "translation": [1e308, 0, 0]})"));
    CHECK(render({}).err.starts_with("limn: " + model + ": "));
}

TEST_CASE("limn: names of a model reach the terminal without control characters", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("a.gltf", seen_with("front", R"(fr\u001b[31mont\nb)"));
    const Outcome info = limn({"info", model});
    CHECK(row(info.out, "cameras") == "fr?[31mont b");
    const Outcome none = limn({"render", model, "-o", folder.path("a.exr"), "--camera", "x"});
    CHECK(none.err == "limn: " + model + ": has no camera 'x'; it has fr?[31mont b\n");
}

TEST_CASE("limn render: a model without triangles is refused", "[cli]") {
    const Folder folder;
    const std::string points = folder.write("a.obj", "v 0 0 0\nv 1 0 0\n");
    const Outcome outcome = limn({"render", points, "-o", folder.path("a.png")});
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("has no usable face") != std::string::npos);
    CHECK(folder.names() == std::set<std::string>{"a.obj"});
}

bool happens_within_a_minute(const std::function<bool()>& event) {
    const auto last = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!event()) {
        if (std::chrono::steady_clock::now() > last) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

TEST_CASE("limn render: --preview replaces each picture while it renders, again and again, by a whole one", "[cli]") {
    const House house;
    const std::string exr = house.path(), png = house.path("a.png");
    OnTerminal program(LIMN_PROGRAM, {"render", house.model(), "-o", exr, "-o", png, "--size", "32x24", "--quiet",
                                      "--spp", "1000000000", "--preview", "0.02"});
    Names names = {"a.exr", "a.png", "house.obj"};
    // A second name keeps what is there, and tells when another file has taken its place.
    for (const std::string& path : {exr, png}) {
        REQUIRE(happens_within_a_minute([&] { return std::filesystem::exists(path); }));
        for (int i = 1; i <= 3; ++i) {
            const std::string name = std::to_string(i) + std::filesystem::path(path).extension().string();
            const std::string kept = house.path(name);
            std::filesystem::create_hard_link(path, kept);
            names.insert(name);
            REQUIRE(happens_within_a_minute([&] { return !std::filesystem::equivalent(path, kept); }));
            const Image image = load_image(kept);
            CHECK((image.width() == 32 && image.height() == 24));
        }
    }
    const Image first = load_image(house.path("1.exr"));
    CHECK(happens_within_a_minute([&] { return load_image(exr) != first; }));  // whenever it is read
    program.send(SIGINT);
    const Outcome outcome = program.finish();
    CHECK(outcome.status == 130);  // until then it rendered
    CHECK(outcome.err.empty());
    CHECK(house.folder().names() == names);
}

}  // namespace
}  // namespace limn::test::view_test
