#include "images.h"

#include <cmath>
#include <cstdint>
#include <memory>

#include "bindings.h"
#include "limn/math/color.h"

namespace limn::python {

namespace {

constexpr std::size_t kMostPixels = 1 << 20;  // largest width and height of an image

nb::object to_srgb(ArrayArgument argument) {
    const ArrayView image(argument.object, "image", "an array of float32");
    if (!image.holds<float>()) throw nb::type_error("image: must be of float32");
    const NewArray<std::uint8_t> bytes = new_array<std::uint8_t>(image.shape());
    const float* values = image.data<float>();
    for (std::size_t i = 0; i < image.size(); ++i) {
        const double shown = values[i] > 0 ? std::min(1.0, static_cast<double>(values[i])) : 0;  // NaN is black
        bytes.values[i] = static_cast<std::uint8_t>(std::lround(255 * srgb_encode(shown)));
    }
    return bytes.array;
}

}  // namespace

Image image_of(ArrayArgument argument) {
    const ArrayView array(argument.object, "image", "an array of pixels, shape (height, width, 3)");
    if (array.rank() != 3 || array.length(2) != 3 || array.size() == 0)
        wrong_value("image", "must have shape (height, width, 3), not " + shape_text(array.shape()));
    if (array.length(0) > kMostPixels || array.length(1) > kMostPixels) wrong_value("image", "is too large");
    Image image(static_cast<int>(array.length(1)), static_cast<int>(array.length(0)));
    const auto put = [&](const auto* from, const auto& convert) {
        for (float& value : image.values()) value = convert(*from++);
    };
    if (array.holds<float>()) {
        put(array.data<float>(), [](float v) { return v; });
    } else if (array.holds<double>()) {
        put(array.data<double>(), [](double v) { return static_cast<float>(v); });
    } else if (array.holds<std::uint8_t>()) {
        put(array.data<std::uint8_t>(), [](std::uint8_t v) { return static_cast<float>(srgb_decode(v / 255.0)); });
    } else {
        throw nb::type_error("image: must be of float64, float32 or uint8");
    }
    for (const float value : image.values())
        if (!(std::isfinite(value) && value >= 0)) wrong_value("image", "has a value that is negative or not finite");
    return image;
}

nb::object array_of(Image image) {
    auto owned = std::make_unique<Image>(std::move(image));
    float* values = owned->values().data();
    const std::size_t height = static_cast<std::size_t>(owned->height());
    const std::size_t width = static_cast<std::size_t>(owned->width());
    const nb::capsule owner(owned.release(), [](void* p) noexcept { delete static_cast<Image*>(p); });
    return nb::cast(nb::ndarray<nb::numpy, float>(values, {height, width, std::size_t{3}}, owner));
}

void bind_images(nb::module_& module) {
    module.def("to_srgb", &to_srgb, given("image"),
               nb::sig("def to_srgb(image: numpy.typing.NDArray) -> numpy.typing.NDArray"),
               R"(Encodes linear values by sRGB, as in PNG files.

Args:
    image: float32, any shape. Values are clamped to [0, 1]. NaN becomes 0.

Returns:
    An array of the same shape, uint8.)");
}

}  // namespace limn::python
