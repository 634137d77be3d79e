#pragma once

#include <string>

namespace limn::test {

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace limn::test
