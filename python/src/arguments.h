// What functions are given. Arguments are taken as any object and checked by hand, so that an error names the argument.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "limn/core/color.h"
#include "limn/core/transform.h"
#include "limn/core/vec.h"

namespace limn::python {

namespace nb = nanobind;

// An argument of any type; the tag says what stands in signatures.
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

// The name of an argument in a signature. None too is taken, so that refusing it names the argument.
inline auto given(const char* name) { return nb::arg(name).none(); }

[[noreturn]] void wrong_type(const char* name, const std::string& expected, nb::handle got);  // a TypeError
[[noreturn]] void wrong_value(const char* name, const std::string& problem);                  // a ValueError

double number(NumberArgument argument, const char* name);
// In lowest to highest, both included.
long long whole(CountArgument argument, const char* name, long long lowest, long long highest);
bool flag(FlagArgument argument, const char* name);
int thread_count(CountArgument argument);  // 0 to 1024
// Which of the words it is.
std::size_t choice(NameArgument argument, const char* name, const std::vector<std::string>& words);

// So many objects in a sequence or an array.
std::vector<nb::object> items(nb::handle object, std::size_t count, const char* name, const char* expected);
// Three numbers.
Vec3 triple(nb::handle object, const char* name);
inline Vec3 vector(TripleArgument argument, const char* name) { return triple(argument.object, name); }
inline Point3 point(TripleArgument argument, const char* name) { return Point3{} + triple(argument.object, name); }
Color color(nb::handle object, const char* name);
// Rows of a matrix: 3 by 4, or 4 by 4 with the last one 0 0 0 1.
Transform matrix(MatrixArgument argument, const char* name);

// The object of a bound class.
template <class T>
std::shared_ptr<const T> shared(nb::handle object, const char* name, const char* expected) {
    std::shared_ptr<T> value;
    if (object.is_none() || !nb::try_cast(object, value)) wrong_type(name, expected, object);
    return value;
}

// A C-contiguous array in the CPU's memory: numpy's, or one that speaks DLPack or the buffer protocol. Not copied; it
// keeps the memory alive.
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
    bool is_whole_number() const;  // whether it holds integers
    std::vector<std::size_t> shape() const;

private:
    nb::ndarray<nb::ro> array_;
};

// "(5, 2)", for messages.
std::string shape_text(const std::vector<std::size_t>& shape);

// Rows of `width` numbers along the last axis of an array of float64 or float32, at least one of them.
class Rows {
public:
    Rows(ArrayArgument argument, const char* name, std::size_t width, const char* expected);

    std::size_t count() const { return count_; }
    const std::vector<std::size_t>& shape() const { return shape_; }  // without the last axis
    // visit(pointer to the first number), of double or of float.
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

// A new array of numpy, `values` points into it. \pre the interpreter's lock is held
template <class T>
struct NewArray {
    nb::object array;
    T* values = nullptr;
};

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
