#include "limn/math/system/file_lock.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>

#include "catch.h"
#include "limn/math/error.h"
#include "support/folder.h"

namespace limn::file_lock_test {

using namespace test;

TEST_CASE("File locks: one has it at a time, by whatever name, and it ends with the object", "[core][file-lock]") {
    const Folder folder;
    const std::string path = folder.path("a.film");
    std::filesystem::create_symlink("a.film", folder.path("link"));
    {
        const FileLock lock(path);
        CHECK_THROWS_WITH(FileLock(path), Catch::Contains("a.film: is being written by another process"));
        CHECK_THROWS_AS(FileLock(folder.path("link")), FileError);
        const FileLock other(folder.path("b.film"));
    }
    CHECK(folder.names() == Names{"link"});
    const FileLock again(path);
    CHECK_THROWS_WITH(FileLock(folder.path("none/a")), Catch::Contains("cannot be locked"));
}

TEST_CASE("File locks: it dies with its process", "[core][file-lock]") {
    const Folder folder;
    const std::string path = folder.path("a.film");
    int ready[2];
    REQUIRE(pipe(ready) == 0);
    const pid_t child = fork();
    if (child == 0) {
        const FileLock lock(path);
        [[maybe_unused]] const ssize_t told = write(ready[1], "x", 1);
        pause();
        _exit(0);
    }
    char byte = 0;
    REQUIRE(read(ready[0], &byte, 1) == 1);
    CHECK_THROWS_AS(FileLock(path), FileError);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    CHECK(folder.names() == Names{"a.film.lock"});
    { const FileLock lock(path); }
    CHECK(folder.names().empty());
}

}  // namespace limn::file_lock_test
