#include "math/system/checksum.h"

#include "property.h"

namespace limn::checksum_test {

namespace {

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

Hash128 digest_of(std::string_view text) {
    Checksum sum;
    sum.add(bytes_of(text));
    return sum.digest();
}

}  // namespace

TEST_CASE("Checksums: those of XXH3, as its own tools give them", "[core][checksum]") {
    // xxhsum -H2, of xxHash 0.8.1: the high half first.
    CHECK(digest_of("") == Hash128{0x6001c324468d497f, 0x99aa06d3014798d8});
    CHECK(checksum(bytes_of("")) == 0x6001c324468d497f);
}

TEST_CASE("Checksums: how bytes are cut into pieces does not matter, each of them does", "[core][checksum]") {
    test::holds([](std::string text, std::uint16_t cut, std::uint16_t place) {
        text += "some more than nothing";
        const std::size_t middle = cut % text.size(), changed = place % text.size();
        Checksum pieces;
        pieces.add(bytes_of(std::string_view(text).substr(0, middle)));
        pieces.add(bytes_of(std::string_view(text).substr(middle)));
        RC_ASSERT(pieces.digest() == digest_of(text));
        RC_ASSERT(pieces.value() == checksum(bytes_of(text)));
        text[changed] = static_cast<char>(text[changed] ^ 1);
        RC_ASSERT(pieces.digest() != digest_of(text));
        RC_ASSERT(pieces.value() != checksum(bytes_of(text)));
    });
}

TEST_CASE("Checksums: texts are told apart by where they end, numbers by their bits", "[core][checksum]") {
    const auto of_two = [](std::string_view a, std::string_view b) {
        Checksum sum;
        sum.add(a), sum.add(b);
        return sum.digest();
    };
    CHECK(of_two("ab", "c") != of_two("a", "bc"));
    CHECK(of_two("ab", "c") == of_two("ab", "c"));
    const auto of_number = [](auto number) {
        Checksum sum;
        sum.add(number);
        return sum.digest();
    };
    CHECK(of_number(0.0) != of_number(-0.0));
    CHECK(of_number(1) != of_number(std::int64_t{1}));
}

}  // namespace limn::checksum_test
