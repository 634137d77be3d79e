// RapidCheck inside Catch2: holds(...) states a law for all arguments and, where it fails, prints a small
// counterexample and the seed that finds it again. The seed is fixed, so that the suite's verdict is;
// RC_PARAMS="seed=..." chooses another.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "catch.h"

namespace limn::test {

/// \param cases how many arguments it is tried on
template <class Law>
void holds(Law&& law, int cases = 100) {
    rc::detail::TestParams params = rc::detail::configuration().testParams;
    params.maxSuccess = std::max(params.maxSuccess, cases);
    const auto result = rc::detail::checkTestable(std::forward<Law>(law), rc::detail::TestMetadata{}, params);
    std::ostringstream text;
    rc::detail::printResultMessage(result, text);
    INFO(text.str());
    CHECK(result.template is<rc::detail::SuccessResult>());
}

}  // namespace limn::test
