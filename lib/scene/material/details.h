// What materials around others add to their records.
#pragma once

#include "limn/records/records.h"

namespace limn {

inline MaterialDetails details_of(const MaterialRecord& record) {
    return record.details ? *record.details : MaterialDetails{};
}

}  // namespace limn
