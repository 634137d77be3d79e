#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "limn/math/error.h"

namespace limn {

// A value in the JSON of a glTF with its place, "meshes[0].primitives[1].mode" for example, or a value that does not
// exist. Every function throws a FileError that names the file and the place if the value is not of the type that the
// function needs. The JSON and the path are not owned.
class GltfValue {
public:
    GltfValue(const nlohmann::json& root, const std::string& path) : value_(&root), path_(&path) {}

    bool exists() const { return value_ != nullptr; }
    const std::string& place() const { return place_; }

    [[noreturn]] void fail(const std::string& problem) const {
        throw FileError(*path_, (place_.empty() ? "" : place_ + ": ") + problem);
    }

    // Returns a member of an object. It does not exist if the object lacks it or does not exist itself.
    GltfValue operator[](const std::string& key) const {
        if (value_ && !value_->is_object()) fail("is not an object");
        const bool has_key = value_ && value_->contains(key);
        return {has_key ? &value_->at(key) : nullptr, place_.empty() ? key : place_ + "." + key, path_};
    }

    // Returns the number of elements of an array; 0 if it does not exist.
    std::size_t size() const {
        if (value_ && !value_->is_array()) fail("is not an array");
        return value_ ? value_->size() : 0;
    }
    // Returns an element of an array. \pre i < size()
    GltfValue operator[](std::size_t i) const {
        return {&value_->at(i), place_ + "[" + std::to_string(i) + "]", path_};
    }

    // Returns a finite number. Throws also if the value does not exist.
    double number() const {
        require(value_ && value_->is_number(), "is not a number");
        const double number = value_->get<double>();
        require(std::isfinite(number), "is not a finite number");
        return number;
    }
    double number_or(double otherwise) const { return value_ ? number() : otherwise; }

    // Returns an integer from 0 to 2^53. Throws also if the value does not exist.
    std::uint64_t natural() const {
        const double number = this->number();
        require(number >= 0 && number <= 0x1p53 && number == std::floor(number), "is not a number of things");
        return static_cast<std::uint64_t>(number);
    }
    std::uint64_t natural_or(std::uint64_t otherwise) const { return value_ ? natural() : otherwise; }

    // Returns the element of `array` that has this value as its index.
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

    // Returns a Boolean; false if the value does not exist.
    bool flag() const {
        require(!value_ || value_->is_boolean(), "is neither true nor false");
        return value_ && value_->get<bool>();
    }

    // Returns an array of exactly as many numbers as `otherwise` has; `otherwise` if the array does not exist.
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
