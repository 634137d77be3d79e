// What cannot be saved is refused with the file's name, leaves nothing behind, and harms no picture that was there.
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>

#include "catch.h"
#include "formats.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "support/folder.h"

namespace limn::image_refusals_test {

using namespace test;

namespace {

// Sets the largest size of files of this process, which stands in for a full disk.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    rlimit before_{};
};

template <class Call>
std::string refusal(Call call) {
    try {
        call();
    } catch (const FileError& error) {
        return error.what();
    }
    return "accepted";
}

void check_mentions(const std::string& message, const std::string& part) {
    CAPTURE(message, part);
    CHECK(message.find(part) != std::string::npos);
}

// Runs `call` in a process without the rights of root; whether it returned true.
template <class Call>
bool true_without_rights(Call call) {
    const pid_t child = fork();
    if (child == 0) {
        const bool dropped = getuid() != 0 || (setgid(65534) == 0 && setuid(65534) == 0);
        _exit(dropped && call() ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

TEST_CASE("Saving: what can be known beforehand is refused by check_writable and save_image alike", "[io][image]") {
    const Folder folder;
    std::filesystem::create_directory(folder.path("folder.png"));
    folder.write("file", "");
    folder.make_pipe("pipe.png");
    std::filesystem::create_symlink("circle.png", folder.path("circle.png"));
    std::filesystem::create_symlink("none/b.png", folder.path("lost.png"));
    const Names before = folder.names();
    const std::pair<std::string, std::string> cases[] = {{folder.path("a.xyz"), "must end in"},
                                                         {folder.path("a.jpg"), ".png"},
                                                         {folder.path("a"), "must end in"},
                                                         {"", "must end in"},
                                                         {folder.path("none/a.png"), "no folder"},
                                                         {folder.path("folder.png"), "is a folder"},
                                                         {folder.path("file/a.png"), "is not a folder"},
                                                         {folder.path("pipe.png"), "not a regular file"},
                                                         {folder.path("circle.png"), "leads in a circle"},
                                                         {folder.path("lost.png"), "no folder"},
                                                         {"/proc/a.png", "cannot be written"}};
    for (const auto& refused : cases) {
        const std::string& path = refused.first;
        for (const std::string& message :
             {refusal([&] { check_writable(path); }), refusal([&] { save_image(Image(2, 2), path); })}) {
            CHECK(message.starts_with(path + ": "));
            check_mentions(message, refused.second);
        }
    }
    CHECK(folder.names() == before);
}

TEST_CASE("Saving: a folder or file without permission is refused", "[io][image]") {
    const Folder folder;
    std::filesystem::create_directory(folder.path("locked"));
    folder.write("open.png", "old");
    chmod(folder.path().c_str(), 0755);
    chmod(folder.path("locked").c_str(), 0555);
    chmod(folder.path("open.png").c_str(), 0444);
    const auto refused = [&folder](const std::string& name) {
        return refusal([&] { check_writable(folder.path(name)); }).find("ermission denied") != std::string::npos;
    };
    CHECK(true_without_rights([&] { return refused("locked/a.png"); }));
    CHECK(true_without_rights([&] { return refused("open.png"); }));
}

TEST_CASE("Saving: check_writable accepts what can be written and leaves it alone", "[io][image]") {
    const Folder folder;
    folder.write("old.png", "old");
    check_writable(folder.path("old.png"));
    check_writable(folder.path("new.png"));
    CHECK(folder.names() == Names{"old.png"});
    CHECK(folder.read("old.png") == "old");
}

TEST_CASE("Saving: values that the format cannot hold are refused with their pixel", "[io][image]") {
    const Folder folder;
    folder.write("a.png", "old");
    for (const float bad : {NAN, INFINITY, -INFINITY}) {
        Image image(4, 3);
        image.values()[3 * (4 * 2 + 1) + 2] = bad;
        check_mentions(refusal([&] { save_image(image, folder.path("a.png")); }), "(1, 2) is not finite");
    }
    check_mentions(refusal([&] { save_image(Image(), folder.path("a.png")); }), "no pixels");
#ifdef LIMN_WITH_OPENIMAGEIO
    for (const double large : {65504.01, -65520.0, 1e30})
        check_mentions(refusal([&] {
                           save_image(Image(1, 1, Color{0, large, 0}), folder.path("a.exr"), {.half = true});
                       }),
                       "too large for half");
#else
    check_mentions(refusal([&] { save_image(Image(1, 1, Color{0, 2e38, 0}), folder.path("a.hdr")); }), "too large");
    check_mentions(refusal([&] { save_image(Image(1, 1), folder.path("a.exr")); }), "OpenImageIO");
#endif
    CHECK(folder.names() == Names{"a.png"});
    CHECK(folder.read("a.png") == "old");
}

TEST_CASE("Saving: a fact without a usable name is refused", "[io][image]") {
    const Folder folder;
    for (const std::string& name :
         {std::string(), std::string("two words"), std::string("new\nline"), std::string(71, 'a')})
        CHECK_THROWS_AS(save_image(Image(1, 1), folder.path("a.png"), {.facts = {{name, "x"}}}), ArgumentError);
    CHECK_THROWS_AS(save_image(Image(1, 1), folder.path("a.png"), {.facts = {{"a", std::string(1, '\0')}}}),
                    ArgumentError);
    CHECK(folder.names().empty());
}

TEST_CASE("Saving: on a full disk the old picture stays, and nothing else", "[io][image]") {
    const Folder folder;
    const Image large = noise(300, 300, 1), tiny(4, 4);
    for (const std::string& suffix : written_suffixes()) {
        const std::string path = folder.path("a" + suffix);
        save_image(tiny, path);
        const std::string old = folder.read("a" + suffix);
        for (const rlim_t limit : std::initializer_list<rlim_t>{0, 1, 4096, 100'000}) {
            std::string message;
            {
                const FileSizeLimit full(limit);
                message = refusal([&] { save_image(limit < 4096 ? tiny : large, path); });
            }
            CAPTURE(suffix, limit);
            CHECK(message.starts_with(path + ": writing failed"));
            CHECK(folder.names() == Names{"a" + suffix});
            CHECK(folder.read("a" + suffix) == old);
        }
        save_image(large, path);  // the limit has left no trace
        CHECK(load_image(path).width() == 300);
        std::filesystem::remove(path);
    }
}

TEST_CASE("Saving: a disk without a free byte is refused beforehand", "[io][image]") {
    const Folder folder;
    std::string message;
    {
        const FileSizeLimit full(0);
        message = refusal([&] { check_writable(folder.path("a.png")); });
    }
    CHECK(message.starts_with(folder.path("a.png") + ": writing failed"));
    CHECK(folder.names().empty());
}

TEST_CASE("Saving: a picture that is replaced keeps its permissions, and a link still leads to it", "[io][image]") {
    const Folder folder;
    save_image(Image(1, 1), folder.path("a.png"));
    chmod(folder.path("a.png").c_str(), 0640);
    std::filesystem::create_symlink("a.png", folder.path("link.png"));
    save_image(Image(2, 2), folder.path("link.png"));
    CHECK(std::filesystem::is_symlink(folder.path("link.png")));
    CHECK(load_image(folder.path("a.png")).width() == 2);
    CHECK((std::filesystem::status(folder.path("a.png")).permissions() & std::filesystem::perms::all) ==
          std::filesystem::perms(0640));
}

TEST_CASE("Saving: a link that leads to no file yet is written through", "[io][image]") {
    const Folder folder;
    std::filesystem::create_directory(folder.path("far"));
    std::filesystem::create_symlink("far/b.png", folder.path("near.png"));
    std::filesystem::create_symlink(folder.path("near.png"), folder.path("chain.png"));
    check_writable(folder.path("chain.png"));
    CHECK_FALSE(std::filesystem::exists(folder.path("far/b.png")));
    save_image(Image(2, 2), folder.path("chain.png"));
    CHECK(std::filesystem::is_symlink(folder.path("near.png")));
    CHECK(std::filesystem::is_symlink(folder.path("chain.png")));
    CHECK(std::filesystem::is_regular_file(std::filesystem::symlink_status(folder.path("far/b.png"))));
    CHECK(load_image(folder.path("chain.png")).width() == 2);
    CHECK(folder.names() == Names{"chain.png", "far", "near.png"});
}

TEST_CASE("Saving: a file of somebody else stays theirs where the system allows it", "[io][image]") {
    if (getuid() != 0) {
        WARN("only root may give files away");
        return;
    }
    const Folder folder;
    const std::string path = folder.write("a.png", "old");
    REQUIRE(chown(path.c_str(), 12345, 54321) == 0);
    chmod(path.c_str(), 0640);
    save_image(Image(2, 2), path);
    struct stat now {};
    REQUIRE(stat(path.c_str(), &now) == 0);
    CHECK(now.st_uid == 12345);
    CHECK(now.st_gid == 54321);
    CHECK((now.st_mode & 07777) == 0640);
}

TEST_CASE("Loading: a file that is missing or a folder is refused with its name", "[io][image]") {
    const Folder folder;
    const std::string missing = folder.path("none.png");
    CHECK(refusal([&] { load_image(missing); }) == missing + ": there is no such file");
    CHECK(refusal([&] { load_image_facts(missing); }) == missing + ": there is no such file");
    CHECK(refusal([&] { load_image(folder.path()); }) == folder.path() + ": is a folder, not a file");
    for (const std::string& endless : {folder.make_pipe("pipe.png"), std::string("/dev/zero")}) {
        CHECK(refusal([&] { load_image(endless); }) == endless + ": is not a regular file");
        CHECK(refusal([&] { load_image_facts(endless); }) == endless + ": is not a regular file");
    }
}

TEST_CASE("Loading: a picture that breaks off is refused in every format", "[io][image]") {
    const Folder folder;
    for (const std::string& suffix : written_suffixes()) {
        save_image(noise(64, 64, 3), folder.path("a" + suffix));
        const std::string whole = folder.read("a" + suffix);
        for (const double part : {0.05, 0.3, 0.6, 0.9, 0.99}) {
            CAPTURE(suffix, part);
            const auto size = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
            CHECK_THROWS_AS(load_image(folder.write("b" + suffix, whole.substr(0, size))), FileError);
        }
    }
}

}  // namespace limn::image_refusals_test
