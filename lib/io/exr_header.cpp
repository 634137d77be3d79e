#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "io/picture_checks.h"

namespace limn {

namespace {

constexpr const char *kHeaderBreaksOff = "its header breaks off", *kWrongSize = "an attribute has the wrong size";

// Reads a signed integer of 32 bits.
std::int64_t take_integer(Cursor& bytes) { return static_cast<std::int32_t>(bytes.little(4)); }

// Reads a name, which ends in a zero byte.
std::string take_name(Cursor& bytes) {
    constexpr std::size_t kLongest = 255;
    const std::size_t size = text_of(bytes.rest()).find('\0');
    demand(size <= kLongest, "a name in its header is too long");
    return std::string(text_of(bytes.take(size + 1)).substr(0, size));
}

// The value of the attribute `tiles`.
struct Tiles {
    std::int64_t width, height;  // of a tile, in pixels
    int levels;                  // 0: one level; 1: mipmap levels; 2: ripmap levels, reduced in x and y separately
    bool round_up;               // true if the size of a level is rounded up, else down
};

// The attributes of a part of the file that determine how much memory it takes.
struct Part {
    std::optional<std::int64_t> width, height;
    std::optional<std::size_t> compression;
    std::optional<Tiles> tiles;
    std::int64_t bytes_per_pixel = 0;  // sum over all channels
    std::string type;
};

struct Compression {
    std::int64_t lines;  // lines of pixels in a chunk
    double best;         // upper bound on the bytes that one byte of the file unpacks to
};
// The compressions, in the order of their numbers in the file: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
// RLE packs runs of at most 127 bytes into two. Deflate reaches 1032. B44 packs 4 x 4 halves into 14 bytes, B44A also
// into 3.
constexpr Compression kCompressions[] = {{1, 1},     {1, 64}, {1, 1032}, {16, 1032},  {32, 5000},
                                         {16, 1400}, {32, 3}, {32, 11},  {32, 66000}, {256, 66000}};

// The attribute types of fixed size, with the size in bytes (OpenEXR File Layout, "Predefined Attribute Types").
// OpenEXR reads this number of bytes whatever size the header states.
constexpr std::pair<std::string_view, std::size_t> kSizes[] = {
    {"compression", 1}, {"deepImageState", 1}, {"envmap", 1},   {"lineOrder", 1}, {"float", 4},
    {"int", 4},         {"double", 8},         {"rational", 8}, {"timecode", 8},  {"v2f", 8},
    {"v2i", 8},         {"tiledesc", 9},       {"v3f", 12},     {"v3i", 12},      {"box2f", 16},
    {"box2i", 16},      {"v2d", 16},           {"v3d", 24},     {"keycode", 28},  {"chromaticities", 32},
    {"m33f", 36},       {"m44f", 64},          {"m33d", 72},    {"m44d", 128}};

// Returns the number of bytes that all channels together take for a pixel.
std::int64_t read_channels(Cursor value) {
    std::int64_t bytes = 0;
    while (!take_name(value).empty()) {
        const std::int64_t type = take_integer(value);
        demand(type >= 0 && type <= 2, "a channel is of no known kind");
        bytes += type == 1 ? 2 : 4;
        value.take(4);  // pLinear and three reserved bytes
        demand(take_integer(value) == 1 && take_integer(value) == 1,
               "a channel is not there for every pixel, which is not read");
    }
    demand(value.rest().size() == 0, kWrongSize);
    return bytes;
}

// Throws a Fault if the size of a value does not suit its type, or if a size that is stated inside the value is wrong.
void check_value(const std::string& type, Cursor value) {
    for (const auto& [name, size] : kSizes) demand(type != name || value.rest().size() == size, kWrongSize);
    if (type == "preview") {
        const std::uint64_t width = value.little(4), height = value.little(4);
        demand(width * height <= value.rest().size() && width * height * 4 == value.rest().size(), kWrongSize);
    } else if (type == "stringvector") {
        while (value.rest().size() > 0) value.take(value.little(4));
    } else if (type == "floatvector") {
        demand(value.rest().size() % 4 == 0, kWrongSize);
    } else if (type == "idmanifest") {
        const std::uint64_t unpacked = value.little(4);
        demand(unpacked <= 1032 * value.rest().size(), kWrongSize);
    }
}

// Stores the value of an attribute in `part` if it is one of the part's members.
void read_attribute(const std::string& name, const std::string& type, Cursor value, Part& part) {
    if (name == "dataWindow" && type == "box2i") {
        const std::int64_t left = take_integer(value), top = take_integer(value);
        part.width = take_integer(value) - left + 1;
        part.height = take_integer(value) - top + 1;
    } else if (name == "compression" && type == "compression") {
        part.compression = value.little(1);
    } else if (name == "channels" && type == "chlist") {
        part.bytes_per_pixel = read_channels(value);
    } else if (name == "type" && type == "string") {
        part.type = text_of(value.rest());
    } else if (name == "tiles" && type == "tiledesc") {
        const auto width = static_cast<std::int64_t>(value.little(4)),
                   height = static_cast<std::int64_t>(value.little(4));
        const std::uint64_t mode = value.little(1);
        part.tiles = Tiles{width, height, static_cast<int>(mode & 15), mode >> 4 == 1};
        demand(width > 0 && height > 0 && part.tiles->levels <= 2 && mode >> 4 <= 1, "its tiles are of no known kind");
    }
}

// Reads the header of a part: attributes up to an empty name. Returns std::nullopt if there is no attribute; an empty
// header follows the header of the last part.
std::optional<Part> read_header(Cursor& file) {
    Part part;
    std::set<std::string> names;
    for (std::string name; !(name = take_name(file)).empty();) {
        demand(names.insert(name).second, "an attribute stands there twice");
        const std::string type = take_name(file);
        const std::int64_t size = take_integer(file);
        const bool fits = size >= 0 && static_cast<std::uint64_t>(size) <= file.rest().size();
        demand(fits, "an attribute is larger than the file");
        const Cursor value(file.take(static_cast<std::size_t>(size)), kHeaderBreaksOff);
        check_value(type, value);
        read_attribute(name, type, value, part);
    }
    if (names.empty()) return std::nullopt;
    return part;
}

// Returns a / b, rounded up.
std::int64_t divided_up(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

// Returns the sizes of all levels of a picture along one axis, from the full size down to 1. If there is only one
// level, returns the full size.
std::vector<std::int64_t> level_sizes(std::int64_t size, const Tiles& tiles) {
    std::vector<std::int64_t> sizes{size};
    while (tiles.levels > 0 && sizes.back() > 1) sizes.push_back((sizes.back() + (tiles.round_up ? 1 : 0)) / 2);
    return sizes;
}

// Returns the number of tiles in all levels of a picture.
double tile_count(const Tiles& tiles, std::int64_t width, std::int64_t height) {
    std::vector<std::int64_t> widths = level_sizes(width, tiles), heights = level_sizes(height, tiles);
    const std::size_t most = std::max(widths.size(), heights.size());
    if (tiles.levels == 1) {
        widths.resize(most, 1);
        heights.resize(most, 1);
    }
    double count = 0;
    for (std::size_t x = 0; x < widths.size(); ++x)
        for (std::size_t y = 0; y < heights.size(); ++y)
            if (tiles.levels != 1 || x == y)
                count += static_cast<double>(divided_up(widths[x], tiles.width)) *
                         static_cast<double>(divided_up(heights[y], tiles.height));
    return count;
}

// Checks that the file can hold a part and that its decoder takes a reasonable amount of memory. `rest` is the number
// of bytes after the headers. Returns the number of chunks in the part.
double check_part(const Part& part, bool is_tiled, double rest) {
    // Check that all attributes are there and have values that are known.
    demand(part.width && part.height && part.compression && part.bytes_per_pixel > 0, "its header lacks an attribute");
    demand(*part.width > 0 && *part.height > 0, kNoPixels);
    demand(*part.compression < std::size(kCompressions), "it is packed in an unknown way");
    demand(!is_tiled || part.tiles, "its header lacks an attribute");
    // Compare the size of the picture with what the bytes of the file can unpack to at best.
    const auto [lines, best] = kCompressions[*part.compression];
    const std::string too_short =
        too_short_for(static_cast<std::uint64_t>(*part.width), static_cast<std::uint64_t>(*part.height));
    constexpr double kLittle = 1 << 24, kSomeRows = 1 << 28;
    const double bytes_per_pixel = static_cast<double>(part.bytes_per_pixel);
    const double bytes = static_cast<double>(*part.width) * static_cast<double>(*part.height) * bytes_per_pixel;
    // Compare the memory for pixels that are decoded together: a row of tiles, or the lines of a chunk.
    // OpenImageIO allocates 256 lines for a chunk.
    constexpr int kLines = 256;
    const std::int64_t columns = is_tiled ? std::max(*part.width, part.tiles->width) : *part.width;
    const std::int64_t rows = is_tiled ? part.tiles->height : kLines;
    const double pixels = static_cast<double>(columns) * static_cast<double>(rows);
    demand(bytes <= std::max(kLittle, best * rest), too_short);
    demand(bytes_per_pixel * pixels <= std::max(kSomeRows, kLines * rest), too_short);
    return is_tiled ? tile_count(*part.tiles, *part.width, *part.height)
                    : static_cast<double>(divided_up(*part.height, lines));
}

}  // namespace

void check_exr(std::span<const std::byte> bytes) {
    // Read the magic number, the version and its flags.
    Cursor file(bytes, kHeaderBreaksOff);
    constexpr std::uint64_t kTiled = 0x200, kLongNames = 0x400, kDeep = 0x800, kParts = 0x1000;
    file.take(4);
    const std::uint64_t version = file.little(4);
    demand((version & 0xff) == 2 && (version & ~(0xff | kTiled | kLongNames | kDeep | kParts)) == 0,
           "its version is unknown");
    // Read the headers of all parts.
    std::vector<Part> parts;
    do {
        const auto part = read_header(file);
        if (!part) break;
        parts.push_back(*part);
    } while (version & kParts);
    demand(!parts.empty(), "its header lacks an attribute");
    // Check each part.
    double chunks = 0;
    for (const Part& part : parts) {
        demand(!(version & kDeep) && !part.type.starts_with("deep"), "it is not a flat picture");
        const bool is_tiled = version & kParts ? part.type == "tiledimage" : (version & kTiled) != 0;
        demand(!(version & kParts) || is_tiled || part.type == "scanlineimage", "a part is of no known kind");
        chunks += check_part(part, is_tiled, static_cast<double>(file.rest().size()));
    }
    // Check that the file can hold all chunks. Each takes at least 16 bytes: its offset in the table, its line and
    // size.
    constexpr double kLeast = 8 + 8;
    demand(kLeast * chunks <= static_cast<double>(file.rest().size()),
           "it is too short for its " + std::to_string(static_cast<std::uint64_t>(chunks)) + " chunks");
}

}  // namespace limn
