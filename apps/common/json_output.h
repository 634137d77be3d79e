/// \file
/// Results as JSON, beside a table or in place of it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "options.h"

namespace limn::app {

using Json = nlohmann::ordered_json;

/// What is not a finite number is null.
Json json_number(double value);

std::string json_text(const Json& json);

/// The option --json FILE of the commands that print a table; - is standard output, in place of the table.
class JsonOption {
public:
    /// Must outlive the parsing.
    explicit JsonOption(Options& options);

    /// \throws ArgumentError, FileError if the file cannot be written, or is one of the `inputs`
    void check(const std::vector<std::string>& inputs) const;

    /// Writes the table, and the JSON where it was asked for. \throws FileError
    void write(const std::string& table, const Json& json) const;

private:
    std::string path_;
};

}  // namespace limn::app
