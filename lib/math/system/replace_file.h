// Files that are replaced as a whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "math/system/checksum.h"

namespace limn {

// Returns the system's message for the current value of errno.
std::string system_message();

// Tries to lock an open file. The lock ends when the file is closed or the process ends. Returns false if the file is
// locked already, by this process or another. Returns true if the file system has no locks.
bool try_lock(int descriptor);
// Returns true if `path` still names the open file.
bool is_at(int descriptor, const std::string& path);

// A temporary file beside `path`. commit() puts it in the place of the file `path`, which is unchanged until then.
// Without a commit() the temporary file is removed.
//
// If `path` is a link, the file behind it is replaced. The new file has the permissions of the old one. The constructor
// also removes the temporary files that killed processes left in the folder.
//
// All members throw FileError if the file cannot be written.
class FileReplacement {
public:
    explicit FileReplacement(const std::string& path);
    ~FileReplacement();
    FileReplacement(const FileReplacement&) = delete;
    FileReplacement& operator=(const FileReplacement&) = delete;

    void write(std::span<const std::byte> bytes);
    // Flushes the file to the disk.
    void flush();
    // Flushes the file, reads it back and compares it with what was written, renames it, and flushes the folder.
    void commit();

private:
    void create(const std::string& folder);
    void require_contents();
    void take_the_targets_place();
    [[noreturn]] void fail(const char* what) const;

    std::string path_;     // the target's name as the user gave it, for messages
    std::string target_;   // the file to replace, behind all links
    std::string name_;     // the temporary file; empty once it is renamed
    int descriptor_ = -1;  // the open temporary file
    Checksum written_;     // checksum of all bytes written
};

// Makes `bytes` the contents of the file `path`, as FileReplacement does. \throws FileError
void replace_file(const std::string& path, std::span<const std::byte> bytes);

// Throws the FileError that replace_file() would throw if its cause can be known beforehand: a missing folder, missing
// permissions, a disk without a free block.
void check_replaceable(const std::string& path);

}  // namespace limn
