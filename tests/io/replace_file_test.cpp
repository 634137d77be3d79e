// Files of any kind appear whole or not at all, whatever happens to the process or the disk.
#include "math/system/replace_file.h"

#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <thread>

#include "catch.h"
#include "formats.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "limn/math/system/files.h"
#include "support/folder.h"

namespace limn::replace_file_test {

using namespace test;

namespace {

int kills(int ordinarily) { return std::getenv("LIMN_FULL") ? 200 : ordinarily; }

std::string saved(const Folder& folder, const Image& image) {
    save_image(image, folder.path("saved.png"));
    const std::string bytes = folder.read("saved.png");
    std::filesystem::remove(folder.path("saved.png"));
    return bytes;
}

// Kills `child` after a random time of up to `longest`; what it was writing must be one of the two whole files.
void kill_and_check(pid_t child, std::mt19937& generator, std::chrono::microseconds longest, const Folder& folder,
                    const std::string& one, const std::string& other) {
    const auto count = static_cast<std::uint_fast32_t>(longest.count());
    std::this_thread::sleep_for(std::chrono::microseconds(generator() % count));
    kill(child, SIGKILL);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    const std::string standing = folder.read("a.png");
    CHECK((standing == one || standing == other));
    for (const std::string& name : folder.names()) {
        const bool is_left_over = name.starts_with(".limn-") && name.ends_with(".tmp");
        CHECK((name == "a.png" || is_left_over));
        if (is_left_over) std::filesystem::remove(folder.path(name));
    }
}

// Runs `call` in a process of its own, with a disk of 64 KiB at `folder`. Its exit status, or `kNoDisk`.
constexpr int kNoDisk = 77;
template <class Call>
int on_small_disk(const Folder& folder, Call call) {
    const pid_t child = fork();
    if (child == 0) {
        const int user = getuid() == 0 ? 0 : CLONE_NEWUSER;
        if (unshare(user | CLONE_NEWNS) != 0 || mount("none", "/", "none", MS_REC | MS_PRIVATE, nullptr) != 0 ||
            mount("limn", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0)
            _exit(kNoDisk);
        _exit(call());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool refused_with(const std::string& path, const std::string& text, const std::string& reason) {
    try {
        save_text(text, path);
        return false;
    } catch (const FileError& error) {
        const std::string message = error.what();
        return message.starts_with(path + ": ") && message.find(reason) != std::string::npos;
    }
}

}  // namespace

TEST_CASE("Files: a text is saved as it is, and names are followed through folders and links", "[io]") {
    const Folder folder;
    const std::string text("a\0b\r\n\xff", 6);
    check_text_writable(folder.path("a.json"));
    CHECK(folder.names().empty());
    save_text(text, folder.path("a.json"));
    CHECK(folder.read("a.json") == text);
    save_text("", folder.path("a.json"));
    CHECK(folder.read("a.json").empty());
    const std::string whole = std::filesystem::canonical(folder.path()).string();
    std::filesystem::create_directory(folder.path("b"));
    std::filesystem::create_symlink("../a.json", folder.path("b/link"));
    std::filesystem::create_symlink("none", folder.path("b/dangling"));
    std::filesystem::create_symlink("b", folder.path("c"));
    CHECK(file_behind_links(folder.path("b/../a.json")) == whole + "/a.json");
    CHECK(file_behind_links(folder.path("c/link")) == whole + "/a.json");
    CHECK(file_behind_links(folder.path("c/dangling")) == whole + "/b/none");
    CHECK(file_behind_links(folder.path("none/x")) == whole + "/none/x");
    CHECK_THROWS_AS(save_text("x", ""), FileError);
    CHECK_THROWS_AS(check_text_writable("/dev/null"), FileError);
}

TEST_CASE("Files: what killed processes left behind is removed, what others are writing is not", "[io]") {
    const Folder folder;
    folder.write(".limn-1-0.tmp", "left behind");
    folder.write(".limn-999999999-12.tmp", "left behind");
    folder.write(".limn-x", "not ours");
    folder.write("a.tmp", "not ours");
    FileReplacement other(folder.path("b"));
    other.write(std::as_bytes(std::span("half", 4)));
    save_text("new", folder.path("a"));
    CHECK(folder.names().size() == 4);  // a, what is not ours, and what is being written
    other.commit();
    CHECK(folder.names() == Names{".limn-x", "a", "a.tmp", "b"});
    CHECK(folder.read("b") == "half");
}

TEST_CASE("Files: on a full disk, and on one that is read-only, the old file stays", "[io]") {
    const Folder folder;
    const std::string path = folder.path("a.json");
    const int status = on_small_disk(folder, [&] {
        save_text("old", path);
        const Names before = folder.names();
        if (!refused_with(path, std::string(100'000, 'x'), "No space left")) return 1;
        if (folder.names() != before || folder.read("a.json") != "old") return 2;
        save_text(std::string(30'000, 'y'), folder.path("b.json"));
        save_text(std::string(24'000, 'y'), folder.path("c.json"));  // now no block is free
        bool refused = false;
        try {
            save_text("z", folder.path("d.json"));
            check_text_writable(folder.path("d.json"));
        } catch (const FileError&) {
            refused = true;
        }
        if (!refused || folder.read("a.json") != "old") return 3;
        if (mount("none", folder.path().c_str(), "none", MS_REMOUNT | MS_RDONLY, nullptr) != 0) return kNoDisk;
        if (!refused_with(path, "new", "Read-only file system")) return 4;
        return folder.read("a.json") == "old" ? 0 : 5;
    });
    if (status == kNoDisk) {
        WARN("no disk can be mounted here");
        return;
    }
    CHECK(status == 0);
}

TEST_CASE("Files: whenever the process is killed, the old or the new file stands there", "[io]") {
    const Folder folder;
    const std::string one(200'000, 'x'), other(150'000, 'y');
    save_text(one, folder.path("a.png"));
    std::mt19937 generator(80);
    for (int i = 0; i < kills(40); ++i) {
        const pid_t child = fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            try {
                for (;;)
                    for (const std::string* text : {&other, &one}) save_text(*text, folder.path("a.png"));
            } catch (...) {}
            _exit(1);
        }
        kill_and_check(child, generator, std::chrono::microseconds(8000), folder, one, other);
    }
}

// Not a test of its own: what the next one starts and kills.
TEST_CASE("writes two pictures in turn until it is killed", "[.writer]") {
    const char* path = std::getenv("LIMN_TEST_PICTURE");
    REQUIRE(path != nullptr);
    for (unsigned i = 0; i < 1'000'000; ++i) save_image(noise(100, 100, i % 2), path);
}

TEST_CASE("Saving: whenever the process is killed, the old or the new picture stands there", "[io][image]") {
    const Folder folder;
    const std::string path = folder.path("a.png");
    const std::string even = saved(folder, noise(100, 100, 0)), odd = saved(folder, noise(100, 100, 1));
    std::mt19937 generator(81);
    setenv("LIMN_TEST_PICTURE", path.c_str(), 1);
    for (int i = 0; i < kills(3); ++i) {
        folder.write("a.png", "not yet");
        std::string program = std::filesystem::read_symlink("/proc/self/exe"), filter = "[.writer]";
        char* arguments[] = {program.data(), filter.data(), nullptr};
        pid_t child = 0;
        posix_spawn_file_actions_t quiet;
        posix_spawn_file_actions_init(&quiet);
        posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", 1, 0);
        REQUIRE(posix_spawn(&child, program.c_str(), &quiet, nullptr, arguments, environ) == 0);
        posix_spawn_file_actions_destroy(&quiet);
        for (int tries = 0; tries < 60'000 && folder.read("a.png") == "not yet"; ++tries)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        kill_and_check(child, generator, std::chrono::microseconds(20'000), folder, even, odd);
    }
}

}  // namespace limn::replace_file_test
