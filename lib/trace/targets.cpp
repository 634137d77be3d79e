#include "trace/targets.h"

#include <hwy/highway.h>
#include <hwy/targets.h>

namespace limn::trace {

std::vector<std::string> targets() {
    std::vector<std::string> names;
    for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1)
        names.emplace_back(hwy::TargetName(rest & -rest));  // a lower bit is a better one
    return names;
}

bool force_target(const std::string& name) {
    hwy::SetSupportedTargetsForTest(0);  // all of them
    for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1) {
        if (name != hwy::TargetName(rest & -rest)) continue;
        hwy::SetSupportedTargetsForTest(rest & -rest);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        return true;
    }
    return false;
}

}  // namespace limn::trace
