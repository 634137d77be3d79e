#pragma once

#include "limn/core/hash128.h"
#include "limn/records.h"
#include "limn/scene/background.h"

namespace limn::compiler {

// Of all that a scene's pictures depend on: the same from every compiler, instruction set and number of threads.
Hash128 digest(const SceneRecords& records, const Background& background);

}  // namespace limn::compiler
