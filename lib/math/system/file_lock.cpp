#include "limn/math/system/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "limn/math/error.h"
#include "limn/math/system/files.h"
#include "math/system/replace_file.h"

namespace limn {

FileLock::FileLock(const std::string& path) : name_(file_behind_links(path) + ".lock") {
    for (;;) {
        descriptor_ = open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0) throw FileError(path, "cannot be locked: " + system_message());
        const bool locked = try_lock(descriptor_);
        // The process that held the lock may have deleted the file after this one opened it. A lock on a deleted file
        // is useless: try again.
        if (locked && is_at(descriptor_, name_)) return;
        close(descriptor_);
        if (!locked) throw FileError(path, "is being written by another process");
    }
}

FileLock::~FileLock() {
    unlink(name_.c_str());
    close(descriptor_);
}

}  // namespace limn
