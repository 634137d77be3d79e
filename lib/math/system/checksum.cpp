#include "math/system/checksum.h"

#include <bit>

#define XXH_INLINE_ALL  // compiles xxHash into this file: programs that link limn don't need its library
#ifndef NDEBUG
// xxHash forces the inlining of functions that it calls through pointers. g++ -Og can't do that and reports an error.
#define XXH_NO_INLINE_HINTS 1
#endif
#include <xxhash.h>

namespace limn {

static_assert(std::endian::native == std::endian::little, "numbers are added as they lie in memory");

struct Checksum::State : XXH3_state_t {};

Checksum::Checksum() : state_(std::make_unique<State>()) { XXH3_128bits_reset(state_.get()); }
Checksum::~Checksum() = default;

void Checksum::add(std::span<const std::byte> bytes) { XXH3_128bits_update(state_.get(), bytes.data(), bytes.size()); }

void Checksum::add(std::string_view text) {
    add(std::uint64_t{text.size()});
    add(std::as_bytes(std::span(text)));
}

Hash128 Checksum::digest() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
    return {hash.low64, hash.high64};
}

std::uint64_t checksum(std::span<const std::byte> bytes) { return XXH3_128bits(bytes.data(), bytes.size()).low64; }

}  // namespace limn
