#include "ray_reader.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>

#include "limn/math/error.h"

namespace limn::app {

namespace {

// The size of the buffer in bytes. It is large enough that reading takes far less time than tracing the rays, and small
// enough for the processor's cache.
constexpr std::size_t kBlock = std::size_t{1} << 20;
// The longest line in bytes. Eight numbers with all their digits, about 800 each at most, are far shorter. It must be
// less than kBlock.
constexpr std::size_t kLongestLine = std::size_t{1} << 16;

constexpr std::size_t kNumbers = 8;
constexpr std::size_t kBinaryRay = kNumbers * sizeof(double);
using Numbers = std::array<double, kNumbers>;

Ray to_ray(const Numbers& n) {
    return {.origin = {n[0], n[1], n[2]}, .direction = {n[3], n[4], n[5]}, .t_min = n[6], .t_max = n[7]};
}

double from_little_endian(const char* bytes) {
    std::uint64_t bits = 0;
    for (std::size_t i = sizeof bits; i-- > 0;) bits = bits << 8 | static_cast<unsigned char>(bytes[i]);
    return std::bit_cast<double>(bits);
}

std::string system_message() { return std::generic_category().message(errno); }

// Removes the first word and the blanks before it from `rest`, and returns the word. It is empty if there is none.
std::string_view next_word(std::string_view& rest) {
    constexpr const char* kBlanks = " \t\r";
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(kBlanks));
    rest.remove_prefix(word.size());
    return word;
}

// Returns a word for a message: in quotes, without control characters, and shortened. The input may be binary.
std::string quoted(std::string_view word) {
    constexpr std::size_t kEnough = 40;
    std::string text(word.substr(0, kEnough));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
    return "'" + text + (word.size() > kEnough ? "...'" : "'");
}

// Reads a number. Returns what is wrong with the word, or an empty string.
std::string read_number(std::string_view word, double& value) {
    // from_chars does not accept a plus sign. Skip it, but not in "+-".
    const bool plus = word.starts_with('+') && !word.starts_with("+-");
    const char* const last = word.data() + word.size();
    const auto [end, problem] = std::from_chars(word.data() + (plus ? 1 : 0), last, value);
    if (problem == std::errc::result_out_of_range && end == last)
        return quoted(word) + " is beyond the range of float64";
    if (problem != std::errc{} || end != last) return quoted(word) + " is not a number";
    return {};
}

// Appends the ray of a line, if it has one, to `rays`. Returns what is wrong with the line, or an empty string.
std::string read_line(std::string_view line, std::vector<Ray>& rays) {
    if (line.size() > kLongestLine) return "the line is longer than " + std::to_string(kLongestLine) + " bytes";
    Numbers numbers{0, 0, 0, 0, 0, 0, 0, kInfinity};
    std::size_t count = 0;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line), ++count) {
        if (count == 0 && word.starts_with('#')) return {};
        if (count == kNumbers) return "there are more than 8 numbers";
        if (std::string problem = read_number(word, numbers[count]); !problem.empty()) return problem;
    }
    if (count == 0) return {};
    if (count != 6 && count != kNumbers) return "a ray has 6 or 8 numbers, not " + std::to_string(count);
    rays.push_back(to_ray(numbers));
    return {};
}

}  // namespace

RayReader::RayReader(const std::string& path, bool binary)
    : name_(path == "-" ? "standard input" : path), binary_(binary), buffer_(kBlock) {
    file_ = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status = {};
    if (file_ < 0 || ::fstat(file_, &status) != 0) throw FileError(name_, system_message());
    if (S_ISDIR(status.st_mode)) throw FileError(name_, "is a folder, not a file");
    if (S_ISREG(status.st_mode)) file_size_ = static_cast<std::uint64_t>(status.st_size);
}

RayReader::~RayReader() {
    if (file_ != STDIN_FILENO) ::close(file_);
}

std::span<const Ray> RayReader::next() {
    rays_.clear();
    take();
    while (rays_.empty() && !ended_) {
        fill();
        take();
    }
    return rays_;
}

std::optional<double> RayReader::fraction() const {
    if (file_size_ == 0) return std::nullopt;
    return std::min(1.0, static_cast<double>(bytes_read_) / static_cast<double>(file_size_));
}

void RayReader::fill() {
    // Move what is not parsed yet to the beginning of the buffer.
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    // Append what can be read.
    ssize_t count;
    do count = ::read(file_, buffer_.data() + end_, buffer_.size() - end_);
    while (count < 0 && errno == EINTR);
    if (count < 0) throw FileError(name_, system_message());
    ended_ = count == 0;
    end_ += static_cast<std::size_t>(count);
    bytes_read_ += static_cast<std::uint64_t>(count);
}

void RayReader::take() {
    if (binary_)
        take_binary();
    else
        take_lines();
}

// If a line is invalid and there are rays before it, these are returned first. The line is read again in the next call,
// which throws.
void RayReader::take_lines() {
    while (begin_ != end_) {
        const std::string_view rest = waiting();
        const std::string_view line = rest.substr(0, rest.find('\n'));
        const bool is_whole = line.size() < rest.size() || ended_;
        if (!is_whole && line.size() <= kLongestLine) return;
        if (const std::string problem = read_line(line, rays_); !problem.empty()) {
            if (!rays_.empty()) return;
            throw FileError(name_ + ":" + std::to_string(line_), problem);
        }
        begin_ += std::min(line.size() + 1, rest.size());
        ++line_;
    }
}

void RayReader::take_binary() {
    for (; end_ - begin_ >= kBinaryRay; begin_ += kBinaryRay) {
        Numbers numbers;
        for (std::size_t i = 0; i < kNumbers; ++i)
            numbers[i] = from_little_endian(&buffer_[begin_ + i * sizeof(double)]);
        rays_.push_back(to_ray(numbers));
    }
    if (ended_ && begin_ != end_)
        throw FileError(name_, "ends within a ray: " + std::to_string(bytes_read_) + " bytes are not a multiple of " +
                                   std::to_string(kBinaryRay));
}

}  // namespace limn::app
