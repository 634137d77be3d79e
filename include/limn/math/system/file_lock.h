/// \file
/// A lock that keeps other processes from writing a file.
#pragma once

#include <string>

namespace limn {

/// An exclusive lock on the writing of a file.
///
/// - At any time at most one FileLock in all processes holds the lock of a path.
/// - The lock ends with the object, or with its process.
/// - The lock is held on a second file, PATH.lock, so it outlasts a replacement of PATH. The destructor deletes
///   PATH.lock. A killed process leaves PATH.lock behind, which does no harm.
/// - On a file system without locks every process gets the lock.
class FileLock {
public:
    /// Takes the lock, without waiting.
    /// \throws FileError if this process or another holds it already, PATH.lock cannot be created, or links lead in a
    /// circle
    explicit FileLock(const std::string& path);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

private:
    std::string name_;
    int descriptor_ = -1;
};

}  // namespace limn
