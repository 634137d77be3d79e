// Numbers of an object by their place, without branches.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace limn {

// The i-th of the numbers that an object consists of. Read from the object's bytes: no pointer to one member reaches
// the next one, and compilers make use of that.
template <class Number, class Object>
inline Number number_of(const Object& object, std::size_t i) {
    Number value;
    static_assert(std::is_trivially_copyable_v<Object> && sizeof(Object) % sizeof(Number) == 0);
    std::memcpy(&value, reinterpret_cast<const std::byte*>(&object) + i * sizeof(Number), sizeof(Number));
    return value;
}

}  // namespace limn
