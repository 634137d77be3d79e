/// \file
/// Deprecated: limn/core/files.h.
#pragma once

#include "limn/core/files.h"
