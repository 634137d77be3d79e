// `limn compare` on images small enough to do by hand.
#include <limits>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "limn/io/image_io.h"
#include "process.h"
#include "support/folder.h"
#include "table.h"

namespace limn::test::compare_test {
namespace {

using Json = nlohmann::json;

std::string image_file(const Folder& folder, const std::string& name, const Image& image) {
    save_image(image, folder.path(name));
    return folder.path(name);
}

TEST_CASE("limn compare: prints the metrics of two images, and the same as JSON", "[cli]") {
    const Folder folder;
    Image test(2, 1, {0.5, 0.5, 0.5});
    const Image reference(2, 1, {0.5, 0.5, 0.5});
    test.set(1, 0, {0.75, 0.5, 0.5});  // one value of six is off by 1/4
    const std::string a = image_file(folder, "a.exr", test), b = image_file(folder, "b.exr", reference);

    const Outcome outcome = limn({"compare", a, b, "--json", folder.path("c.json")});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    const double relmse = 0.0625 / 0.26 / 6, largest = 0.25 / std::sqrt(0.26);
    CHECK(std::stod(row(outcome.out, "relMSE")) == Approx(relmse).epsilon(1e-5));  // six digits are printed
    CHECK(std::stod(row(outcome.out, "MSE")) == Approx(0.0625 / 6).epsilon(1e-5));
    CHECK(std::stod(row(outcome.out, "SMAPE")) == Approx(2 * 0.25 / 1.25 / 6).epsilon(1e-5));
    const double db = -10 * std::log10(std::pow(srgb_encode(0.75) - srgb_encode(0.5), 2) / 6);
    CHECK(std::stod(row(outcome.out, "PSNR")) == Approx(db).epsilon(1e-5));
    CHECK(std::stod(row(outcome.out, "largest relative error")) == Approx(largest).epsilon(1e-5));
    CHECK(row(outcome.out, "largest relative error").find("(1, 0)") != std::string::npos);
    CHECK(std::stod(row(outcome.out, "share of worst 0.1 %")) == 1);
    CHECK(row(outcome.out, "non-finite values") == "0 in the test, 0 in the reference");

    const Json json = Json::parse(folder.read("c.json"));
    CHECK(json["valid"] == true);
    CHECK(json["relmse"].get<double>() == Approx(relmse));
    CHECK(json["largest_relative_error"]["x"] == 1);
    CHECK(json["nonfinite"]["test"] == 0);
    CHECK_FALSE(json.contains("corrected_relmse"));
}

TEST_CASE("limn compare: the JSON stands alone on stdout for -, and equal images have no error", "[cli]") {
    const Folder folder;
    const std::string a = image_file(folder, "a.exr", Image(3, 2, {0.1, 0.2, 0.3}));
    const Outcome outcome = limn({"compare", a, a, "--json", "-"});
    REQUIRE(outcome.status == 0);
    const Json json = Json::parse(outcome.out);
    CHECK(json["relmse"] == 0);
    CHECK(json["psnr"].is_null());  // infinite
}

TEST_CASE("limn compare: the error of a reference in two halves is subtracted and judged", "[cli]") {
    const Folder folder;
    const std::string test = image_file(folder, "t.exr", Image(1, 1, {1, 1, 1}));
    const std::string low = image_file(folder, "l.exr", Image(1, 1, {0.25, 0.25, 0.25}));
    const std::string high = image_file(folder, "h.exr", Image(1, 1, {0.75, 0.75, 0.75}));
    const Outcome outcome = limn({"compare", test, low, high});
    REQUIRE(outcome.status == 0);
    // Mean of the halves 1/2, half their difference 1/4.
    const double measured = 0.25 / 0.26, own = 0.0625 / 0.26;
    CHECK(std::stod(row(outcome.out, "relMSE")) == Approx(measured).epsilon(1e-5));
    CHECK(std::stod(row(outcome.out, "reference's own relMSE")) == Approx(own).epsilon(1e-5));
    CHECK(std::stod(row(outcome.out, "corrected relMSE")) == Approx(measured - own).epsilon(1e-5));
    CHECK(row(outcome.out, "reference good enough").starts_with("no"));
}

TEST_CASE("limn compare: one value that is not finite makes the error invalid, with status 1", "[cli]") {
    const Folder folder;
    Image bad(2, 2);
    bad.set(1, 1, {std::numeric_limits<double>::quiet_NaN(), 0, 0});
    const Outcome outcome =
        limn({"compare", image_file(folder, "bad.exr", bad), image_file(folder, "good.exr", Image(2, 2))});
    CHECK(outcome.status == 1);
    CHECK(row(outcome.out, "relMSE") == "invalid");
    CHECK(row(outcome.out, "non-finite values") == "1 in the test, 0 in the reference");
    CHECK(outcome.err.find("not finite") != std::string::npos);
}

TEST_CASE("limn compare: images of different size and missing files are refused with status 1", "[cli]") {
    const Folder folder;
    const std::string a = image_file(folder, "a.exr", Image(2, 3)), b = image_file(folder, "b.exr", Image(3, 2));
    const Outcome sizes = limn({"compare", a, b, "--json", folder.path("c.json")});
    CHECK(sizes.status == 1);
    CHECK(sizes.err.find("a.exr") != std::string::npos);
    const Outcome missing = limn({"compare", a, folder.path("none.exr")});
    CHECK(missing.status == 1);
    CHECK(missing.err.find("none.exr") != std::string::npos);
    CHECK((sizes.out + missing.out).empty());
    CHECK(folder.names() == Names{"a.exr", "b.exr"});
}

TEST_CASE("limn compare: JSON that would replace one of the images is refused", "[cli]") {
    const Folder folder;
    const std::string a = image_file(folder, "a.exr", Image(2, 3));
    const std::string before = folder.read("a.exr");
    CHECK(limn({"compare", a, a, "--json", a}).status == 2);
    CHECK(folder.read("a.exr") == before);
}

TEST_CASE("limn compare: one file is not two outputs", "[cli]") {
    const Folder folder;
    save_image(Image(2, 2), folder.path("a.exr"));
    const Outcome outcome = limn({"compare", folder.path("a.exr"), folder.path("a.exr"), "-o", folder.path("d.exr"),
                                  "--json", folder.path("d.exr")});
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find("d.exr: is named twice as an output") != std::string::npos);
}

TEST_CASE("limn compare: -o shows where the error is, as numbers whose mean is relMSE and in false colours", "[cli]") {
    const Folder folder;
    Image test(3, 2, {0.5, 0.5, 0.5});
    const Image reference(3, 2, {0.5, 0.5, 0.5});
    test.set(1, 1, {0.75, 0.5, 0.5});
    const std::string a = image_file(folder, "a.exr", test), b = image_file(folder, "b.exr", reference);
    const Outcome outcome = limn({"compare", a, b, b, "-o", folder.path("d.exr"), "-o", folder.path("d.png")});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const Image numbers = load_image(folder.path("d.exr")), colours = load_image(folder.path("d.png"));
    CHECK(numbers.at(1, 1).r == Approx(0.0625 / 0.26).epsilon(1e-6));
    CHECK(numbers.at(1, 1).r / 18 == Approx(std::stod(row(outcome.out, "relMSE"))).epsilon(1e-5));
    CHECK(numbers.at(0, 1) == Color{});
    CHECK(colours.at(0, 1) == Color{});
    CHECK(colours.at(1, 1).r > 0.5);
}

TEST_CASE("limn compare: a picture of the error replaces none that is compared, and has a name that says its format",
          "[cli]") {
    const Folder folder;
    const std::string a = image_file(folder, "a.exr", Image(2, 2, {1, 1, 1}));
    CHECK(limn({"compare", a, a, "-o", a}).status == 2);
    CHECK(limn({"compare", a, a, "-o", folder.path("d.jpg")}).status == 2);
    CHECK(limn({"compare", a, a, "-o", folder.path("no/d.exr")}).status == 1);
    CHECK(limn({"compare", a, a, "-o", folder.path("d.exr"), "--json", folder.path("d.exr")}).status == 2);
    CHECK(folder.names() == Names{"a.exr"});
    CHECK(load_image(a).at(0, 0) == Color{1, 1, 1});
    // What is invalid fails, and still shows where.
    Image bad(2, 2, {1, 1, 1});
    bad.set(1, 0, {std::numeric_limits<double>::quiet_NaN(), 1, 1});
    CHECK(limn({"compare", image_file(folder, "bad.exr", bad), a, "-o", folder.path("d.png")}).status == 1);
    CHECK(load_image(folder.path("d.png")).at(1, 0) == Color{0, 1, 0});
}

}  // namespace
}  // namespace limn::test::compare_test
