#include "io/ply_source.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <iterator>

#include "limn/math/error.h"

namespace limn {

namespace {

using Words = std::vector<std::string_view>;

struct TypeName {
    std::string_view old_name, new_name;
    std::size_t size;
};
// The names and sizes of the types, in the order of PlyType.
constexpr TypeName kTypes[] = {{"char", "int8", 1},     {"uchar", "uint8", 1},   {"short", "int16", 2},
                               {"ushort", "uint16", 2}, {"int", "int32", 4},     {"uint", "uint32", 4},
                               {"float", "float32", 4}, {"double", "float64", 8}};

std::size_t size_of(PlyType type) { return kTypes[static_cast<std::size_t>(type)].size; }

// Returns the value of a number of the type with these bits.
double number_of_bits(PlyType type, std::uint64_t bits) {
    switch (type) {
        case PlyType::int8: return static_cast<std::int8_t>(bits);
        case PlyType::int16: return static_cast<std::int16_t>(bits);
        case PlyType::int32: return static_cast<std::int32_t>(bits);
        case PlyType::float32: return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        case PlyType::float64: return std::bit_cast<double>(bits);
        case PlyType::uint8:
        case PlyType::uint16:
        case PlyType::uint32: break;
    }
    return static_cast<double>(bits);
}

// Parses a word; std::nullopt if it is not a number as a whole.
template <class Number>
std::optional<Number> parse(std::string_view word) {
    Number number{};
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || stop != word.data() + word.size()) return std::nullopt;
    return number;
}

}  // namespace

// The value is clamped, because rounding to double may have raised it to 2^63, which a long long does not hold.
std::string integer_text(double value) {
    return std::to_string(static_cast<long long>(std::clamp(value, -0x1p62, 0x1p62)));
}

std::optional<std::size_t> PlyElement::find(std::initializer_list<std::string_view> names, bool is_list) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (properties[i].count_type.has_value() == is_list && is_one_of(properties[i].name, names)) return i;
    return std::nullopt;
}

PlySource::PlySource(std::string_view bytes, const std::string& path, std::vector<std::string>& warnings)
    : bytes_(bytes), path_(path), lines_(bytes, path, LineForm::plain), data_({}) {
    read_header(warnings);
    if (form_ == Form::ascii) return;
    // Find the first byte of the data. TextLines takes CR LF for one end of a line. If the lines of the header end in
    // CR alone, an LF after the last one belongs to the data.
    std::size_t begin = bytes.size() - lines_.rest().size();
    const std::size_t first_end = bytes.find_first_of("\r\n");
    const bool ends_in_cr = bytes.substr(first_end, 1) == "\r" && bytes.substr(first_end, 2) != "\r\n";
    if (ends_in_cr && bytes[begin - 1] == '\n') --begin;
    data_ = Cursor(std::as_bytes(std::span(bytes.substr(begin))));
}

void PlySource::read_header(std::vector<std::string>& warnings) {
    PassedOver passed_over;
    lines_.next();
    for (;;) {
        if (!lines_.next()) lines_.fail("the header breaks off before end_header");
        const Words words = lines_.words();
        const std::string_view key = words.empty() ? "comment" : words[0];
        if (key == "end_header") break;
        if (key == "format") {
            read_format(words);
        } else if (key == "element") {
            add_element(words);
        } else if (key == "property") {
            add_property(words);
        } else if (!is_one_of(key, {"comment", "obj_info"})) {
            passed_over.add(lines_.number());
        }
    }
    if (!form_) lines_.fail("the header does not say the format");
    if (passed_over.count > 0) warnings.push_back(passed_over.warning());
}

void PlySource::read_format(const Words& words) {
    if (words.size() < 3) lines_.fail("format needs a name and a version");
    constexpr std::string_view kForms[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const auto found = std::find(std::begin(kForms), std::end(kForms), words[1]);
    if (found == std::end(kForms)) lines_.fail(in_quotes(words[1]) + " is no format of a PLY");
    if (words[2] != "1.0") lines_.fail("version " + shortened(words[2]) + " cannot be read, only 1.0");
    form_ = static_cast<Form>(found - std::begin(kForms));
}

void PlySource::add_element(const Words& words) {
    if (words.size() < 3) lines_.fail("element needs a name and a number");
    const std::optional<std::uint64_t> count = parse<std::uint64_t>(words[2]);
    if (!count) lines_.fail(in_quotes(words[2]) + " is not a number of elements");
    if (*count > bytes_.size()) lines_.fail("the file is too short for " + shortened(words[2]) + " elements");
    for (const PlyElement& element : elements_)
        if (element.name == words[1]) lines_.fail("a second element " + in_quotes(words[1]));
    elements_.push_back({std::string(words[1]), *count});
}

void PlySource::add_property(const Words& words) {
    if (elements_.empty()) lines_.fail("a property before any element");
    const bool is_list = words.size() > 1 && words[1] == "list";
    if (words.size() < (is_list ? 5 : 3)) lines_.fail("property needs a type and a name");
    PlyProperty property{std::string(words[is_list ? 4 : 2]), type_of(words[is_list ? 3 : 1])};
    if (is_list) property.count_type = type_of(words[2]);
    if (is_list && !is_integer(*property.count_type)) lines_.fail("the length of a list must be an integer");
    elements_.back().properties.push_back(property);
}

PlyType PlySource::type_of(std::string_view word) const {
    for (std::size_t i = 0; i < std::size(kTypes); ++i)
        if (word == kTypes[i].old_name || word == kTypes[i].new_name) return static_cast<PlyType>(i);
    lines_.fail(in_quotes(word) + " is no type of a PLY");
}

void PlySource::fail(const std::string& problem) const {
    if (form_ == Form::ascii) lines_.fail(problem);
    throw FileError(path_, "byte " + std::to_string(bytes_.size() - data_.rest().size()) + ": " + problem);
}

void PlySource::read_row(const PlyElement& element, std::optional<std::size_t> wanted, std::vector<double>& values,
                         std::vector<double>& list) {
    values.assign(element.properties.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (!property.count_type) {
            values[i] = value(property.type);
            continue;
        }
        const double count = value(*property.count_type);
        const std::size_t least = form_ == Form::ascii ? 1 : size_of(property.type);
        if (!(count >= 0) || count * static_cast<double>(least) > static_cast<double>(rest_size()))
            fail("a list of " + integer_text(count) + " numbers does not fit into the file");
        if (i == wanted) list.clear();
        for (double k = 0; k < count; ++k) {
            const double number = value(property.type);
            if (i == wanted) list.push_back(number);
        }
    }
}

void PlySource::warn_of_rest(std::vector<std::string>& warnings) const {
    const std::string behind = " behind the last element that the header states were passed over";
    if (form_ != Form::ascii && !data_.rest().empty())
        warnings.push_back(path_ + ": " + std::to_string(data_.rest().size()) + " bytes" + behind);
    const bool has_words = !words_.empty() || lines_.rest().find_first_not_of(" \t\r\n") != std::string_view::npos;
    if (form_ == Form::ascii && has_words) warnings.push_back(path_ + ": words" + behind);
}

std::size_t PlySource::rest_size() const {
    if (form_ != Form::ascii) return data_.rest().size();
    return lines_.rest().size() + words_.size();
}

double PlySource::value(PlyType type) {
    if (form_ == Form::ascii) return value_of_word(type);
    const std::size_t size = size_of(type);
    if (size > data_.rest().size()) fail("the file breaks off");
    return number_of_bits(type, form_ == Form::big ? data_.big(size) : data_.little(size));
}

double PlySource::value_of_word(PlyType type) {
    while (words_.empty()) {
        if (!lines_.next()) lines_.fail("the file breaks off");
        words_ = lines_.words();
        std::reverse(words_.begin(), words_.end());
    }
    const std::string_view word = words_.back();
    words_.pop_back();
    if (is_integer(type)) {
        const auto number = parse<std::int64_t>(word);
        if (!number) lines_.fail(in_quotes(word) + " is not an integer");
        return static_cast<double>(*number);
    }
    if (const auto number = parse_float(word)) return double{*number};
    // Accept a value that is too large for float32, infinite or NaN. It is an error only if the value is used.
    const auto number = parse<double>(word);
    if (!number) lines_.fail(in_quotes(word) + " is not a number");
    return *number;
}

}  // namespace limn
