// Text results: whole or not at all, through links, and never over what is read.
#include "text_file.h"

#include "catch.h"
#include "limn/math/error.h"
#include "process.h"
#include "support/folder.h"

namespace limn::test::text_file_test {
namespace {

namespace fs = std::filesystem;

TEST_CASE("Text file: replaces what was there, and leaves nothing else in the folder", "[cli]") {
    const Folder folder;
    const std::string path = folder.write("a.json", "a longer text that was there before");
    app::check_text_path(path);
    app::write_text(path, "new");
    CHECK(folder.read("a.json") == "new");
    const std::string large(3'000'000, 'x');
    app::write_text(folder.path("b.json"), large);
    CHECK(folder.read("b.json") == large);
    CHECK(folder.names() == Names{"a.json", "b.json"});
}

TEST_CASE("Text file: a link stays one, and the file behind it is replaced", "[cli]") {
    const Folder folder;
    folder.write("file", "old");
    fs::create_symlink("file", folder.path("link"));
    app::check_text_path(folder.path("link"));
    app::write_text(folder.path("link"), "new");
    CHECK(fs::is_symlink(folder.path("link")));
    CHECK(folder.read("file") == "new");
}

TEST_CASE("Text file: what cannot be written is named, and nothing is left behind", "[cli]") {
    const Folder folder;
    fs::create_directory(folder.path("sub"));
    folder.write("sub/inner", "kept");
    for (const std::string& path : {folder.path("sub"), folder.path("none/a.json")}) {
        CHECK_THROWS_AS(app::check_text_path(path), FileError);
        CHECK_THROWS_WITH(app::write_text(path, "text"), Catch::Contains(path));
    }
    CHECK_THROWS_WITH(app::check_text_path(""), Catch::Contains("is not the name of a file"));
    CHECK_NOTHROW(app::check_text_path("-"));
    CHECK(folder.names() == Names{"sub"});
    CHECK(folder.read("sub/inner") == "kept");
}

TEST_CASE("Text file: a standard output that takes nothing ends a program with status 1", "[cli]") {
    const Outcome outcome = run("/bin/sh", {"-c", std::string(LIMN_PROGRAM) + " --version > /dev/full"});
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("standard output") != std::string::npos);
}

TEST_CASE("Text file: outputs and inputs are told apart by the file, however it is named", "[cli]") {
    const Folder folder;
    folder.write("a", "");
    fs::create_symlink("a", folder.path("link"));
    const std::string a = folder.path("a"), b = folder.path("b");
    CHECK_NOTHROW(app::check_distinct({a, b}, {}));
    CHECK_NOTHROW(app::check_distinct({b}, {a, a}));  // inputs may be read twice
    CHECK_NOTHROW(app::check_distinct({"-", "-", "", ""}, {"", "-"}));
    for (const std::string& same : {a, folder.path("./a"), folder.path("link"), folder.path("none/../a")}) {
        CHECK_THROWS_AS(app::check_distinct({a, same}, {}), ArgumentError);
        CHECK_THROWS_AS(app::check_distinct({b, same}, {a}), ArgumentError);
    }
}

}  // namespace
}  // namespace limn::test::text_file_test
