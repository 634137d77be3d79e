// Pictures as arrays, both ways.
#pragma once

#include <algorithm>
#include <vector>

#include "arguments.h"
#include "limn/image/image.h"

namespace limn::python {

// Of an array of shape (height, width, 3): linear float64 or float32 as it is; bytes are sRGB, as those of pictures.
Image image_of(ArrayArgument argument);
// Shape (height, width, 3). The pixels are the array's: the image lives as long as it does.
nb::object array_of(Image image);
// A copy, of shape (height, width); None of an empty map.
template <class T>
nb::object map_of(const std::vector<T>& map, int width, int height) {
    if (map.empty()) return nb::none();
    const NewArray<T> array = new_array<T>({static_cast<std::size_t>(height), static_cast<std::size_t>(width)});
    std::copy(map.begin(), map.end(), array.values);
    return array.array;
}

}  // namespace limn::python
