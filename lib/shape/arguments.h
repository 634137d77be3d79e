// Checks that several shapes share.
#pragma once

#include <string>
#include <string_view>

#include "limn/core/error.h"
#include "limn/core/transform.h"
#include "limn/core/vec.h"

namespace limn {

template <class T>
void require_finite(const T& value, std::string_view shape, const char* argument) {
    if (!is_finite(value)) throw ArgumentError(std::string(shape) + ": " + argument + " must be finite");
}

template <class T>
void require_not_null(const T& pointer, const char* shape, const char* argument) {
    if (!pointer) throw ArgumentError(std::string(shape) + ": " + argument + " must not be null");
}

// Where an Instance may stand.
void require_placement(const Transform& at_time0, const Transform& at_time1, std::string_view who);

}  // namespace limn
