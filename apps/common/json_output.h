/// \file
/// Results as JSON, beside a table or in place of it.
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

/// A JSON value, put together to be written; members of objects stay in order. The writing is done by nlohmann's
/// library, which json_output.cpp alone includes: each source that does takes three seconds more to compile.
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
    /// An object where all are pairs of a name and a value, else an array.
    Json(std::initializer_list<Json> values);

    static Json array() { return Json(Value(Array{})); }
    static Json object() { return Json(Value(Object{})); }

    /// To an array.
    void push_back(Json value) { std::get<Array>(value_).push_back(std::move(value)); }
    /// The member of an object, which is added where it lacks.
    Json& operator[](const std::string& name);
    /// Adds the members of another object.
    void update(const Json& object);

    using Value = std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array, Object>;
    const Value& value() const { return value_; }

private:
    explicit Json(Value value) : value_(std::move(value)) {}

    Value value_ = nullptr;
};

/// As text; what is not a finite number is null.
std::string json_text(const Json& json);

/// The option --json FILE of the commands that print a table; - is standard output, in place of the table.
class JsonOption {
public:
    /// Must outlive the parsing.
    explicit JsonOption(Options& options);

    /// \throws ArgumentError, FileError if the file cannot be written, or is one of the `inputs` or other `outputs`
    void check(const std::vector<std::string>& inputs, std::vector<std::string> outputs = {}) const;

    /// Writes the table, and the JSON if its option is given. \throws FileError
    void write(const std::string& table, const Json& json) const;

private:
    std::string path_;
};

}  // namespace limn::app
