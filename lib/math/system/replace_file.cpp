#include "math/system/replace_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "limn/math/error.h"
#include "limn/math/system/files.h"

namespace limn {

namespace {

namespace fs = std::filesystem;

// The beginning and the end of the name of a temporary file.
constexpr std::string_view kBeginning = ".limn-", kEnd = ".tmp";

// Blocks the signal SIGXFSZ in the calling thread for the lifetime of this object. If a file-size limit is set, a write
// beyond it raises this signal, which kills the process. While the signal is blocked the write fails instead and can be
// reported.
class FileSizeSignalBlocked {
public:
    FileSizeSignalBlocked() {
        sigemptyset(&signal_);
        sigaddset(&signal_, SIGXFSZ);
        pthread_sigmask(SIG_BLOCK, &signal_, &before_);
    }
    ~FileSizeSignalBlocked() {
        // Consume the signal if it is pending. Otherwise it would be delivered once it is no longer blocked.
        const timespec now{};
        if (!sigismember(&before_, SIGXFSZ)) sigtimedwait(&signal_, nullptr, &now);
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

// Returns the file that `path` refers to, behind all links; the file need not exist. Checks everything that can be
// checked without writing. \throws FileError
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

// Removes the temporary files in `folder` that no process holds a lock on. Files that cannot be removed are ignored.
void remove_orphans(const std::string& folder) {
    std::error_code problem;
    for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(kBeginning) || !name.ends_with(kEnd)) continue;
        const int file = open(entry->path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
        if (file < 0) continue;
        if (flock(file, LOCK_EX | LOCK_NB) == 0) unlink(entry->path().c_str());
        close(file);
    }
}

}  // namespace

std::string system_message() { return std::generic_category().message(errno); }

bool try_lock(int descriptor) {
    return flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno == ENOLCK || errno == ENOTSUP;
}

bool is_at(int descriptor, const std::string& path) {
    struct stat open_file, named;
    return fstat(descriptor, &open_file) == 0 && stat(path.c_str(), &named) == 0 && open_file.st_ino == named.st_ino &&
           open_file.st_dev == named.st_dev;
}

FileReplacement::FileReplacement(const std::string& path) : path_(path), target_(target_of(path)) {
    const std::string folder = folder_of(target_);
    remove_orphans(folder);
    create(folder);
}

FileReplacement::~FileReplacement() {
    if (!name_.empty()) unlink(name_.c_str());
    if (descriptor_ >= 0) close(descriptor_);
}

// Creates and locks the temporary file. Until it is locked, another process may take it for an orphan and remove it;
// then the next name is tried.
void FileReplacement::create(const std::string& folder) {
    static std::atomic<unsigned> counter{0};
    const std::string beginning = folder + "/" + std::string(kBeginning) + std::to_string(getpid()) + "-";
    for (;;) {
        name_ = beginning + std::to_string(counter++) + std::string(kEnd);
        descriptor_ = open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno == EEXIST) continue;
        if (descriptor_ < 0) {
            name_.clear();
            fail("cannot be written");
        }
        if (try_lock(descriptor_) && is_at(descriptor_, name_)) return;
        close(std::exchange(descriptor_, -1));
    }
}

void FileReplacement::write(std::span<const std::byte> bytes) {
    const FileSizeSignalBlocked blocked;
    written_.add(bytes);
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("writing failed");
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void FileReplacement::commit() {
    flush();
    require_contents();
    take_the_targets_place();
}

void FileReplacement::flush() {
    const FileSizeSignalBlocked blocked;
    // EINVAL means that files of this kind cannot be flushed.
    if (fsync(descriptor_) != 0 && errno != EINVAL) fail("writing failed");
}

void FileReplacement::require_contents() {
    std::vector<std::byte> buffer(1 << 20);
    Checksum read;
    for (off_t position = 0;;) {
        const ssize_t got = pread(descriptor_, buffer.data(), buffer.size(), position);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail("reading back failed");
        if (got == 0) break;
        read.add(std::span(buffer).first(static_cast<std::size_t>(got)));
        position += got;
    }
    if (read.digest() != written_.digest())
        throw FileError(path_, "the bytes that were read back differ from those written");
}

void FileReplacement::take_the_targets_place() {
    // Take over owner and permissions of the old file.
    struct stat old;
    if (stat(target_.c_str(), &old) == 0) {
        // Only root may change the owner. Another user becomes the owner of the new file.
        [[maybe_unused]] const int may_fail = fchown(descriptor_, old.st_uid, old.st_gid);
        if (fchmod(descriptor_, old.st_mode & 07777) != 0) fail("its permissions cannot be kept");
    }
    // Put the new file in place of the old one.
    if (rename(name_.c_str(), target_.c_str()) != 0) fail("cannot be replaced");
    name_.clear();
    if (close(std::exchange(descriptor_, -1)) != 0) fail("writing failed");
    // Flush the folder, so that the new name survives a power cut. If this fails, the file is complete all the same.
    const int folder = open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    fsync(folder);
    close(folder);
}

void FileReplacement::fail(const char* what) const { throw FileError(path_, what + (": " + system_message())); }

void replace_file(const std::string& path, std::span<const std::byte> bytes) {
    FileReplacement file(path);
    file.write(bytes);
    file.commit();
}

void check_replaceable(const std::string& path) {
    FileReplacement file(path);
    file.write(std::vector<std::byte>(4096));  // the usual size of a block: fails on a disk without a free block
    file.flush();
}

std::string file_behind_links(const std::string& path) {
    constexpr int kMostLinks = 40;  // Linux follows as many in one path
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

}  // namespace limn
