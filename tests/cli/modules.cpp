// OpenImageIO comes in a module, which programs load when a picture is read or written.
#include <filesystem>

#include "catch.h"
#include "house.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "process.h"
#include "support/folder.h"

namespace limn::test::modules_test {
namespace {

namespace fs = std::filesystem;

const std::string kModule = "limn_openimageio.so";
const fs::path kBuilt = fs::path(LIMN_PROGRAM).parent_path() / kModule;

/// bin/limn alone in a folder of its own, its module yet to be put somewhere.
class MovedProgram {
public:
    MovedProgram() {
        fs::create_directory(bin());
        fs::copy(LIMN_PROGRAM, bin() / "limn");
        save_image(Image(2, 1), picture());
    }
    fs::path bin() const { return folder_.path("bin"); }
    fs::path installed() const { return (bin() / LIMN_MODULE_FOLDER).lexically_normal(); }
    std::string picture() const { return folder_.path("a.png"); }
    /// Runs it in the folder `in`, which is where LD_LIBRARY_PATH points, too.
    Outcome run(const Words& arguments, const fs::path& in = "/") const {
        Words words = {"LD_LIBRARY_PATH=" + in.string(), (bin() / "limn").string()};
        words.insert(words.end(), arguments.begin(), arguments.end());
        return test::run("/usr/bin/env", words, in);
    }

private:
    Folder folder_;
};

void put(const fs::path& module, const fs::path& folder) {
    fs::create_directories(folder);
    fs::copy(module, folder / kModule);
}

void check_refused(const MovedProgram& program, const Outcome& outcome, const std::string& why) {
    INFO(outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find((program.bin() / kModule).string() + " " + why) != std::string::npos);
    CHECK(outcome.err.find((program.installed() / kModule).string() + " is not there") != std::string::npos);
}

TEST_CASE("Modules: OpenImageIO is loaded for pictures, and for nothing else", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("a.obj", house_obj()), picture = folder.path("a.png");
    save_image(Image(2, 1), picture);
    const auto loads = [](const Words& arguments, const std::string& program = LIMN_PROGRAM) {
        Words words = {"LD_DEBUG=files", program};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run("/usr/bin/env", words);
        CHECK(outcome.status == 0);
        CHECK(outcome.err.find("libstdc++") != std::string::npos);
        return outcome.err.find("OpenImageIO") != std::string::npos;
    };
    CHECK_FALSE(loads({"--version"}));
    CHECK_FALSE(loads({"--help"}));
    CHECK_FALSE(loads({"render", "--help"}));
    CHECK_FALSE(loads({"info", model}));
    CHECK_FALSE(loads({"trace", model}));
    CHECK_FALSE(loads({"--help"}, TINY_FIGURE_PROGRAM));
    CHECK(loads({"info", picture}));
    CHECK(loads({"compare", picture, picture}));
    CHECK(loads({"render", model, "-o", picture, "--size", "2x2", "--spp", "1"}));
}

TEST_CASE("Modules: what fails in one keeps its type", "[cli]") {
    const Folder folder;
    const std::string path = folder.write("a.exr", "\x76\x2f\x31\x01 and no more");
    try {
        load_image(path);
        FAIL("a broken picture was read");
    } catch (const FileError& e) {
        CHECK(e.path() == path);
        CHECK(std::string(e.what()).starts_with(path + ": "));
    }
}

TEST_CASE("Modules: where the program is installed its modules are found", "[cli]") {
    const MovedProgram program;
    put(kBuilt, program.installed());
    const Outcome outcome = program.run({"info", program.picture()});
    INFO(outcome.err);
    CHECK(outcome.status == 0);
}

TEST_CASE("Modules: one that is missing is told with the paths tried, before anything is rendered", "[cli]") {
    const MovedProgram program;
    check_refused(program, program.run({"info", program.picture()}), "is not there");
    check_refused(program, program.run({"render", "none.obj", "-o", "a.png"}), "is not there");
    CHECK(program.run({"--version"}).status == 0);
}

TEST_CASE("Modules: none is taken from the working directory or the search path of libraries", "[cli]") {
    const MovedProgram program;
    const Folder working;
    put(kBuilt, working.path());
    check_refused(program, program.run({"info", program.picture()}, working.path()), "is not there");
}

TEST_CASE("Modules: one of another version, and what is none, are refused", "[cli]") {
    const MovedProgram program;
    SECTION("another version") {
        put(OTHER_MODULE, program.bin());
        check_refused(program, program.run({"info", program.picture()}), "is a module of limn 0.0.1, not of ");
    }
    SECTION("another library") {
        put(OTHER_LIBRARY, program.bin());
        check_refused(program, program.run({"info", program.picture()}), "is no module of limn");
    }
    SECTION("a module with nothing in it") {
        put(EMPTY_MODULE, program.bin());
        check_refused(program, program.run({"info", program.picture()}), "has no limn_module");
    }
    SECTION("a link to itself, of which nobody knows whether it is there") {
        fs::create_symlink(kModule, program.bin() / kModule);
        check_refused(program, program.run({"info", program.picture()}), "cannot be loaded (");
    }
    SECTION("no library") {
        std::ofstream(program.bin() / kModule) << "text";
        check_refused(program, program.run({"info", program.picture()}), "cannot be loaded (");
    }
}

}  // namespace
}  // namespace limn::test::modules_test
