// Checks of arguments, used by several shapes. Each throws ArgumentError if its argument is invalid.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "limn/math/error.h"
#include "limn/math/transform.h"
#include "limn/math/vec.h"

namespace limn {

template <class T>
void require_finite(const T& value, std::string_view shape, const char* argument) {
    if (!is_finite(value)) throw ArgumentError(std::string(shape) + ": " + argument + " must be finite");
}

template <class T>
void require_not_null(const T& pointer, const char* shape, const char* argument) {
    if (!pointer) throw ArgumentError(std::string(shape) + ": " + argument + " must not be null");
}

// Checks the length of an array of MeshData. Throws unless the array is empty or has `expected` entries, one for each
// vertex or each triangle.
inline void require_length(std::size_t length, std::size_t expected, std::string_view who, const char* array) {
    if (length != 0 && length != expected)
        throw ArgumentError(std::string(who) + ": " + array + " has " + std::to_string(length) +
                            " entries instead of " + std::to_string(expected));
}

// Checks the matrices of an Instance. They must be finite, and invertible at every time of the shutter.
void require_placement(const Transform& at_time0, const Transform& at_time1, std::string_view who);

}  // namespace limn
