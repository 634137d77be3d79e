#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "commands.h"
#include "json_output.h"
#include "limn/image/compare.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "parse.h"
#include "program.h"
#include "text_file.h"

namespace limn::app {

namespace {

struct Arguments {
    std::string test, reference, reference_b;
    std::vector<std::string> outputs;
};

// The metrics and the error image of `test` against the reference.
struct Measured {
    ImageMetrics metrics;
    Image error;
};

Measured measure(const Arguments& a) {
    const Image test = load_image(a.test);
    const Image reference = load_image(a.reference);
    try {
        if (a.reference_b.empty()) return {compare_images(test, reference), error_image(test, reference)};
        const Image half = load_image(a.reference_b);
        return {compare_images(test, reference, half), error_image(test, reference, half)};
    } catch (const ArgumentError& e) {
        throw Error(a.test + ": " + e.what());  // the sizes differ, which is an error in the files
    }
}

// Saves the error of each value as numbers in an EXR, in false colours in other formats.
void save_error(const Image& error, const std::string& path) {
    save_image(image_holds_layers(path) ? error : false_colour(error), path);
}

std::string table(const ImageMetrics& m) {
    std::string text;
    const auto row = [&text](const char* name, const std::string& value) { text += table_row(name, value); };
    const auto number = [](double value) { return std::isnan(value) ? "undefined" : fmt::format("{:.6g}", value); };
    row("relMSE", m.valid ? number(m.relative_mse) : "invalid");
    row("MSE", number(m.mse));
    row("SMAPE", number(m.smape));
    row("PSNR", number(m.psnr_srgb) + " dB");
    row("largest relative error",
        fmt::format("{} at pixel ({}, {})", number(m.largest_relative), m.largest_x, m.largest_y));
    row("share of worst 0.1 %", number(m.worst_share));
    row("non-finite values",
        fmt::format("{} in the test, {} in the reference", m.nonfinite_test, m.nonfinite_reference));
    if (m.has_reference_error) {
        row("reference's own relMSE", number(m.reference_relative_mse));
        row("corrected relMSE", number(m.corrected_relative_mse));
        row("reference good enough", m.reference_too_noisy ? "no: its own error is over a tenth of relMSE" : "yes");
    }
    return text;
}

// Returns the metrics as JSON. The PSNR of equal images is infinite, which becomes null.
Json json(const ImageMetrics& m, const Arguments& a) {
    Json json = {
        {"test", a.test},
        {"reference", a.reference},
        {"valid", m.valid},
        {"relmse", m.relative_mse},
        {"mse", m.mse},
        {"smape", m.smape},
        {"psnr", m.psnr_srgb},
        {"largest_relative_error", {{"value", m.largest_relative}, {"x", m.largest_x}, {"y", m.largest_y}}},
        {"worst_share", m.worst_share},
        {"nonfinite", {{"test", m.nonfinite_test}, {"reference", m.nonfinite_reference}}},
    };
    if (m.has_reference_error) {
        json["reference_b"] = a.reference_b;
        json["reference_relmse"] = m.reference_relative_mse;
        json["corrected_relmse"] = m.corrected_relative_mse;
        json["reference_too_noisy"] = m.reference_too_noisy;
    }
    return json;
}

}  // namespace

int compare_command(int argc, const char* const* argv) {
    // Read the options.
    Options options(
        "limn compare",
        "Prints the error of an image against a reference. The reference may come in two independent halves: "
        "then its own error is estimated and subtracted.");
    Arguments a;
    const auto image = [&options](const std::string& name, std::string& path, const char* help, bool required) {
        options.add({.name = name, .value = "", .help = help, .preset = required ? "" : "none", .required = required},
                    file_name(name, path));
    };
    image("TEST", a.test, "The image to measure", true);
    image("REF", a.reference, "The reference, or one half of it", true);
    image("REF_B", a.reference_b, "The other half of the reference", false);
    options.add(
        {.name = "-o,--output",
         .value = "FILE",
         .help = "A picture of the error to write: .exr holds (x - r)^2 / (r^2 + 0.01) of each value, whose mean "
                 "is relMSE; .png shows false colours, black to white for 1e-6 to 1. May be repeated",
         .preset = "none",
         .repeatable = true},
        picture_names("-o", a.outputs));
    const JsonOption json_option(options);
    if (!options.parse(argc, argv)) return kDone;

    // Check that the outputs can be written, before anything is read.
    const std::vector<std::string> inputs = {a.test, a.reference, a.reference_b};
    json_option.check(inputs, a.outputs);
    for (const std::string& path : a.outputs) check_writable(path);

    // Measure, and write the results.
    const auto [metrics, error] = measure(a);
    for (const std::string& path : a.outputs) save_error(error, path);
    json_option.write(table(metrics), json(metrics, a));
    if (metrics.valid) return kDone;
    throw Error(fmt::format("the error is invalid: {} values are not finite",
                            metrics.nonfinite_test + metrics.nonfinite_reference));
}

}  // namespace limn::app
