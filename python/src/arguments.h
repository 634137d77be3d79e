// Conversion of Python arguments to C++ values. nanobind accepts any object as an argument. The functions here check
// it, so that the message of an error begins with the name of the argument.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "limn/math/color.h"
#include "limn/math/transform.h"
#include "limn/math/vec.h"

namespace limn::python {

namespace nb = nanobind;

// An argument of any type. Tag::kName is the type that the Python signature shows. The handle is not owned.
template <class Tag>
struct Argument {
    nb::handle object;
};

#define LIMN_ARGUMENT(Name, text)                                   \
    struct Name##Tag {                                              \
        static constexpr auto kName = nb::detail::const_name(text); \
    };                                                              \
    using Name = Argument<Name##Tag>

LIMN_ARGUMENT(ArrayArgument, "numpy.typing.NDArray");
LIMN_ARGUMENT(NumberArgument, "float");
LIMN_ARGUMENT(CountArgument, "int");
LIMN_ARGUMENT(FlagArgument, "bool");
LIMN_ARGUMENT(NameArgument, "str");
LIMN_ARGUMENT(TripleArgument, "collections.abc.Sequence[float] | numpy.typing.NDArray");
LIMN_ARGUMENT(MatrixArgument, "numpy.typing.ArrayLike");
LIMN_ARGUMENT(ColorArgument, "Texture | collections.abc.Sequence[float] | numpy.typing.NDArray");
LIMN_ARGUMENT(TextureArgument, "Texture");
LIMN_ARGUMENT(OpacityArgument, "Texture | float");
LIMN_ARGUMENT(RoughnessArgument, "float | collections.abc.Sequence[float]");
LIMN_ARGUMENT(WindowArgument, "collections.abc.Sequence[int] | None");
LIMN_ARGUMENT(SurfaceArgument, "Material");
LIMN_ARGUMENT(MaterialArgument, "Material | None");
LIMN_ARGUMENT(MaterialsArgument, "Material | collections.abc.Sequence[Material] | None");
LIMN_ARGUMENT(BackgroundArgument, "Background");
LIMN_ARGUMENT(EnvironmentArgument, "EnvironmentMap | None");
LIMN_ARGUMENT(ShapeArgument, "Hittable");
LIMN_ARGUMENT(CallbackArgument, "collections.abc.Callable[[Progress], bool | None] | None");
#undef LIMN_ARGUMENT

// Returns the annotation of an argument that accepts None. The function's own check then rejects None with an error
// that names the argument.
inline auto given(const char* name) { return nb::arg(name).none(); }

// Throws a TypeError: "NAME: must be EXPECTED, not THE TYPE OF got".
[[noreturn]] void wrong_type(const char* name, const std::string& expected, nb::handle got);
// Throws a ValueError: "NAME: PROBLEM".
[[noreturn]] void wrong_value(const char* name, const std::string& problem);

// The functions below return the value of an argument. They throw a TypeError if its type is wrong and a ValueError if
// its value is out of range.
double number(NumberArgument argument, const char* name);
// Returns an integer from lowest to highest, both included.
long long whole(CountArgument argument, const char* name, long long lowest, long long highest);
bool flag(FlagArgument argument, const char* name);
// Returns a number of threads, 0 to 1024, of the argument `threads`.
int thread_count(CountArgument argument);
// Returns the index of the argument in `words`.
std::size_t choice(NameArgument argument, const char* name, const std::vector<std::string>& words);

// Returns the `count` elements of a sequence or an array.
std::vector<nb::object> items(nb::handle object, std::size_t count, const char* name, const char* expected);
// Returns the three numbers of a sequence or an array.
Vec3 triple(nb::handle object, const char* name);
inline Vec3 vector(TripleArgument argument, const char* name) { return triple(argument.object, name); }
inline Point3 point(TripleArgument argument, const char* name) { return Point3{} + triple(argument.object, name); }
Color color(nb::handle object, const char* name);
// Returns the transform of a 3x4 matrix, or of a 4x4 matrix whose last row is 0 0 0 1.
Transform matrix(MatrixArgument argument, const char* name);

// Returns the C++ object of a bound class.
template <class T>
std::shared_ptr<const T> shared(nb::handle object, const char* name, const char* expected) {
    std::shared_ptr<T> value;
    if (object.is_none() || !nb::try_cast(object, value)) wrong_type(name, expected, object);
    return value;
}

// A C-contiguous array in the CPU's memory, of numpy or of another library with DLPack or the buffer protocol. The view
// doesn't copy the array. It keeps the memory alive.
class ArrayView {
public:
    ArrayView(nb::handle object, const char* name, const char* expected);

    std::size_t rank() const { return array_.ndim(); }
    std::size_t length(std::size_t axis) const { return array_.shape(axis); }
    std::size_t size() const { return array_.size(); }
    template <class T>
    bool holds() const {
        return array_.dtype() == nb::dtype<T>();
    }
    template <class T>
    const T* data() const {
        return static_cast<const T*>(array_.data());
    }
    bool is_whole_number() const;  // true if the elements are integers
    std::vector<std::size_t> shape() const;

private:
    nb::ndarray<nb::ro> array_;
};

// Returns a shape as Python prints it, such as "(5, 2)".
std::string shape_text(const std::vector<std::size_t>& shape);

// An array of float64 or float32, not empty, whose last axis has `width` numbers. Each run of these numbers is a row.
class Rows {
public:
    Rows(ArrayArgument argument, const char* name, std::size_t width, const char* expected);

    std::size_t count() const { return count_; }
    const std::vector<std::size_t>& shape() const { return shape_; }  // without the last axis
    // Calls visit with a pointer to the first number, a const double* or a const float*.
    template <class Visit>
    void visit(const Visit& visit) const {
        if (array_.holds<double>()) return visit(array_.data<double>());
        visit(array_.data<float>());
    }

private:
    ArrayView array_;
    std::vector<std::size_t> shape_;
    std::size_t count_ = 1;
};

// A new numpy array. `values` points to its first element.
template <class T>
struct NewArray {
    nb::object array;
    T* values = nullptr;
};

// Returns a new array that isn't initialised, and sets `values` to its first element. An array of kLeastKept bytes or
// more is stored in KeptMemory. \pre the GIL is held
nb::object new_array(const std::vector<std::size_t>& shape, const char* type, void*& values);
template <class T>
constexpr const char* type_name() {
    if constexpr (std::is_same_v<T, double>) return "float64";
    if constexpr (std::is_same_v<T, float>) return "float32";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "uint32";
    if constexpr (std::is_same_v<T, std::int64_t>) return "int64";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "uint8";
    if constexpr (std::is_same_v<T, bool>) return "bool";
}
// Returns a new array with elements of type T that isn't initialised. If `columns` isn't 0, an axis of that length is
// added to the shape. \pre the GIL is held
template <class T>
NewArray<T> new_array(std::vector<std::size_t> shape, std::size_t columns = 0) {
    if (columns > 0) shape.push_back(columns);
    void* values = nullptr;
    nb::object array = new_array(shape, type_name<T>(), values);
    return {std::move(array), static_cast<T*>(values)};
}

}  // namespace limn::python

namespace nanobind::detail {

template <class Tag>
struct type_caster<limn::python::Argument<Tag>> {
    NB_TYPE_CASTER(limn::python::Argument<Tag>, Tag::kName)

    bool from_python(handle object, std::uint32_t, cleanup_list*) noexcept {
        value.object = object;
        return true;
    }
};

}  // namespace nanobind::detail
