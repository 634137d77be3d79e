// What a file is by its contents, whatever its name.
#pragma once

#include <optional>
#include <string_view>

#include "io/image_codec.h"

namespace limn {

struct FileKind {
    std::string_view name{};             // "a PNG picture", "UTF-16 text", "a PLY model" and the like; empty if unknown
    std::optional<FileFormat> format{};  // of a picture that limn reads
    bool may_be_text = false;            // the mark is so short that a text may begin with it
};

FileKind kind_of_contents(std::string_view contents);

}  // namespace limn
