#pragma once

#include <functional>
#include <string_view>

namespace limn {

// A hash of the bytes of a key. The key must have no padding, and equal keys must have equal bytes: it may not contain
// -0.
struct BytesHash {
    template <class Key>
    std::size_t operator()(const Key& key) const {
        return std::hash<std::string_view>{}({reinterpret_cast<const char*>(&key), sizeof key});
    }
};

}  // namespace limn
