// The line that the progress bar draws.
#include "progress_bar.h"

#include "catch.h"
#include "stderr.h"

namespace limn::test::progress_bar_test {
namespace {

std::string bar_at(double fraction, double seconds) {
    std::string line;
    app::ProgressBar bar(true);
    line = written_to_stderr([&] { bar.update({fraction, seconds}); });
    written_to_stderr([&] { bar.clear(); });
    return line;
}

const std::string kErase = "\r\033[K";

TEST_CASE("Progress bar: thirty cells, the percentage, the time gone and the time left", "[cli][progress]") {
    CHECK(bar_at(0, 3) == "\r[                              ]   0 %  3 s\033[K");
    CHECK(bar_at(0.5, 20) == "\r[===============               ]  50 %  20 s, 20 s left\033[K");
    CHECK(bar_at(0.2, 10) == "\r[======                        ]  20 %  10 s, 40 s left\033[K");
    CHECK(bar_at(1, 10) == "\r[==============================] 100 %  10 s, 0 s left\033[K");
    CHECK(bar_at(1.5, 10) == bar_at(1, 10));
    CHECK(bar_at(-1, 3) == bar_at(0, 3));
}

TEST_CASE("Progress bar: minutes from 60 seconds on, hours from 60 minutes on", "[cli][progress]") {
    CHECK(bar_at(1, 59).find("59 s,") != std::string::npos);
    CHECK(bar_at(1, 60).find("1 min,") != std::string::npos);
    CHECK(bar_at(1, 3000).find("50 min,") != std::string::npos);
    CHECK(bar_at(1, 3600).find("1.0 h,") != std::string::npos);
    CHECK(bar_at(1, 9000).find("2.5 h,") != std::string::npos);
}

TEST_CASE("Progress bar: drawn five times a second at most, erased once, and never if it is not wanted",
          "[cli][progress]") {
    app::ProgressBar bar(true);
    CHECK_FALSE(written_to_stderr([&] { bar.update({0.1, 1}); }).empty());
    CHECK(written_to_stderr([&] { bar.update({0.2, 1.1}); }).empty());
    CHECK_FALSE(written_to_stderr([&] { bar.update({0.3, 1.25}); }).empty());
    CHECK(written_to_stderr([&] { bar.update({0.4, 1.4}); }).empty());
    CHECK(written_to_stderr([&] { bar.clear(); }) == kErase);
    CHECK(written_to_stderr([&] { bar.clear(); }).empty());
    CHECK_FALSE(written_to_stderr([&] { bar.update({0.4, 1.41}); }).empty());  // drawn anew, whenever that is
    CHECK(written_to_stderr([&] { bar.clear(); }) == kErase);

    const std::string all = written_to_stderr([] {
        app::ProgressBar gone(true);
        gone.update({0.5, 1});
    });
    CHECK(all.ends_with(kErase));
    CHECK(written_to_stderr([] { app::ProgressBar(false).update({0.5, 1}); }).empty());
}

}  // namespace
}  // namespace limn::test::progress_bar_test
