// The tables that commands print.
#pragma once

#include <string>

#include "catch.h"

namespace limn::test {

/// The value that stands after `label` at the start of a line.
inline std::string row(const std::string& table, const std::string& label) {
    const std::size_t at = ("\n" + table).find("\n" + label + " ");
    REQUIRE(at != std::string::npos);
    const std::size_t value = table.find_first_not_of(' ', at + label.size());
    return table.substr(value, table.find('\n', value) - value);
}

}  // namespace limn::test
