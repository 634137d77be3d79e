#include "json_output.h"

#include <cmath>

#include "parse.h"
#include "text_file.h"

namespace limn::app {

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string json_text(const Json& json) {
    // Names of files need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

JsonOption::JsonOption(Options& options) {
    options.add({.name = "--json",
                 .value = "FILE",
                 .help = "Write JSON too; - for standard output, in place of the table",
                 .preset = "the table alone"},
                file_name("--json", path_));
}

void JsonOption::check(const std::vector<std::string>& inputs) const {
    check_distinct({path_}, inputs);
    if (!path_.empty()) check_text_path(path_);
}

void JsonOption::write(const std::string& table, const Json& json) const {
    if (path_ != "-") write_text("-", table);
    if (!path_.empty()) write_text(path_, json_text(json));
}

}  // namespace limn::app
