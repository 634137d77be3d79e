// A small model for the command line to render.
#pragma once

#include <string>

namespace limn::test {

/// A block with a roof, its coordinates small whole numbers times `scale`, rounded to float32.
std::string house_obj(double scale = 1);

}  // namespace limn::test
