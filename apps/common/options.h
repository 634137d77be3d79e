/// \file
/// The options and arguments of a program, and its --help. Read by CLI11, which options.cpp alone includes: each source
/// that does takes eight seconds to compile.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace limn::app {

/// Takes the text of a value. \throws ArgumentError, which names the option, for one that cannot be right
using Use = std::function<void(const std::string& text)>;

/// An option that takes a value, or an argument known by its place.
struct Option {
    std::string name;               ///< as in "--spp", "-o,--output" or "MODEL"
    std::string value;              ///< what --help calls the value; empty for an argument
    std::string help;               ///< what it is for
    std::string preset = "";        ///< what holds without it, for --help; empty for what is required
    bool required = false;          ///< whether a command line without it is refused
    bool repeatable = false;        ///< whether it may be given several times
    const char* group = "Options";  ///< the heading in --help
};

class Options {
public:
    /// \param program as the user calls it, with its subcommand
    /// \param footer what --help ends with
    Options(std::string program, const std::string& description, const std::string& footer = "");
    ~Options();
    Options(const Options&) = delete;
    Options& operator=(const Options&) = delete;

    /// `use` is called while parsing, once for each value.
    void add(const Option& option, Use use);
    /// An option without a value. `value` must outlive the parsing.
    void add_flag(const std::string& name, bool& value, const std::string& help);
    /// Replaces what --help says of the case without the option.
    void preset(const std::string& name, const std::string& text);

    /// \param before_help called before help is written, for presets that take work to know
    /// \returns false if the user asked for help, which is then on stdout
    /// \throws ArgumentError for bad usage
    bool parse(int argc, const char* const* argv, const std::function<void()>& before_help = nullptr);

private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
};

/// "; did you mean WORD?" with the word that is written most like the given one, or nothing where none is.
std::string did_you_mean(std::string_view given, const std::vector<std::string>& words);

}  // namespace limn::app
