// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/checksum.h"

namespace limn {

// The message of the system's last error.
std::string system_message();

// Takes the lock of an open file, which ends with the process. False if another process has it; file systems without
// locks give it to everybody.
bool try_lock(int descriptor);
// Whether the open file still has the name that it was opened by.
bool is_at(int descriptor, const std::string& path);

// A temporary file beside `path` that takes the place of what stands there once it is complete: until then, and if that
// never happens, everything is as it was. A file that was there keeps its permissions; a link is followed. What killed
// processes left behind in the folder is removed.
class FileReplacement {
public:
    // \throws FileError, as do the others
    explicit FileReplacement(const std::string& path);
    ~FileReplacement();
    FileReplacement(const FileReplacement&) = delete;
    FileReplacement& operator=(const FileReplacement&) = delete;

    void write(std::span<const std::byte> bytes);
    void flush();  // to the disk
    // Flushes what was written, reads it back, renames the file, flushes the folder.
    void commit();

private:
    void create(const std::string& folder);
    void require_contents();
    void take_the_targets_place();
    [[noreturn]] void fail(const char* what) const;

    std::string path_, target_, name_;  // the user's name of the target, the target, the temporary file
    int descriptor_ = -1;
    Checksum written_;
};

// Makes `bytes` the contents of the file `path`, or leaves everything as it was. \throws FileError
void replace_file(const std::string& path, std::span<const std::byte> bytes);

// Throws what replace_file would throw for a reason that can be known beforehand: the folder, permissions, a disk
// without a free block.
void check_replaceable(const std::string& path);

}  // namespace limn
