#pragma once

#include <functional>
#include <string_view>

namespace limn {

// Of keys without gaps, in which equal numbers have equal bytes: no -0.
struct BytesHash {
    template <class Key>
    std::size_t operator()(const Key& key) const {
        return std::hash<std::string_view>{}({reinterpret_cast<const char*>(&key), sizeof key});
    }
};

}  // namespace limn
