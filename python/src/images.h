// Conversion of images to arrays and back.
#pragma once

#include <algorithm>
#include <vector>

#include "arguments.h"
#include "limn/image/image.h"

namespace limn::python {

// Returns a copy of the argument `image`, an array of shape (height, width, 3). float64 and float32 are linear. uint8
// is decoded from sRGB. Throws a TypeError for another type, and a ValueError if a value is negative or not finite.
Image image_of(ArrayArgument argument);
// Returns an array of shape (height, width, 3) that owns the image and shares its pixels.
nb::object array_of(Image image);
// Returns a copy of a map as an array of shape (height, width), or None if the map is empty.
template <class T>
nb::object map_of(const std::vector<T>& map, int width, int height) {
    if (map.empty()) return nb::none();
    const NewArray<T> array = new_array<T>({static_cast<std::size_t>(height), static_cast<std::size_t>(width)});
    std::copy(map.begin(), map.end(), array.values);
    return array.array;
}

}  // namespace limn::python
