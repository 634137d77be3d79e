// What a file is by its contents, whatever its name: for messages about one that cannot be read.
#pragma once

#include <string>
#include <string_view>

namespace limn {

// "a PNG picture", "UTF-16 text", "a PLY model" and the like; empty where the contents carry no mark that is known
// here.
std::string kind_of_contents(std::string_view contents);

}  // namespace limn
