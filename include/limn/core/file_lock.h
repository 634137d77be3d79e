/// \file
/// Who may write a file.
#pragma once

#include <string>

namespace limn {

/// The right to write a file. One object has it at a time, of all processes, and it ends with its process. It holds
/// over replacements of the file: the lock is on PATH.lock beside it, which a killed process leaves behind without
/// harm. Where the file system has no locks, every process gets one.
class FileLock {
public:
    /// \throws FileError if it is held already, by this process or another, or PATH.lock cannot be made
    explicit FileLock(const std::string& path);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

private:
    std::string name_;
    int descriptor_ = -1;
};

}  // namespace limn
