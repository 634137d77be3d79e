/// \file
/// Results as JSON, in addition to a table or instead of it.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "options.h"

namespace limn::app {

/// A JSON value for output. The members of an object are written in the order in which they were added. nlohmann's
/// library writes it; only json_output.cpp includes that library, because it adds three seconds to the compilation of a
/// source.
class Json {
public:
    using Array = std::vector<Json>;
    using Object = std::vector<std::pair<std::string, Json>>;

    Json(std::nullptr_t = nullptr) {}
    Json(bool value) : value_(value) {}
    Json(double value) : value_(value) {}
    template <std::signed_integral T>
    Json(T value) : value_(std::int64_t{value}) {}
    template <std::unsigned_integral T>
    Json(T value) : value_(std::uint64_t{value}) {}
    Json(const char* text) : value_(std::string(text)) {}
    Json(std::string text) : value_(std::move(text)) {}
    template <class T>
    Json(const std::vector<T>& values) : value_(Array(values.begin(), values.end())) {}
    /// Makes an object if all values are pairs of a name and a value, otherwise an array.
    Json(std::initializer_list<Json> values);

    static Json array() { return Json(Value(Array{})); }
    static Json object() { return Json(Value(Object{})); }

    /// Appends to an array. \pre this is an array
    void push_back(Json value) { std::get<Array>(value_).push_back(std::move(value)); }
    /// Returns a member of an object; adds it as null if there is none of that name. \pre this is an object
    Json& operator[](const std::string& name);
    /// Adds the members of another object; replaces members of the same name. \pre both are objects
    void update(const Json& object);

    using Value = std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array, Object>;
    const Value& value() const { return value_; }

private:
    explicit Json(Value value) : value_(std::move(value)) {}

    Value value_ = nullptr;
};

/// Returns the value as text that ends in a line break. Infinities and NaN become null.
std::string json_text(const Json& json);

/// The option --json FILE of the commands that print a table. With - as FILE, the JSON is printed instead of the table.
class JsonOption {
public:
    /// Adds the option. This object must outlive the parsing.
    explicit JsonOption(Options& options);

    /// Checks the file of the option, if it is given.
    /// \throws ArgumentError if it is one of the `inputs` or other `outputs`, FileError if it cannot be written
    void check(const std::vector<std::string>& inputs, std::vector<std::string> outputs = {}) const;

    /// Prints the table, and writes the JSON if the option is given. \throws FileError
    void write(const std::string& table, const Json& json) const;

private:
    std::string path_;
};

}  // namespace limn::app
