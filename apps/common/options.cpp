#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

#include "limn/math/error.h"
#include "text_file.h"

namespace limn::app {

namespace {

// Returns the number of letters to change, insert or delete to turn a into b (Levenshtein's distance).
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (const char letter : a) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (letter == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

// Returns the description of an option in --help.
std::string described(const std::string& help, const std::string& preset) {
    return preset.empty() ? help : help + " (default: " + preset + ")";
}

constexpr std::size_t kHelpWidth = 96;  // columns

// Returns the text broken into lines of at most kHelpWidth columns. The first line begins in column `begin`, the others
// in column `indent`.
std::string wrapped(const std::string& text, std::size_t begin, std::size_t indent) {
    std::string lines;
    std::size_t column = begin;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (column > begin && column + 1 + word.size() > kHelpWidth) {
            lines += "\n" + std::string(indent, ' ');
            column = begin = indent;
        } else if (column > begin) {
            lines += ' ';
            ++column;
        }
        lines += word;
        column += word.size();
    }
    return lines;
}

// Formats --help with wrapped lines. CLI11 2.1 does not wrap them.
class WrappedHelp final : public CLI::Formatter {
public:
    std::string make_option(const CLI::Option* option, bool is_argument) const override {
        const std::string name = "  " + make_option_name(option, is_argument) + make_option_opts(option);
        const std::size_t indent = get_column_width();
        const std::string gap =
            name.size() < indent ? std::string(indent - name.size(), ' ') : "\n" + std::string(indent, ' ');
        return name + gap + wrapped(make_option_desc(option), indent, indent) + "\n";
    }
    std::string make_description(const CLI::App* app) const override {
        return wrapped(app->get_description(), 0, 0) + "\n\n";
    }
};

}  // namespace

struct Options::Parser {
    CLI::App app;
    std::map<std::string, std::pair<CLI::Option*, std::string>> options;  // by Option::name, with the help text
    std::vector<std::string> names{"--help"};                             // single names, for did_you_mean

    // Stores an option under its name and each of its single names.
    void keep(const std::string& name, CLI::Option* option, const std::string& help) {
        options[name] = {option, help};
        for (std::size_t begin = 0; begin <= name.size();) {
            const std::size_t end = std::min(name.find(',', begin), name.size());
            names.push_back(name.substr(begin, end - begin));
            begin = end + 1;
        }
    }

    // Returns the message for an error of CLI11.
    std::string problem(const CLI::ParseError& error) const {
        // Look for unknown options first. CLI11 may report the option that was meant as missing instead.
        for (const std::string& word : app.remaining())
            if (word.size() > 1 && word.starts_with('-')) {
                const std::string name = word.substr(0, word.find('='));
                return "unknown option " + name + did_you_mean(name, names);
            }
        const std::string message = error.what();
        std::string name = message.substr(0, message.find_first_of(": "));
        if (!name.starts_with('-')) name.insert(0, "--");
        if (dynamic_cast<const CLI::ExtrasError*>(&error))
            return "unexpected argument '" + app.remaining().front() + "'";
        if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
            return name + (message.find("override") == std::string::npos ? " needs a value" : " takes no value");
        return message;
    }
};

Options::Options(std::string program, const std::string& description, const std::string& footer)
    : parser_(std::make_unique<Parser>()) {
    parser_->app.formatter(std::make_shared<WrappedHelp>());
    parser_->app.description(description);
    parser_->app.name(std::move(program));
    parser_->app.footer(footer);
}

Options::~Options() = default;

void Options::add(const Option& o, Use use) {
    // Take the raw texts. CLI11's own conversion would read "{}" and "[a]" as lists.
    const auto take = [use = std::move(use), is_repeatable = o.repeatable,
                       name = o.name.substr(0, o.name.find(','))](const CLI::results_t& texts) {
        if (texts.size() > 1 && !is_repeatable)
            throw ArgumentError(name + " is given " + std::to_string(texts.size()) + " times");
        for (const std::string& text : texts) use(text);
        return true;
    };
    CLI::Option* const option = parser_->app.add_option(o.name, take, described(o.help, o.preset));
    option->type_name(o.value)->required(o.required)->group(o.group);
    if (o.repeatable) option->expected(1, CLI::detail::expected_max_vector_size);
    // A repeatable option takes one value each time; a repeatable argument takes any number of words.
    const bool is_argument = !o.name.starts_with('-');
    option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->allow_extra_args(o.repeatable && is_argument);
    parser_->keep(o.name, option, o.help);
}

void Options::add_flag(const std::string& name, bool& value, const std::string& help) {
    parser_->keep(name,
                  parser_->app.add_flag(name, value, help)
                      ->disable_flag_override()
                      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast),
                  help);
}

void Options::preset(const std::string& name, const std::string& text) {
    const auto& [option, help] = parser_->options.at(name);
    option->description(described(help, text));
}

bool Options::parse(int argc, const char* const* argv, const std::function<void()>& before_help) {
    try {
        parser_->app.parse(argc, argv);
        return true;
    } catch (const CLI::CallForHelp&) {
        if (before_help) before_help();
        write_text("-", parser_->app.help());
        return false;
    } catch (const CLI::ParseError& error) {
        throw ArgumentError(parser_->problem(error) + " (see " + parser_->app.get_name() + " --help)");
    }
}

std::string did_you_mean(std::string_view given, const std::vector<std::string>& words) {
    const auto nearest = std::min_element(words.begin(), words.end(), [&](const auto& a, const auto& b) {
        return distance(given, a) < distance(given, b);
    });
    if (nearest == words.end() || distance(given, *nearest) > std::min(given.size() / 3, std::size_t{2})) return "";
    return "; did you mean " + *nearest + "?";
}

}  // namespace limn::app
