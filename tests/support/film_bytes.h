// The bytes of film files, for tests that change them.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "math/system/checksum.h"

namespace limn::test {

/// Where the first chunk, the header, begins: behind "limnfilm" and two versions.
inline constexpr std::size_t kFirstChunk = 16;

/// The same file, each chunk of it that is whole with the checksum that it should have; lengths are believed.
inline std::string with_chunk_sums(std::string bytes) {
    for (std::size_t at = kFirstChunk; at + 16 < bytes.size();) {
        std::uint64_t length = 0;
        std::memcpy(&length, &bytes[at], 8);
        if (length > bytes.size() - at - 16) break;
        const std::uint64_t sum = checksum(std::as_bytes(std::span(bytes)).subspan(at + 8, length));
        std::memcpy(&bytes[at + 8 + length], &sum, 8);
        at += 16 + length;
    }
    return bytes;
}

}  // namespace limn::test
