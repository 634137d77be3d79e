#include "io/replace_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "io/read_file.h"
#include "limn/core/error.h"
#include "limn/io/files.h"

namespace limn {

namespace {

namespace fs = std::filesystem;

// Where a file-size limit is set, the system kills the process that writes beyond it, unless it blocks the signal;
// then the write fails and can be reported.
class FileSizeSignalBlocked {
public:
    FileSizeSignalBlocked() {
        sigemptyset(&signal_);
        sigaddset(&signal_, SIGXFSZ);
        pthread_sigmask(SIG_BLOCK, &signal_, &before_);
    }
    ~FileSizeSignalBlocked() {
        const timespec now{};
        if (!sigismember(&before_, SIGXFSZ)) sigtimedwait(&signal_, nullptr, &now);  // takes it back if it is pending
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    FileSizeSignalBlocked(const FileSizeSignalBlocked&) = delete;
    FileSizeSignalBlocked& operator=(const FileSizeSignalBlocked&) = delete;

private:
    sigset_t signal_, before_;
};

std::string folder_of(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    return folder.empty() ? "." : folder.string();
}

// The file that stands, or will stand, at `path`. Checks all that needs no writing.
std::string target_of(const std::string& path) {
    if (path.empty()) throw FileError("''", "is not the name of a file");
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) throw FileError(path, "is a folder, not a file");
    if (fs::exists(status) && !fs::is_regular_file(status)) throw FileError(path, "is not a regular file");
    if (fs::exists(status) && access(path.c_str(), W_OK) != 0)
        throw FileError(path, "cannot be written: " + system_message());
    const std::string target = file_behind_links(path), folder = folder_of(target);
    if (!fs::exists(folder, error)) throw FileError(path, "there is no folder " + folder);
    if (!fs::is_directory(folder, error)) throw FileError(path, folder + " is not a folder");
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        throw FileError(path, "the folder " + folder + " cannot be written: " + system_message());
    return target;
}

// A file beside `target` that is removed unless it takes the target's place.
class TemporaryFile {
public:
    // `path` is the user's name of the target, for messages.
    TemporaryFile(const std::string& path, const std::string& target) : path_(path), target_(target) {
        static std::atomic<unsigned> counter{0};
        const std::string beginning = folder_of(target) + "/.limn-" + std::to_string(getpid()) + "-";
        do {
            name_ = beginning + std::to_string(counter++) + ".tmp";
            descriptor_ = open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        } while (descriptor_ < 0 && errno == EEXIST);
        if (descriptor_ < 0) fail("cannot be written");
    }
    ~TemporaryFile() {
        if (descriptor_ >= 0) close(descriptor_);
        if (!name_.empty()) unlink(name_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    void write(std::span<const std::byte> bytes) {
        const FileSizeSignalBlocked blocked;
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail("writing failed");
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
        if (fsync(descriptor_) != 0 && errno != EINVAL) fail("writing failed");  // EINVAL: no such service here
    }

    void require_contents(std::span<const std::byte> bytes) const {
        std::vector<std::byte> buffer(1 << 20);
        std::size_t position = 0;
        for (;;) {
            const ssize_t got = pread(descriptor_, buffer.data(), buffer.size(), static_cast<off_t>(position));
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) fail("reading back failed");
            if (got == 0) break;
            const std::size_t count = static_cast<std::size_t>(got);
            if (count > bytes.size() - position || std::memcmp(buffer.data(), &bytes[position], count) != 0) break;
            position += count;
        }
        if (position != bytes.size()) throw FileError(path_, "what was written does not read back");
    }

    void take_the_targets_place() {
        struct stat old;
        if (stat(target_.c_str(), &old) == 0) {
            // Only root can; for others the file becomes theirs.
            [[maybe_unused]] const int may_fail = fchown(descriptor_, old.st_uid, old.st_gid);
            if (fchmod(descriptor_, old.st_mode & 07777) != 0) fail("its permissions cannot be kept");
        }
        if (close(std::exchange(descriptor_, -1)) != 0) fail("writing failed");
        if (rename(name_.c_str(), target_.c_str()) != 0) fail("cannot be replaced");
        name_.clear();
        // The file is whole either way; this makes its new name last through a power cut.
        const int folder = open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (folder < 0) return;
        fsync(folder);
        close(folder);
    }

private:
    [[noreturn]] void fail(const char* what) const { throw FileError(path_, what + (": " + system_message())); }

    std::string path_, target_, name_;
    int descriptor_ = -1;
};

}  // namespace

void replace_file(const std::string& path, std::span<const std::byte> bytes) {
    TemporaryFile file(path, target_of(path));
    file.write(bytes);
    file.require_contents(bytes);
    file.take_the_targets_place();
}

std::string file_behind_links(const std::string& path) {
    constexpr int kMostLinks = 40;  // that Linux follows
    std::error_code problem;
    fs::path file = fs::absolute(path, problem);
    for (int links = 0; fs::is_symlink(file, problem); ++links) {
        if (links == kMostLinks) throw FileError(path, "is a link that leads in a circle");
        file = file.parent_path() / fs::read_symlink(file, problem);
    }
    const fs::path plain = fs::weakly_canonical(file, problem);
    return (problem ? file : plain).string();
}

void save_text(std::string_view text, const std::string& path) { replace_file(path, std::as_bytes(std::span(text))); }

void check_text_writable(const std::string& path) { check_replaceable(path); }

void check_replaceable(const std::string& path) {
    TemporaryFile file(path, target_of(path));
    file.write(std::vector<std::byte>(4096));  // the usual block: fails on a disk without a free one
}

}  // namespace limn
