// What becomes of the bytes of a picture, from a file and from memory.
#pragma once

#include <optional>
#include <string>

#include "catch.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "support/folder.h"

namespace limn::test {

// A file of the tests' data.
inline std::string stored_file(const std::string& name) {
    std::ifstream file(std::string(LIMN_TEST_DATA) + "/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

struct Verdict {
    std::optional<Image> image;
    std::string message;  // of the refusal
};

template <class Load>
Verdict verdict_of(Load load) {
    try {
        return {load(), ""};
    } catch (const FileError& error) {
        return {std::nullopt, error.what()};
    }
}

// Values as stored. The name of the file fits no content but an EXR's: the contents decide.
inline Verdict load_from_file(const std::string& bytes) {
    const Folder folder;
    const std::string path = folder.write("picture.exr", bytes);
    Verdict verdict = verdict_of([&] { return load_image(path, Encoding::raw); });
    if (!verdict.image) CHECK(verdict.message.starts_with(path + ": "));
    return verdict;
}
inline Verdict load_from_memory(const std::string& bytes) {
    Verdict verdict = verdict_of(
        [&] { return load_image_from_memory(std::as_bytes(std::span(bytes)), Encoding::raw, "the picture"); });
    if (!verdict.image) CHECK(verdict.message.starts_with("the picture: "));
    return verdict;
}

struct Loads {
    int width, height;
    Color first;  // pixel, as stored, within 2/255: JPEG loses as much
};

inline void check(const Verdict& verdict, const Loads& expected) {
    CAPTURE(verdict.message);
    REQUIRE(verdict.image);
    CHECK(verdict.image->width() == expected.width);
    CHECK(verdict.image->height() == expected.height);
    const Color color = verdict.image->at(0, 0);
    CHECK(color.r == Approx(expected.first.r).margin(2 / 255.0));
    CHECK(color.g == Approx(expected.first.g).margin(2 / 255.0));
    CHECK(color.b == Approx(expected.first.b).margin(2 / 255.0));
}

// `expected`: a part of the message.
inline void check(const Verdict& verdict, const std::string& expected) {
    CAPTURE(verdict.message, expected);
    CHECK_FALSE(verdict.image);
    CHECK(verdict.message.find(expected) != std::string::npos);
}

}  // namespace limn::test
