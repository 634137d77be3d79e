#include "io/exr_header.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "io/picture_bytes.h"

namespace limn {

namespace {

// Thrown and caught in this file.
struct Fault {
    std::string text;
};

void require(bool holds, std::string fault) {
    if (!holds) throw Fault{std::move(fault)};
}

constexpr const char* kBreaksOff = "its header breaks off";
constexpr const char* kWrongSize = "an attribute has the wrong size";

// Steps through bytes.
class Cursor {
public:
    explicit Cursor(std::span<const std::byte> bytes) : rest_(bytes) {}
    std::size_t left() const { return rest_.size(); }

    std::span<const std::byte> take(std::size_t size) {
        require(size <= rest_.size(), kBreaksOff);
        const std::span<const std::byte> taken = rest_.first(size);
        rest_ = rest_.subspan(size);
        return taken;
    }
    std::uint64_t number(std::size_t bytes) { return little_endian(take(bytes), 0, bytes); }
    std::int64_t integer() { return static_cast<std::int32_t>(number(4)); }
    // Up to a zero byte.
    std::string text() {
        constexpr std::size_t kLongest = 255;  // of a name
        const auto end = std::find(rest_.begin(), rest_.end(), std::byte{0});
        const std::size_t size = static_cast<std::size_t>(end - rest_.begin());
        require(end != rest_.end() && size <= kLongest, "a name in its header is too long");
        const auto bytes = take(size + 1);
        return {reinterpret_cast<const char*>(bytes.data()), size};
    }

private:
    std::span<const std::byte> rest_;
};

struct Tiles {
    std::int64_t width, height;
    int levels;  // 0 one, 1 smaller and smaller, 2 in x and y apart
    bool round_up;
};

// What decides how much memory a part takes.
struct Part {
    std::optional<std::int64_t> width, height;
    std::optional<std::size_t> compression;
    std::optional<Tiles> tiles;
    std::int64_t bytes_per_pixel = 0;  // of all channels
    std::string type;
};

struct Compression {
    std::int64_t lines;  // in a chunk
    double best;         // so many bytes from one: runs of 127 in two, deflate 1032, half of 4 x 4 pixels in 3 or 14
};
constexpr Compression kCompressions[] = {{1, 1},     {1, 64}, {1, 1032}, {16, 1032},  {32, 5000},
                                         {16, 1400}, {32, 3}, {32, 11},  {32, 66000}, {256, 66000}};

// Attributes of one size (OpenEXR File Layout, "Predefined Attribute Types"). OpenEXR reads so many bytes of them,
// whatever the header says.
constexpr std::pair<std::string_view, std::size_t> kSizes[] = {{"box2f", 16},
                                                               {"box2i", 16},
                                                               {"chromaticities", 32},
                                                               {"compression", 1},
                                                               {"deepImageState", 1},
                                                               {"double", 8},
                                                               {"envmap", 1},
                                                               {"float", 4},
                                                               {"int", 4},
                                                               {"keycode", 28},
                                                               {"lineOrder", 1},
                                                               {"m33d", 72},
                                                               {"m33f", 36},
                                                               {"m44d", 128},
                                                               {"m44f", 64},
                                                               {"rational", 8},
                                                               {"tiledesc", 9},
                                                               {"timecode", 8},
                                                               {"v2d", 16},
                                                               {"v2f", 8},
                                                               {"v2i", 8},
                                                               {"v3d", 24},
                                                               {"v3f", 12},
                                                               {"v3i", 12}};

// Returns how many bytes all of them take for a pixel.
std::int64_t read_channels(Cursor value) {
    std::int64_t bytes = 0;
    while (!value.text().empty()) {
        const std::int64_t type = value.integer();
        require(type >= 0 && type <= 2, "a channel is of no known kind");
        bytes += type == 1 ? 2 : 4;
        value.take(4);  // whether it is perceptually linear
        require(value.integer() == 1 && value.integer() == 1,
                "a channel is not there for every pixel, which is not read");
    }
    require(value.left() == 0, kWrongSize);
    return bytes;
}

// Sizes within values of the types that hold any.
void check_value(const std::string& type, Cursor value) {
    for (const auto& [name, size] : kSizes) require(type != name || value.left() == size, kWrongSize);
    if (type == "preview") {
        const std::uint64_t width = value.number(4), height = value.number(4);
        require(width * height <= value.left() && width * height * 4 == value.left(), kWrongSize);
    } else if (type == "stringvector") {
        while (value.left() > 0) value.take(value.number(4));
    } else if (type == "floatvector") {
        require(value.left() % 4 == 0, kWrongSize);
    } else if (type == "idmanifest") {
        const std::uint64_t unpacked = value.number(4);
        require(unpacked <= 1032 * value.left(), kWrongSize);
    }
}

void read_attribute(const std::string& name, const std::string& type, Cursor value, Part& part) {
    if (name == "dataWindow" && type == "box2i") {
        const std::int64_t left = value.integer(), top = value.integer();
        part.width = value.integer() - left + 1;
        part.height = value.integer() - top + 1;
    } else if (name == "compression" && type == "compression") {
        part.compression = value.number(1);
    } else if (name == "channels" && type == "chlist") {
        part.bytes_per_pixel = read_channels(value);
    } else if (name == "type" && type == "string") {
        const auto bytes = value.take(value.left());
        part.type.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    } else if (name == "tiles" && type == "tiledesc") {
        const auto width = static_cast<std::int64_t>(value.number(4)),
                   height = static_cast<std::int64_t>(value.number(4));
        const std::uint64_t mode = value.number(1);
        part.tiles = Tiles{width, height, static_cast<int>(mode & 15), mode >> 4 == 1};
        require(width > 0 && height > 0 && part.tiles->levels <= 2 && mode >> 4 <= 1, "its tiles are of no known kind");
    }
}

// Attributes up to an empty name; none if there is no attribute, which ends the headers of several parts.
std::optional<Part> read_header(Cursor& file) {
    Part part;
    std::set<std::string> names;
    for (std::string name; !(name = file.text()).empty();) {
        require(names.insert(name).second, "an attribute stands there twice");
        const std::string type = file.text();
        const std::int64_t size = file.integer();
        require(size >= 0 && static_cast<std::uint64_t>(size) <= file.left(), "an attribute is larger than the file");
        const Cursor value(file.take(static_cast<std::size_t>(size)));
        check_value(type, value);
        read_attribute(name, type, value, part);
    }
    if (names.empty()) return std::nullopt;
    return part;
}

std::int64_t divided_up(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

// The sizes along one side of a picture's levels, from the whole down to 1.
std::vector<std::int64_t> level_sizes(std::int64_t size, bool round_up) {
    std::vector<std::int64_t> sizes{size};
    while (sizes.back() > 1) sizes.push_back((sizes.back() + (round_up ? 1 : 0)) / 2);
    return sizes;
}

double tile_count(const Tiles& tiles, std::int64_t width, std::int64_t height) {
    const auto along = [](std::int64_t size, std::int64_t tile) { return static_cast<double>(divided_up(size, tile)); };
    if (tiles.levels == 0) return along(width, tiles.width) * along(height, tiles.height);
    const std::vector<std::int64_t> widths = level_sizes(width, tiles.round_up);
    const std::vector<std::int64_t> heights = level_sizes(height, tiles.round_up);
    double count = 0;
    if (tiles.levels == 1) {
        for (std::size_t i = 0; i < std::max(widths.size(), heights.size()); ++i)
            count += along(i < widths.size() ? widths[i] : 1, tiles.width) *
                     along(i < heights.size() ? heights[i] : 1, tiles.height);
    } else {
        for (const std::int64_t w : widths)
            for (const std::int64_t h : heights) count += along(w, tiles.width) * along(h, tiles.height);
    }
    return count;
}

// Returns the number of chunks; `rest` is how many bytes follow the headers.
double check_part(const Part& part, bool is_tiled, double rest) {
    require(part.width && part.height && part.compression && part.bytes_per_pixel > 0, "its header lacks an attribute");
    require(*part.width > 0 && *part.height > 0, "it has no pixels");
    require(*part.compression < std::size(kCompressions), "it is packed in an unknown way");
    require(!is_tiled || part.tiles, "its header lacks an attribute");
    const auto [lines, best] = kCompressions[*part.compression];
    const std::string too_short =
        too_short_for(static_cast<std::uint64_t>(*part.width), static_cast<std::uint64_t>(*part.height));
    constexpr double kLittle = 1 << 24, kSomeRows = 1 << 28;
    const double bytes_per_pixel = static_cast<double>(part.bytes_per_pixel);
    const double bytes = static_cast<double>(*part.width) * static_cast<double>(*part.height) * bytes_per_pixel;
    // Decoded together: a row of tiles, or the lines of a chunk, for which OpenImageIO takes 256 times the memory of
    // one.
    constexpr int kLines = 256;
    const std::int64_t columns = is_tiled ? std::max(*part.width, part.tiles->width) : *part.width;
    const std::int64_t rows = is_tiled ? part.tiles->height : kLines;
    const double pixels = static_cast<double>(columns) * static_cast<double>(rows);
    require(bytes <= std::max(kLittle, best * rest), too_short);
    require(bytes_per_pixel * pixels <= std::max(kSomeRows, kLines * rest), too_short);
    return is_tiled ? tile_count(*part.tiles, *part.width, *part.height)
                    : static_cast<double>(divided_up(*part.height, lines));
}

void check(Cursor file) {
    constexpr std::uint64_t kTiled = 0x200, kLongNames = 0x400, kDeep = 0x800, kParts = 0x1000;
    file.take(4);
    const std::uint64_t version = file.number(4);
    require((version & 0xff) == 2 && (version & ~(0xff | kTiled | kLongNames | kDeep | kParts)) == 0,
            "its version is unknown");
    std::vector<Part> parts;
    do {
        const auto part = read_header(file);
        if (!part) break;
        parts.push_back(*part);
    } while (version & kParts);
    require(!parts.empty(), "its header lacks an attribute");
    double chunks = 0;
    for (const Part& part : parts) {
        require(!(version & kDeep) && !part.type.starts_with("deep"), "it is not a flat picture");
        const bool is_tiled = version & kParts ? part.type == "tiledimage" : (version & kTiled) != 0;
        require(!(version & kParts) || is_tiled || part.type == "scanlineimage", "a part is of no known kind");
        chunks += check_part(part, is_tiled, static_cast<double>(file.left()));
    }
    constexpr double kLeast = 8 + 8;  // bytes of a chunk: its place in the table; its line and size
    require(kLeast * chunks <= static_cast<double>(file.left()),
            "it is too short for its " + std::to_string(static_cast<std::uint64_t>(chunks)) + " chunks");
}

}  // namespace

std::string exr_fault(std::span<const std::byte> file) try {
    check(Cursor(file));
    return "";
} catch (const Fault& fault) {
    return fault.text;
}

}  // namespace limn
