/// \file
/// The options and arguments of a program, and its --help. CLI11 parses them. Only options.cpp includes it, because it
/// takes eight seconds to compile.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace limn::app {

/// A function that receives the text of a value. Throws an ArgumentError that names the option if the text is invalid.
using Use = std::function<void(const std::string& text)>;

/// An option with a value, or a positional argument.
struct Option {
    std::string name;               ///< for example "--spp", "-o,--output" or "MODEL"
    std::string value;              ///< name of the value in --help; empty for a positional argument
    std::string help;               ///< description in --help
    std::string preset = "";        ///< the default, as text for --help; empty for a required option
    bool required = false;          ///< true if a command line without it is refused
    bool repeatable = false;        ///< true if it may be given several times
    const char* group = "Options";  ///< heading in --help
};

/// The options and arguments of a command. Not thread-safe.
class Options {
public:
    /// \param program the command as the user types it, with its subcommand
    /// \param footer the last paragraphs of --help
    Options(std::string program, const std::string& description, const std::string& footer = "");
    ~Options();
    Options(const Options&) = delete;
    Options& operator=(const Options&) = delete;

    /// Adds an option or argument. parse() calls `use` once for each value.
    void add(const Option& option, Use use);
    /// Adds an option without a value, which sets `value` to true. `value` must outlive the parsing.
    void add_flag(const std::string& name, bool& value, const std::string& help);
    /// Replaces the default that --help states for an option. \pre an option has this name
    void preset(const std::string& name, const std::string& text);

    /// Parses the command line, or prints the help on stdout if the user asked for it.
    /// \param before_help called before the help is printed; may call preset() with defaults that take work to compute
    /// \returns false if the help was printed
    /// \throws ArgumentError for a bad command line, and what a `use` throws
    bool parse(int argc, const char* const* argv, const std::function<void()>& before_help = nullptr);

private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
};

/// Returns "; did you mean WORD?" with the word that is most similar to the given one, or "" if none is similar.
std::string did_you_mean(std::string_view given, const std::vector<std::string>& words);

}  // namespace limn::app
