#include "json_output.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "parse.h"
#include "text_file.h"

namespace limn::app {

namespace {

using Written = nlohmann::ordered_json;

// Converts a Json to nlohmann's type.
struct Writer {
    Written operator()(const Json& json) const { return std::visit(*this, json.value()); }
    Written operator()(const Json::Array& values) const {
        Written array = Written::array();
        for (const Json& value : values) array.push_back((*this)(value));
        return array;
    }
    Written operator()(const Json::Object& members) const {
        Written object = Written::object();
        for (const auto& [name, value] : members) object[name] = (*this)(value);
        return object;
    }
    template <class Scalar>
    Written operator()(const Scalar& scalar) const {
        return scalar;
    }
};

// True if a value is an array of two, the first of them a string: the form of a member in an initializer list.
bool is_member(const Json& json) {
    const auto* pair = std::get_if<Json::Array>(&json.value());
    return pair != nullptr && pair->size() == 2 && std::holds_alternative<std::string>(pair->front().value());
}

}  // namespace

Json::Json(std::initializer_list<Json> values) : value_(Array(values)) {
    if (values.size() == 0 || !std::all_of(values.begin(), values.end(), is_member)) return;
    Object members;
    for (const Json& value : values) {
        const Array& pair = std::get<Array>(value.value_);
        members.emplace_back(std::get<std::string>(pair[0].value_), pair[1]);
    }
    value_ = std::move(members);
}

Json& Json::operator[](const std::string& name) {
    Object& members = std::get<Object>(value_);
    for (auto& [key, value] : members)
        if (key == name) return value;
    return members.emplace_back(name, nullptr).second;
}

void Json::update(const Json& object) {
    for (const auto& [name, value] : std::get<Object>(object.value_)) (*this)[name] = value;
}

std::string json_text(const Json& json) {
    // Names of files may not be UTF-8, so replace invalid bytes instead of throwing.
    return Writer{}(json).dump(2, ' ', false, Written::error_handler_t::replace) + "\n";
}

JsonOption::JsonOption(Options& options) {
    options.add({.name = "--json",
                 .value = "FILE",
                 .help = "Write the results as JSON too; - for standard output, in place of the table",
                 .preset = "the table alone"},
                file_name("--json", path_));
}

void JsonOption::check(const std::vector<std::string>& inputs, std::vector<std::string> outputs) const {
    outputs.push_back(path_);
    check_distinct(outputs, inputs);
    if (!path_.empty()) check_text_path(path_);
}

void JsonOption::write(const std::string& table, const Json& json) const {
    if (path_ != "-") write_text("-", table);
    if (!path_.empty()) write_text(path_, json_text(json));
}

}  // namespace limn::app
