// Pictures that break off or are damaged at random: each is refused with its name, or is a picture.
#include <algorithm>
#include <cstdlib>
#include <random>

#include "formats.h"
#include "judge_image.h"
#include "make_png.h"

namespace limn::image_damage_test {

using namespace test;

namespace {

std::string written(const std::string& suffix) {
    const Folder folder;
    save_image(noise(9, 7, 1), folder.path("a" + suffix));
    return folder.read("a" + suffix);
}

void check_sane(const Verdict& verdict) {
    if (verdict.image) CHECK(verdict.image->values().size() > 0);
}

int flips() { return std::getenv("LIMN_FULL") ? 500 : 30; }

}  // namespace

TEST_CASE("Damaged images: wherever a file breaks off, it is refused", "[io][image]") {
    std::vector<std::string> wholes = {stored_file("orange.jpg"), stored_file("images/progressive.jpg")};
    for (const std::string& suffix : written_suffixes()) wholes.push_back(written(suffix));
    for (const std::string& whole : wholes)
        for (std::size_t size = 0; size < whole.size() - 12; size += 1 + whole.size() / 50) {
            CAPTURE(whole.substr(0, 4), whole.size(), size);
            CHECK_FALSE(load_from_file(whole.substr(0, size)).image);
            CHECK_FALSE(load_from_memory(whole.substr(0, size)).image);
        }
}

TEST_CASE("Damaged images: a PNG with any byte changed is refused", "[io][image]") {
    const std::string whole = written(".png");
    std::mt19937 generator(21);
    for (int i = 0; i < flips(); ++i) {
        std::string bytes = whole;
        const std::size_t place = generator() % whole.size();
        bytes[place] = static_cast<char>(static_cast<unsigned char>(bytes[place]) ^ (1 + generator() % 255));
        CAPTURE(place);
        CHECK_FALSE(load_from_file(bytes).image);
        CHECK_FALSE(load_from_memory(bytes).image);
    }
}

TEST_CASE("Damaged images: whatever bytes are changed in a file, it is refused or a picture", "[io][image]") {
    std::vector<std::string> wholes = {
        stored_file("orange.jpg"), stored_file("images/progressive.jpg"), stored_file("images/cmyk.jpg"),
        stored_file("images/tiled.exr"),
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n\x80\x40\xc0\x80" + std::string(12, '\x80')};
    for (const std::string& suffix : written_suffixes()) wholes.push_back(written(suffix));
    std::mt19937 generator(22);
    for (const std::string& whole : wholes)
        for (int i = 0; i < flips(); ++i) {
            std::string bytes = whole;
            for (std::uint_fast32_t count = 1 + generator() % 3; count > 0; --count)
                bytes[generator() % bytes.size()] = static_cast<char>(generator());
            const bool is_png = whole[0] == '\x89';
            if (is_png) bytes = with_checksums(bytes);
            CAPTURE(whole.substr(0, 4), i);
            check_sane(load_from_file(bytes));
            check_sane(load_from_memory(bytes));
        }
}

}  // namespace limn::image_damage_test
