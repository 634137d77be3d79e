/// \file
/// The exceptions that limn throws. Its functions throw nothing else, except std::bad_alloc and the exceptions of
/// user-defined classes and callbacks.
#pragma once

#include <stdexcept>
#include <string>

namespace limn {

/// The base class of limn's exceptions. It is thrown by a function that cannot do its work. `what()` names the file,
/// line or argument.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An invalid argument, for example an impossible camera, a negative size or a NaN radius.
class ArgumentError : public Error {
public:
    using Error::Error;
};

/// A fault of a file: it is missing, unreadable or malformed, or cannot be written. `what()` starts with its path.
class FileError : public Error {
public:
    /// Makes `what()` return "path: problem".
    FileError(const std::string& path, const std::string& problem) : Error(path + ": " + problem), path_(path) {}
    const std::string& path() const { return path_; }  ///< the path as the caller gave it

private:
    std::string path_;
};

}  // namespace limn
