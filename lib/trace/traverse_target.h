// The source of one instruction set. LIMN_TARGET is Highway's number of it. It is empty if this set isn't compiled.
#pragma once

#include <hwy/detect_targets.h>

#if HWY_TARGETS & LIMN_TARGET
#undef HWY_TARGET
#define HWY_TARGET LIMN_TARGET
#include "trace/traverse-inl.h"
#endif
