// A coordinate by its axis, without branches.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace limn {

// v.x, v.y or v.z for axis 0, 1 or 2. Read from the object's bytes: no pointer to one member reaches the next one, and
// compilers make use of that.
template <class V>
inline auto coordinate(const V& v, std::size_t axis) {
    auto value = v.x;
    static_assert(std::is_trivially_copyable_v<V> && sizeof(V) == 3 * sizeof(value));
    std::memcpy(&value, reinterpret_cast<const std::byte*>(&v) + axis * sizeof(value), sizeof(value));
    return value;
}

}  // namespace limn
