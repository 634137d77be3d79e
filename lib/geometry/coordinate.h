// Access to the numbers of an object by index, without branches.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace limn {

// Returns the i-th of the numbers that an object consists of. It is read from the bytes of the object, because C++ does
// not allow reading one member by a pointer to another.
template <class Number, class Object>
inline Number number_of(const Object& object, std::size_t i) {
    Number value;
    static_assert(std::is_trivially_copyable_v<Object> && sizeof(Object) % sizeof(Number) == 0);
    std::memcpy(&value, reinterpret_cast<const std::byte*>(&object) + i * sizeof(Number), sizeof(Number));
    return value;
}

}  // namespace limn
