/// \file
/// Who may write a file.
#pragma once

#include <string>

namespace limn {

/// The right to write a file. One process has it at a time, and it ends with the process. It holds over replacements of
/// the file: the lock is on PATH.lock beside it, which a killed process leaves behind without harm.
/// Where the file system has no locks, every process gets one.
class FileLock {
public:
    /// \throws FileError if another process has it, or PATH.lock cannot be made
    explicit FileLock(const std::string& path);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

private:
    std::string name_;
    int descriptor_ = -1;
};

}  // namespace limn
