// All that the source of one instruction set holds: LIMN_TARGET is Highway's number of it. Empty where it is not built.
#pragma once

#include <hwy/detect_targets.h>

#if HWY_TARGETS & LIMN_TARGET
#undef HWY_TARGET
#define HWY_TARGET LIMN_TARGET
#include "trace/traverse-inl.h"
#endif
