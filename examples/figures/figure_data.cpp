#include "figure_data.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string_view>

namespace limn::figures {
namespace {

constexpr std::string_view kHeading = "cx0,cy0,cz0,cx1,cy1,cz1,radius,material,r,g,b,param";
constexpr std::size_t kRows = 256;  // length of a lattice's list of gradients, and of its permutations

// Calls `use` with each line of a file. If it throws an Error, throws a FileError that names the file and the line.
void for_each_line(const std::string& path, const std::function<void(std::string_view)>& use) {
    std::ifstream file(path);
    if (!file) throw FileError(path, "cannot be opened");
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        try {
            use(line);
        } catch (const Error& e) {
            throw FileError(path, "line " + std::to_string(number) + ": " + e.what());
        }
    }
    if (file.bad()) throw FileError(path, "cannot be read");
}

// Returns the fields of a line. Throws an Error unless there are `count`.
std::vector<std::string_view> split(std::string_view line, char separator, std::size_t count) {
    std::vector<std::string_view> fields;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(separator, begin), line.size());
        fields.push_back(line.substr(begin, end - begin));
        begin = end + 1;
    }
    if (fields.size() != count)
        throw Error("has " + std::to_string(fields.size()) + " fields instead of " + std::to_string(count));
    return fields;
}

// Returns the number that the text is. Throws an Error if it isn't one.
template <class Number>
Number parse(std::string_view text) {
    Number value{};
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc{} || end != text.data() + text.size())
        throw Error("'" + std::string(text) + "' is not a number of the expected kind");
    return value;
}

double parse_finite(std::string_view text) {
    const auto value = parse<double>(text);
    if (!std::isfinite(value)) throw Error("'" + std::string(text) + "' is not finite");
    return value;
}

BouncingSphere parse_sphere(std::string_view line) {
    const auto fields = split(line, ',', 12);
    const auto number = [&](std::size_t i) { return parse_finite(fields[i]); };
    const std::string material(fields[7]);
    if (material != "lambertian" && material != "metal" && material != "dielectric")
        throw Error("unknown material '" + material + "'");
    return {.center0 = {number(0), number(1), number(2)},
            .center1 = {number(3), number(4), number(5)},
            .radius = number(6),
            .material = material,
            .color = {number(8), number(9), number(10)},
            .parameter = number(11)};
}

bool is_permutation_of_bytes(std::array<std::uint8_t, kRows> values) {
    std::sort(values.begin(), values.end());
    for (std::size_t i = 0; i < kRows; ++i)
        if (values[i] != i) return false;
    return true;
}

}  // namespace

std::string data_file(const std::string& name) {
    const char* folder = std::getenv("LIMN_FIGURE_DATA");
    return std::string(folder && *folder ? folder : LIMN_FIGURE_DATA_DIR) + "/" + name;
}

std::vector<BouncingSphere> read_bouncing_spheres(const std::string& path) {
    std::vector<BouncingSphere> spheres;
    bool heading_read = false;
    for_each_line(path, [&](std::string_view line) {
        if (heading_read) return spheres.push_back(parse_sphere(line));
        if (line != kHeading) throw Error("the heading is not " + std::string(kHeading));
        heading_read = true;
    });
    if (spheres.empty()) throw FileError(path, "holds no sphere");
    return spheres;
}

std::shared_ptr<const PerlinLattice> read_perlin_lattice(const std::string& path) {
    // Read the rows: gradients, then permutations.
    auto lattice = std::make_shared<PerlinLattice>();
    std::size_t row = 0;
    for_each_line(path, [&](std::string_view line) {
        if (line.starts_with('#')) return;
        const auto fields = split(line, ' ', 3);
        if (row < kRows) {
            lattice->gradients[row] = {parse_finite(fields[0]), parse_finite(fields[1]), parse_finite(fields[2])};
        } else if (row < 2 * kRows) {
            lattice->perm_x[row - kRows] = parse<std::uint8_t>(fields[0]);
            lattice->perm_y[row - kRows] = parse<std::uint8_t>(fields[1]);
            lattice->perm_z[row - kRows] = parse<std::uint8_t>(fields[2]);
        } else {
            throw Error("more than " + std::to_string(2 * kRows) + " rows");
        }
        ++row;
    });
    // Check that they are complete and valid.
    if (row != 2 * kRows)
        throw FileError(path, "has " + std::to_string(row) + " rows instead of " + std::to_string(2 * kRows));
    for (const auto* permutation : {&lattice->perm_x, &lattice->perm_y, &lattice->perm_z})
        if (!is_permutation_of_bytes(*permutation)) throw FileError(path, "a column is not a permutation of 0..255");
    return lattice;
}

}  // namespace limn::figures
