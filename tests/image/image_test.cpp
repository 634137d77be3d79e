#include "limn/image/image.h"

#include <cstdint>
#include <limits>
#include <string>

#include "catch.h"
#include "limn/math/error.h"
#include "property.h"

namespace limn::image_test {

TEST_CASE("Image: every value of a new image is the fill, rounded to float32", "[image]") {
    const Image image(3, 2, Color{0.1, 0.2, 0.3});
    REQUIRE(image.values().size() == 18);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            CHECK(image.at(x, y).r == 0.1f);
            CHECK(image.at(x, y).g == 0.2f);
            CHECK(image.at(x, y).b == 0.3f);
        }
}

TEST_CASE("Image: a pixel lies at row y from the top, column x from the left", "[image]") {
    Image image(3, 2);
    image.set(2, 1, Color{1, 2, 3});
    CHECK(image.values()[15] == 1);
    CHECK(image.values()[16] == 2);
    CHECK(image.values()[17] == 3);
    CHECK(image.at(2, 1) == Color{1, 2, 3});
    CHECK(image.at(1, 1) == Color{});
}

TEST_CASE("Image: a side that is not positive is refused with its size", "[image]") {
    const int width = GENERATE(0, -1, 5, std::numeric_limits<int>::min());
    const int height = width == 5 ? 0 : 5;
    try {
        Image(width, height);
        FAIL("accepted");
    } catch (const ArgumentError& error) {
        CHECK(std::string(error.what()).find(std::to_string(width) + " x " + std::to_string(height)) !=
              std::string::npos);
    }
}

TEST_CASE("Image: setting a pixel changes that pixel alone", "[image]") {
    test::holds([](std::uint8_t w, std::uint8_t h, std::uint8_t i, std::uint8_t j) {
        const int width = w % 9 + 1, height = h % 9 + 1, x = i % width, y = j % height;
        Image image(width, height, Color{1, 2, 3});
        image.set(x, y, Color{4, 5, 6});
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column)
                RC_ASSERT(image.at(column, row) == (column == x && row == y ? Color{4, 5, 6} : Color{1, 2, 3}));
        Image other(width, height, Color{1, 2, 3});
        RC_ASSERT(!(other == image));
        other.set(x, y, Color{4, 5, 6});
        RC_ASSERT(other == image);
        RC_ASSERT(!(Image(width, height + 1) == Image(width, height)));
    });
}

// Under AddressSanitizer an allocation of this size ends the program, unless told otherwise.
#ifndef __SANITIZE_ADDRESS__
TEST_CASE("Image: a size beyond all memory is refused with its size, not wrapped around", "[image]") {
    const int side = std::numeric_limits<int>::max();
    try {
        Image(side, side);
        FAIL("accepted");
    } catch (const ArgumentError& error) {
        CHECK(std::string(error.what()).find("2147483647 x 2147483647") != std::string::npos);
    }
}
#endif

}  // namespace limn::image_test
