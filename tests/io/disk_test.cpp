// What a picture owes to the disk. This program's own versions of some functions count their calls, and can do harm.
#include "math/system/replace_file.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cstdio>

#include "catch.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "support/folder.h"

namespace limn::disk_test {

using namespace test;

namespace {

std::string calls;         // F for a flush, R for a rename
bool disk_is_bad = false;  // stores another first byte than it is given

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

}  // namespace

extern "C" int fsync(int file) {
    calls += 'F';
    return static_cast<int>(syscall(SYS_fsync, file));
}

extern "C" int rename(const char* from, const char* to) noexcept {
    calls += 'R';
    return renameat(AT_FDCWD, from, AT_FDCWD, to);
}

extern "C" ssize_t write(int file, const void* data, std::size_t size) {
    std::string bytes(static_cast<const char*>(data), size);
    if (disk_is_bad && !bytes.empty()) bytes[0] ^= 1;
    const iovec all{bytes.data(), bytes.size()};
    return writev(file, &all, 1);
}

#ifdef LIMN_WITH_OPENIMAGEIO
namespace {
bool encoder_is_bad = false;  // likewise
}

// The function of libpng by which OpenImageIO writes.
extern "C" void png_write_row(void* png, unsigned char* row) {
    static const auto real = reinterpret_cast<decltype(&png_write_row)>(dlsym(RTLD_NEXT, "png_write_row"));
    row[0] ^= encoder_is_bad ? 1 : 0;
    real(png, row);
    row[0] ^= encoder_is_bad ? 1 : 0;
}

TEST_CASE("Saving: an encoder that stores other values than it is given is found out", "[io][image]") {
    const Folder folder;
    const Image image(3, 2, {0.1, 0.5, 0.9});
    encoder_is_bad = true;
    CHECK_THROWS_AS(save_image(image, folder.path("a.png")), FileError);
    encoder_is_bad = false;
    CHECK(folder.names().empty());
    CHECK_NOTHROW(save_image(image, folder.path("a.png")));
}
#endif

TEST_CASE("Saving: the file is on the disk before it takes its name, and then the name is", "[io][image]") {
    const Folder folder;
    calls.clear();
    replace_file(folder.path("a.png"), bytes_of("picture"));
    CHECK(calls == "FRF");
    CHECK(folder.read("a.png") == "picture");
}

TEST_CASE("Saving: a disk that stores other bytes than it is given is found out, and the old file stays",
          "[io][image]") {
    const Folder folder;
    const std::string path = folder.write("a.png", "old picture");
    disk_is_bad = true;
    CHECK_THROWS_AS(replace_file(path, bytes_of("new picture")), FileError);
    disk_is_bad = false;
    CHECK(folder.read("a.png") == "old picture");
    CHECK(folder.names() == Names{"a.png"});
}

}  // namespace limn::disk_test
