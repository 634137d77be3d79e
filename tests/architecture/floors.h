// Which room may include which, read from the table in floors.txt.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace limn::architecture {

/// The table consists of chains `a b -> c d -> e`: every room may include all rooms to its right in the chain. Two
/// spaces or more part the chains of one line, commas or spaces the rooms. "(sources may use x, y)" after a chain holds
/// for the .cpp files of all its rooms but the last ones. What has no arrow is prose.
class Floors {
public:
    /// \throws std::invalid_argument naming the rooms if arrows lead from a room back to it
    explicit Floors(std::string_view table);

    bool knows(const std::string& room) const { return rooms_.contains(room); }
    /// \param source the file is a .cpp, not a header
    bool allows(const std::string& from, const std::string& to, bool source) const;

private:
    void add_chain(const std::string& chain, const std::string& sources_may_use);
    bool leads_back(const std::string& room, std::set<std::string>& visited, std::vector<std::string>& path) const;

    std::set<std::string> rooms_;
    std::map<std::string, std::set<std::string>> anyone_, sources_;
};

}  // namespace limn::architecture
