/// \file
/// The exceptions that limn throws. Besides them only std::bad_alloc and what user-defined classes and callbacks throw
/// may leave a function.
#pragma once

#include <stdexcept>
#include <string>

namespace limn {

/// What every limn function throws when it cannot do its work. `what()` names the file, line or argument.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Something is wrong in an argument alone: an impossible camera, a negative size, a NaN radius.
class ArgumentError : public Error {
public:
    using Error::Error;
};

/// Something is wrong with a file: missing, unreadable, malformed, unwritable. `what()` starts with its path.
class FileError : public Error {
public:
    /// `what()` is "path: problem".
    FileError(const std::string& path, const std::string& problem) : Error(path + ": " + problem), path_(path) {}
    const std::string& path() const { return path_; }  ///< as the caller named it

private:
    std::string path_;
};

}  // namespace limn
