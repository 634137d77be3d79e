// A folder of its own for each test.
#pragma once

#include <set>
#include <string>

namespace limn::test {

/// A new empty folder, removed with all that is in it at the end.
class Folder {
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const std::string& path() const { return path_; }
    std::string path(const std::string& name) const { return path_ + "/" + name; }
    /// Writes a file and returns its path.
    std::string write(const std::string& name, const std::string& content) const;
    std::string read(const std::string& name) const;
    /// The names of all that is in it.
    std::set<std::string> names() const;

private:
    std::string path_;
};

using Names = std::set<std::string>;

/// A block with a roof, its coordinates small whole numbers times `scale`, rounded to float32.
std::string house_obj(double scale = 1);

}  // namespace limn::test
