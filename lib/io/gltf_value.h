#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "limn/core/error.h"

namespace limn {

// A value of a glTF's JSON, or none, and where it is: "meshes[0].primitives[1].mode". Asked for what it is not, it
// throws a FileError that names file and place.
class GltfValue {
public:
    GltfValue(const nlohmann::json& root, const std::string& path) : value_(&root), path_(&path) {}

    bool exists() const { return value_ != nullptr; }
    const std::string& place() const { return place_; }

    [[noreturn]] void fail(const std::string& problem) const {
        throw FileError(*path_, (place_.empty() ? "" : place_ + ": ") + problem);
    }

    // A member of an object; none if it lacks, or if there is no object.
    GltfValue operator[](const std::string& key) const {
        if (value_ && !value_->is_object()) fail("is not an object");
        const bool has_key = value_ && value_->contains(key);
        return {has_key ? &value_->at(key) : nullptr, place_.empty() ? key : place_ + "." + key, path_};
    }

    // Of an array; 0 if there is none.
    std::size_t size() const {
        if (value_ && !value_->is_array()) fail("is not an array");
        return value_ ? value_->size() : 0;
    }
    GltfValue operator[](std::size_t i) const {
        return {&value_->at(i), place_ + "[" + std::to_string(i) + "]", path_};
    }

    double number() const {
        require(value_ && value_->is_number(), "is not a number");
        const double number = value_->get<double>();
        require(std::isfinite(number), "is not a finite number");
        return number;
    }
    double number_or(double otherwise) const { return value_ ? number() : otherwise; }

    // A number of things, exact as a double.
    std::uint64_t natural() const {
        const double number = this->number();
        require(number >= 0 && number <= 0x1p53 && number == std::floor(number), "is not a number of things");
        return static_cast<std::uint64_t>(number);
    }
    std::uint64_t natural_or(std::uint64_t otherwise) const { return value_ ? natural() : otherwise; }

    // The element of `array` with this number.
    GltfValue in(const GltfValue& array) const {
        const std::uint64_t index = natural();
        if (index >= array.size())
            fail("is " + std::to_string(index) + ", but there are " + std::to_string(array.size()) + " " +
                 array.place());
        return array[static_cast<std::size_t>(index)];
    }

    std::string text_or(const std::string& otherwise) const {
        if (!value_) return otherwise;
        require(value_->is_string(), "is not a text");
        return value_->get<std::string>();
    }

    bool flag() const {
        require(!value_ || value_->is_boolean(), "is neither true nor false");
        return value_ && value_->get<bool>();
    }

    // Just as many numbers as there are in `otherwise`, which stands for an array that lacks.
    std::vector<double> numbers_or(std::vector<double> otherwise) const {
        if (!value_) return otherwise;
        require(size() == otherwise.size(), "must be " + std::to_string(otherwise.size()) + " numbers");
        for (std::size_t i = 0; i < otherwise.size(); ++i) otherwise[i] = (*this)[i].number();
        return otherwise;
    }

private:
    GltfValue(const nlohmann::json* value, std::string place, const std::string* path)
        : value_(value), place_(std::move(place)), path_(path) {}

    void require(bool holds, const std::string& problem) const {
        if (!holds) fail(problem);
    }

    const nlohmann::json* value_;
    std::string place_;
    const std::string* path_;
};

}  // namespace limn
