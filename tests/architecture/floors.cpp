#include "architecture/floors.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace limn::architecture {
namespace {

std::vector<std::string> split(const std::string& text, const std::string& separator) {
    const std::regex pattern(separator);
    std::vector<std::string> parts;
    for (std::sregex_token_iterator part(text.begin(), text.end(), pattern, -1), end; part != end; ++part)
        if (part->length() > 0) parts.push_back(*part);
    return parts;
}

}  // namespace

Floors::Floors(std::string_view table) {
    static const std::regex arrow(R"(\s*->\s*)"), modifier(R"(\s*\(sources may use ([^)]*)\))");
    std::istringstream lines{std::string(table)};
    std::string line;
    while (std::getline(lines, line)) {
        std::smatch found;
        std::string sources_may_use;
        if (std::regex_search(line, found, modifier)) {
            sources_may_use = found[1];
            line = found.prefix().str() + found.suffix().str();
        }
        for (const std::string& chain : split(std::regex_replace(line, arrow, "->"), "\\s{2,}"))
            if (chain.find("->") != std::string::npos) add_chain(chain, sources_may_use);
    }
    std::set<std::string> visited;
    for (const std::string& room : rooms_) {
        std::vector<std::string> path;
        if (!leads_back(room, visited, path)) continue;
        std::string message = "the floors have a cycle:";
        for (auto link = std::find(path.begin(), path.end(), path.back()); link != path.end(); ++link)
            message += " " + *link;
        throw std::invalid_argument(message);
    }
}

// Depth first. `path`: from where the search began to `room`; if true, on to the room where the cycle is closed.
bool Floors::leads_back(const std::string& room, std::set<std::string>& visited, std::vector<std::string>& path) const {
    const bool closes = std::find(path.begin(), path.end(), room) != path.end();
    path.push_back(room);
    if (closes) return true;
    if (visited.insert(room).second)
        for (const auto* table : {&anyone_, &sources_})
            if (const auto row = table->find(room); row != table->end())
                for (const std::string& target : row->second)
                    if (leads_back(target, visited, path)) return true;
    path.pop_back();
    return false;
}

void Floors::add_chain(const std::string& chain, const std::string& sources_may_use) {
    const std::vector<std::string> links = split(chain, "->");
    for (std::size_t upper = 0; upper < links.size(); ++upper) {
        for (const std::string& room : split(links[upper], "[,\\s]+")) {
            rooms_.insert(room);
            for (std::size_t lower = upper + 1; lower < links.size(); ++lower)
                for (const std::string& target : split(links[lower], "[,\\s]+")) anyone_[room].insert(target);
            if (upper + 1 < links.size())
                for (const std::string& target : split(sources_may_use, "[,\\s]+")) sources_[room].insert(target);
        }
    }
}

bool Floors::allows(const std::string& from, const std::string& to, bool source) const {
    const auto holds = [&](const auto& table) {
        const auto row = table.find(from);
        return row != table.end() && row->second.contains(to);
    };
    return from == to || holds(anyone_) || (source && holds(sources_));
}

}  // namespace limn::architecture
