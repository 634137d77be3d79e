// A folder of its own for each test.
#pragma once

#include <stdlib.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

namespace limn::test {

/// A new empty folder, removed with all that is in it at the end.
class Folder {
public:
    Folder() : path_((std::filesystem::temp_directory_path() / "limn-test-XXXXXX").string()) {
        if (!mkdtemp(path_.data())) throw std::runtime_error("no temporary folder");
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const std::string& path() const { return path_; }
    std::string path(const std::string& name) const { return path_ + "/" + name; }
    /// Writes a file and returns its path.
    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(path(name), std::ios::binary) << content;
        return path(name);
    }
    /// Makes a pipe with a name, which nobody reads or writes, and returns its path.
    std::string make_pipe(const std::string& name) const {
        if (mkfifo(path(name).c_str(), 0666) != 0) throw std::runtime_error("no pipe");
        return path(name);
    }
    std::string read(const std::string& name) const {
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    /// The names and contents of all files in it.
    std::map<std::string, std::string> contents() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : std::filesystem::directory_iterator(path_))
            if (entry.is_regular_file()) all[entry.path().filename()] = read(entry.path().filename());
        return all;
    }
    /// The names of all that is in it.
    std::set<std::string> names() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) names.insert(entry.path().filename());
        return names;
    }

private:
    std::string path_;
};

using Names = std::set<std::string>;

}  // namespace limn::test
