#include "arguments.h"

#include <nanobind/stl/string.h>

#include <cstdint>

#include "kept_memory.h"

namespace limn::python {

namespace {

std::string type_of(nb::handle object) { return nb::cast<std::string>(object.type().attr("__name__")); }

}  // namespace

void wrong_type(const char* name, const std::string& expected, nb::handle got) {
    throw nb::type_error((std::string(name) + ": must be " + expected + ", not " + type_of(got)).c_str());
}

void wrong_value(const char* name, const std::string& problem) {
    throw nb::value_error((std::string(name) + ": " + problem).c_str());
}

double number(NumberArgument argument, const char* name) {
    const double value = PyFloat_AsDouble(argument.object.ptr());
    if (value == -1.0 && PyErr_Occurred()) {
        PyErr_Clear();
        wrong_type(name, "a number", argument.object);
    }
    return value;
}

long long whole(CountArgument argument, const char* name, long long lowest, long long highest) {
    PyObject* index = PyNumber_Index(argument.object.ptr());
    if (!index) {
        PyErr_Clear();
        wrong_type(name, "a whole number", argument.object);
    }
    int overflow = 0;
    const long long value = PyLong_AsLongLongAndOverflow(index, &overflow);
    Py_DECREF(index);
    if (overflow != 0 || value < lowest || value > highest)
        wrong_value(name, "must be in " + std::to_string(lowest) + " to " + std::to_string(highest));
    return value;
}

bool flag(FlagArgument argument, const char* name) {
    if (!PyBool_Check(argument.object.ptr())) wrong_type(name, "True or False", argument.object);
    return argument.object.ptr() == Py_True;
}

int thread_count(CountArgument argument) { return static_cast<int>(whole(argument, "threads", 0, 1024)); }

std::size_t choice(NameArgument argument, const char* name, const std::vector<std::string>& words) {
    std::string all, word;
    for (const std::string& w : words) all += (all.empty() ? "'" : ", '") + w + "'";
    if (!nb::isinstance<nb::str>(argument.object)) wrong_type(name, "one of " + all, argument.object);
    word = nb::cast<std::string>(nb::borrow<nb::str>(argument.object));
    for (std::size_t i = 0; i < words.size(); ++i)
        if (words[i] == word) return i;
    wrong_value(name, "must be one of " + all + ", not '" + word + "'");
}

std::vector<nb::object> items(nb::handle object, std::size_t count, const char* name, const char* expected) {
    if (nb::isinstance<nb::str>(object) || !PySequence_Check(object.ptr())) wrong_type(name, expected, object);
    const Py_ssize_t length = PySequence_Size(object.ptr());
    if (length != static_cast<Py_ssize_t>(count)) {
        PyErr_Clear();
        wrong_value(name, std::string("must be ") + expected + ", not " + std::to_string(length));
    }
    std::vector<nb::object> found(count);
    for (std::size_t i = 0; i < count; ++i) {
        found[i] = nb::steal(PySequence_GetItem(object.ptr(), static_cast<Py_ssize_t>(i)));
        if (!found[i].is_valid()) throw nb::python_error();
    }
    return found;
}

Vec3 triple(nb::handle object, const char* name) {
    const std::vector<nb::object> of = items(object, 3, name, "three numbers");
    return {number({of[0]}, name), number({of[1]}, name), number({of[2]}, name)};
}

Color color(nb::handle object, const char* name) {
    const Vec3 values = triple(object, name);
    return {values.x, values.y, values.z};
}

Transform matrix(MatrixArgument argument, const char* name) {
    nb::object object;
    try {
        object = nb::module_::import_("numpy").attr("ascontiguousarray")(argument.object, "float64");
    } catch (const nb::python_error&) {
        wrong_type(name, "a matrix of numbers", argument.object);
    }
    const ArrayView array(object, name, "a matrix of numbers");
    if (array.rank() != 2 || array.length(1) != 4 || (array.length(0) != 3 && array.length(0) != 4))
        wrong_value(name, "must have shape (3, 4) or (4, 4), not " + shape_text(array.shape()));
    const double* m = array.data<double>();
    if (array.length(0) == 4 && !(m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1))
        wrong_value(name, "the last row must be 0 0 0 1");
    Transform transform;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) transform.rows[row][column] = m[4 * row + column];
    return transform;
}

ArrayView::ArrayView(nb::handle object, const char* name, const char* expected) {
    if (object.is_none() || !nb::try_cast(object, array_, false)) wrong_type(name, expected, object);
    if (array_.device_type() != nb::device::cpu::value) wrong_value(name, "must be in the CPU's memory");
    if (array_.dtype().bits < 8) wrong_type(name, expected, object);  // DLPack has types smaller than a byte
    // Check that the strides are those of a C-contiguous array.
    std::int64_t stride = 1;
    for (std::size_t axis = rank(); array_.size() > 0 && axis-- > 0;) {
        if (length(axis) > 1 && array_.stride(axis) != stride)
            wrong_value(name, "must be C-contiguous: numpy.ascontiguousarray makes such an array of shape " +
                                  shape_text(shape()));
        stride *= static_cast<std::int64_t>(length(axis));
    }
    if (reinterpret_cast<std::uintptr_t>(array_.data()) % (array_.dtype().bits / 8u) != 0)
        wrong_value(name, "must be aligned to its type");
}

bool ArrayView::is_whole_number() const {
    const std::uint8_t code = array_.dtype().code;
    return code == static_cast<std::uint8_t>(nb::dlpack::dtype_code::Int) ||
           code == static_cast<std::uint8_t>(nb::dlpack::dtype_code::UInt);
}

std::vector<std::size_t> ArrayView::shape() const {
    std::vector<std::size_t> lengths;
    for (std::size_t axis = 0; axis < rank(); ++axis) lengths.push_back(length(axis));
    return lengths;
}

std::string shape_text(const std::vector<std::size_t>& shape) {
    std::string text;
    for (const std::size_t length : shape) text += (text.empty() ? "" : ", ") + std::to_string(length);
    return "(" + text + (shape.size() == 1 ? ",)" : ")");
}

Rows::Rows(ArrayArgument argument, const char* name, std::size_t width, const char* expected)
    : array_(argument.object, name, expected) {
    if (!array_.holds<double>() && !array_.holds<float>())
        throw nb::type_error((std::string(name) + ": must be of float64 or float32").c_str());
    shape_ = array_.shape();
    if (shape_.empty() || shape_.back() != width)
        wrong_value(name, "must have shape (..., " + std::to_string(width) + "), not " + shape_text(shape_));
    shape_.pop_back();
    for (const std::size_t length : shape_) count_ *= length;
    if (count_ == 0) wrong_value(name, "must not be empty, but its shape is " + shape_text(array_.shape()));
}

nb::object new_array(const std::vector<std::size_t>& shape, const char* type, void*& values) {
    const nb::module_ numpy = nb::module_::import_("numpy");
    const nb::object dtype = numpy.attr("dtype")(type);
    auto bytes = nb::cast<std::size_t>(dtype.attr("itemsize"));
    nb::list lengths;
    for (const std::size_t length : shape) {
        lengths.append(length);
        bytes *= length;
    }
    if (bytes < kLeastKept) {
        nb::object array = numpy.attr("empty")(nb::tuple(lengths), dtype);
        values = nb::cast<nb::ndarray<>>(array).data();
        return array;
    }
    auto memory = std::make_unique<KeptMemory>(bytes);
    values = memory->data();
    const nb::capsule owner(memory.get(), [](void* m) noexcept { delete static_cast<KeptMemory*>(m); });
    memory.release();
    const nb::ndarray<nb::numpy, std::uint8_t> all(values, {bytes}, owner);
    return nb::cast(all).attr("view")(dtype).attr("reshape")(nb::tuple(lengths));
}

}  // namespace limn::python
