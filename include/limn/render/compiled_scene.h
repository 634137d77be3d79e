/// \file
/// Deprecated: the header has moved. This name leaves with the next version.
#pragma once

#include "limn/query/compiled_scene.h"
