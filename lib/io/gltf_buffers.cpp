#include "io/gltf_buffers.h"

#include <algorithm>
#include <bit>
#include <filesystem>

#include "io/bytes.h"
#include "io/text_lines.h"
#include "math/system/read_file.h"

namespace limn {

namespace {

// The component types of accessors (glTF 2.0, 3.6.2.2). Their numbers are those of OpenGL.
enum Component : std::uint64_t { kInt8 = 5120, kUint8, kInt16, kUint16, kUint32 = 5125, kFloat };

// Returns the size of a component in bytes, or 0 if the type is unknown.
std::size_t size_of(std::uint64_t type) {
    switch (type) {
        case kInt8:
        case kUint8: return 1;
        case kInt16:
        case kUint16: return 2;
        case kUint32:
        case kFloat: return 4;
        default: return 0;
    }
}

bool is_unsigned(std::uint64_t type) { return type == kUint8 || type == kUint16 || type == kUint32; }

// Returns the value of a base64 digit, or -1.
int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

// Returns the value of a hexadecimal digit, or -1.
int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = static_cast<char>(c | 32);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

// The values of an accessor without a buffer view are zero. This is the largest number of zeros that all accessors of a
// file may make up together.
constexpr std::uint64_t kMostZeros = std::uint64_t{1} << 22;

}  // namespace

// A URI may encode a character as % and two hexadecimal digits (RFC 3986, 2.1).
std::string gltf_path_beside(const std::string& file, const std::string& uri) {
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool is_coded =
            uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0;
        const int code = is_coded ? 16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2]) : 0;
        name += code > 0 ? static_cast<char>(code) : uri[i];  // %00 is not decoded: it would end the name
        if (code > 0) i += 2;
    }
    return (std::filesystem::path(file).parent_path() / name).string();
}

std::string GltfBuffers::decode_data(const GltfValue& uri) {
    // Find the data: they begin after the comma and may be padded with "=".
    const std::string text = uri.text_or("");
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64"))
        uri.fail("its data are not in base64");
    std::string bytes;
    unsigned bits = 0, count = 0;
    const std::size_t end = std::min(text.find('=', comma), text.size());
    if (text.find_first_not_of('=', end) != std::string::npos) uri.fail("has characters behind the end of its base64");
    // Collect six bits a digit, and append a byte whenever there are eight.
    for (std::size_t i = comma + 1; i < end; ++i) {
        const int digit = base64_digit(text[i]);
        if (digit < 0) uri.fail("character " + std::to_string(i) + " is none of base64");
        bits = bits << 6 | static_cast<unsigned>(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 255);
    }
    return bytes;
}

std::string GltfBuffers::read(const GltfValue& buffer) {
    const GltfValue uri = buffer["uri"];
    const std::string text = uri.text_or("");
    if (text.starts_with("data:")) return decode_data(uri);
    const std::string path = gltf_path_beside(path_, text);
    model_.files.push_back(path);
    try {
        return read_file(path);
    } catch (const FileError& error) {
        uri.fail(error.what());
    }
}

std::span<const std::byte> GltfBuffers::buffer(const GltfValue& number) {
    const GltfValue buffer = number.in(document_["buffers"]);
    const std::uint64_t size = buffer["byteLength"].natural();
    std::span<const std::byte> bytes = chunk_;
    if (buffer["uri"].exists()) {
        auto place = buffers_.find(number.natural());
        if (place == buffers_.end()) place = buffers_.emplace(number.natural(), read(buffer)).first;
        bytes = std::as_bytes(std::span(place->second));
    } else if (number.natural() != 0 || chunk_.empty()) {
        buffer.fail("has no uri, and the file has no binary part for it");
    }
    if (size > bytes.size())
        buffer.fail("states " + std::to_string(size) + " bytes, but there are " + std::to_string(bytes.size()));
    return bytes.first(size);
}

std::span<const std::byte> GltfBuffers::view(const GltfValue& number) {
    const GltfValue view = number.in(document_["bufferViews"]);
    const std::span<const std::byte> bytes = buffer(view["buffer"]);
    const std::uint64_t offset = view["byteOffset"].natural_or(0), size = view["byteLength"].natural();
    if (offset > bytes.size() || size > bytes.size() - offset)
        view.fail("reaches to byte " + std::to_string(offset + size) + " of " + std::to_string(bytes.size()));
    return bytes.subspan(offset, size);
}

double GltfBuffers::Elements::at(std::size_t element, std::size_t component) const {
    if (bytes.empty()) return 0;
    const std::size_t size = size_of(type);
    const std::uint64_t bits = little_endian(bytes, element * stride + component * size, size);
    const auto scaled = [this](double value, double largest) {
        return is_normalized ? std::max(value / largest, -1.0) : value;
    };
    switch (type) {
        case kInt8: return scaled(static_cast<std::int8_t>(bits), 127);
        case kUint8: return scaled(static_cast<double>(bits), 255);
        case kInt16: return scaled(static_cast<std::int16_t>(bits), 32767);
        case kUint16: return scaled(static_cast<double>(bits), 65535);
        case kFloat: return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        default: return static_cast<double>(bits);
    }
}

// Returns `e` with the location of its elements in a buffer view. `holder` names the view: it is an accessor, or the
// `indices` or `values` of a sparse one. Throws if the elements are not all inside the view. \pre e.count > 0
GltfBuffers::Elements GltfBuffers::elements_in(const GltfValue& holder, Elements e) {
    const std::size_t size = e.components * size_of(e.type);
    if (size == 0) holder["componentType"].fail("is no known type");
    const GltfValue view = holder["bufferView"];
    const std::span<const std::byte> bytes = this->view(view);
    const std::uint64_t offset = holder["byteOffset"].natural_or(0);
    const GltfValue described = view.in(document_["bufferViews"]), stride = described["byteStride"];
    e.stride = stride.natural_or(size);
    if (stride.exists() && (e.stride < std::max<std::size_t>(size, 4) || e.stride > 252 || e.stride % 4 != 0))
        described.fail("byteStride is no multiple of 4, from the " + std::to_string(size) +
                       " bytes of an element to 252");
    const std::uint64_t end = offset + (std::uint64_t{e.count} - 1) * e.stride + size;
    if (end > bytes.size())
        holder.fail("reaches to byte " + std::to_string(end) + " of its view, which has " +
                    std::to_string(bytes.size()));
    e.bytes = bytes.subspan(offset);
    return e;
}

// Returns the elements of an accessor without its sparse part.
GltfBuffers::Elements GltfBuffers::elements(const GltfValue& accessor, std::size_t components) {
    Elements e;
    e.components = components;
    e.count = accessor["count"].natural();
    e.type = accessor["componentType"].natural();
    e.is_normalized = accessor["normalized"].flag();
    if (e.count == 0) accessor["count"].fail("is 0");
    if (accessor["bufferView"].exists()) return elements_in(accessor, e);
    if (size_of(e.type) == 0) accessor["componentType"].fail("is no known type");
    if (e.count > (kMostZeros - zeros_) / components) accessor["count"].fail("is larger than all that the file holds");
    zeros_ += e.count * components;
    return e;
}

// Returns all values of an accessor, one element after the other, with the sparse part applied.
std::vector<double> GltfBuffers::values(const GltfValue& accessor, std::size_t components) {
    // Read the dense values.
    const Elements dense = elements(accessor, components);
    std::vector<double> values;
    values.reserve(dense.count * components);
    for (std::size_t i = 0; i < dense.count * components; ++i)
        values.push_back(dense.at(i / components, i % components));
    const GltfValue sparse = accessor["sparse"];
    if (!sparse.exists()) return values;
    // Find the indices and the values of the elements that the sparse part replaces.
    Elements places;
    places.count = sparse["count"].natural();
    if (places.count == 0) return values;
    places.components = 1;
    places.type = sparse["indices"]["componentType"].natural();
    if (!is_unsigned(places.type)) sparse["indices"]["componentType"].fail("is no type of unsigned integers");
    places = elements_in(sparse["indices"], places);
    Elements replaced = dense;
    replaced.count = places.count;
    replaced = elements_in(sparse["values"], replaced);
    // Replace these elements. Their indices must be strictly increasing.
    double last = -1;
    for (std::size_t i = 0; i < places.count; ++i) {
        const double place = places.at(i, 0);
        if (place <= last) sparse["indices"].fail("element " + std::to_string(i) + " is not above the one before");
        last = place;
        if (!(place < static_cast<double>(dense.count)))
            sparse["indices"].fail("element " + std::to_string(i) + " is beyond the " + std::to_string(dense.count) +
                                   " of the accessor");
        for (std::size_t c = 0; c < components; ++c)
            values[static_cast<std::size_t>(place) * components + c] = replaced.at(i, c);
    }
    return values;
}

const std::vector<float>& GltfBuffers::floats(const GltfValue& number, const std::string& type) {
    const GltfValue accessor = number.in(document_["accessors"]);
    if (accessor["type"].text_or("") != type)
        accessor["type"].fail("is not " + type + ", which " + number.place() + " needs");
    if (accessor["componentType"].natural() == kUint32)
        accessor["componentType"].fail("is that of indices alone, which " + number.place() + " are not");
    const auto [place, is_new] = accessors_.try_emplace(accessor.place());
    if (is_new)
        for (const double value : values(accessor, static_cast<std::size_t>(type.back() - '0')))
            place->second.push_back(static_cast<float>(value));
    return place->second;
}

std::vector<std::uint32_t> GltfBuffers::indices(const GltfValue& number) {
    const GltfValue accessor = number.in(document_["accessors"]);
    if (accessor["type"].text_or("") != "SCALAR" || !is_unsigned(accessor["componentType"].natural()) ||
        accessor["normalized"].flag())
        accessor.fail("its values are not the unsigned integers that " + number.place() + " needs");
    std::vector<std::uint32_t> indices;
    for (const double value : values(accessor, 1)) indices.push_back(static_cast<std::uint32_t>(value));
    return indices;
}

}  // namespace limn
