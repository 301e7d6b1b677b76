#include "program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "base/printable_text.h"
#include "help_text.h"
#include "run/run.h"
#include "scene/nearest_word.h"
#include "streams.h"

namespace drape::cli {

namespace {

constexpr const char* examples = R"text(
Examples:
  drape new flag                       a first scene to play with: flag.json
  drape render flag.json -o out/flag
  drape check scenes/*.json
  drape simulate scenes/hanging_sheet.json -o out/hang
  drape graph scenes/flag.json --format dot | dot -Tsvg > flag.svg
  drape bench accuracy --short
`drape help COMMAND` has each command's options and examples.

Data goes to stdout, messages to stderr. Exit codes:
)text";

constexpr const char* about_exit_codes =
    "\nData goes to stdout, messages to stderr. `drape --help` explains the exit codes.\nExit codes: ";

/// Prints CLI11's help in lines that a terminal shows whole.
class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter() { column_width(26); }

    std::string make_description(const CLI::App* app) const override {
        return wrapped(app->get_description(), help_columns) + "\n";
    }
    std::string make_subcommand(const CLI::App* command) const override {
        const std::string gap(column_width_, ' '), name = "  " + command->get_name();
        std::string text = name.size() < gap.size() ? name + gap.substr(name.size()) : name + '\n' + gap;
        for (const char c : beside(command->get_description())) text += c == '\n' ? '\n' + gap : std::string(1, c);
        return text + '\n';
    }
    std::string make_option_desc(const CLI::Option* option) const override { return beside(option->get_description()); }

  private:
    std::string beside(const std::string& text) const { return wrapped(text, help_columns - column_width_); }
};

OptionText text_of(const CLI::Option& option) {
    OptionText text;
    if (!option.nonpositional()) text.names.push_back(option.get_name());
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
    text.is_positional = !option.nonpositional();
    if (option.get_items_expected_max() > 0) text.value = option.get_type_name();
    text.help = option.get_description();
    return text;
}

std::string listed(const CLI::App& group) {
    std::vector<std::string> names;
    for (const CLI::App* command : group.get_subcommands({})) names.push_back(command->get_name());
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Returns ": did you mean 'render'?", or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    const std::string_view nearest = nearest_word(word, candidates);
    return nearest.empty() ? "" : fmt::format(": did you mean '{}'?", nearest);
}

}  // namespace

Program::Program(std::vector<std::string> arguments)
    : arguments_(std::move(arguments)),
      app_(std::make_unique<CLI::App>("drape: cloth simulation by Vulkan compute; scene file in, PNG sequence out.",
                                      "drape")) {
    app_->set_version_flag("-V,--version", fmt::format("drape {} (commit {})", program_version(), program_commit()));
    app_->require_subcommand(1);
    app_->formatter(std::make_shared<HelpFormatter>());  // commands inherit it
    app_->footer(examples + exit_code_table());
    added_.push_back({app_.get(), {"", app_->get_description(), examples + exit_code_table(), {}, true}});
}

Program::~Program() = default;

CLI::App& Program::add(const std::string& name, const char* summary, const char* details,
                       const std::function<ExitCode()>& run) {
    const std::size_t space = name.find(' ');
    CLI::App* parent = space == std::string::npos ? app_.get() : app_->get_subcommand(name.substr(0, space));
    CLI::App* command = parent->add_subcommand(name.substr(space + 1), summary);
    const std::string text = reflowed(details, help_columns);
    command->footer(text + about_exit_codes + exit_code_list(help_columns - 1) + ".\n");
    if (run)
        command->callback([this, run] { run_ = run; });
    else
        command->require_subcommand(1);
    added_.push_back({command, {name, summary, text, {}, !run}});
    return *command;
}

std::vector<CommandText> Program::commands() const {
    std::vector<CommandText> texts;
    for (const auto& [app, added] : added_) {
        CommandText text = added;
        for (const CLI::Option* option : app->get_options()) text.options.push_back(text_of(*option));
        texts.push_back(std::move(text));
    }
    return texts;
}

/// Returns nothing when there is no such command.
const CLI::App* Program::find(const std::vector<std::string>& words) const {
    const std::string name = fmt::format("{}", fmt::join(words, " "));
    const auto found = std::ranges::find(added_, name, [](const auto& added) { return added.second.name; });
    return found == added_.end() ? nullptr : found->first;
}

std::string Program::help(const std::vector<std::string>& command) const {
    const CLI::App* app = find(command);
    if (!app) {
        std::vector<std::string> names;
        for (const auto& [each, text] : added_)
            if (!text.name.empty()) names.push_back(text.name);
        const std::string asked = fmt::format("{}", fmt::join(command, " "));
        const std::string meant = did_you_mean(asked, names);
        throw UsageError(
            fmt::format("no help on '{}'{}", asked,
                        meant.empty() ? fmt::format(": expected one of {}", fmt::join(names, ", ")) : meant));
    }
    std::string name = "drape";
    for (const std::string& word : command) name += " " + word;
    return app->get_formatter()->make_help(app, name, CLI::AppFormatMode::Normal);
}

Program::Parsed Program::usage_error(const std::string& text) const {
    std::string name = "drape";
    for (const CLI::App* command = app_.get(); !command->get_subcommands().empty();) {
        command = command->get_subcommands().front();
        name += " " + command->get_name();
    }
    return {{}, {}, name + ": " + printable(text) + "\nSee `" + name + " --help`.", ExitCode::usage};
}

/// Returns the error in the words that ought to name a command; empty when there is none.
std::string Program::unknown_command() const {
    const CLI::App* group = app_.get();
    for (std::size_t i = 1; group == app_.get() || group->get_require_subcommand_min() > 0; ++i) {
        const std::string word = i < arguments_.size() ? arguments_[i] : "";
        if (word.starts_with('-')) return {};
        const std::string expected = ": expected one of " + listed(*group);
        if (word.empty()) return "no command given" + expected;
        std::vector<std::string> names;
        const CLI::App* found = nullptr;
        for (const CLI::App* command : group->get_subcommands({})) {
            names.push_back(command->get_name());
            if (command->get_name() == word) found = command;
        }
        if (!found) {
            const std::string meant = did_you_mean(word, names);
            return fmt::format("unknown command '{}'{}", word, meant.empty() ? expected : meant);
        }
        group = found;
    }
    return {};
}

/// Returns, after a parse, the option that was not expected, with a suggestion.
std::string Program::unknown_option() const {
    const std::vector<std::string> extras = app_->remaining(true);
    const CLI::App* command = app_.get();
    while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
    std::vector<std::string> names;
    for (const CLI::Option* option : command->get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    std::string text;
    for (const std::string& extra : extras) {
        const std::string word = extra.substr(0, extra.find('='));
        text += fmt::format("{}not expected: {}{}", text.empty() ? "" : "; ", extra,
                            word.starts_with("--") ? did_you_mean(word, names) : "");
    }
    return text;
}

Program::Parsed Program::parse() {
    if (const std::string wrong = unknown_command(); !wrong.empty()) return usage_error(wrong);
    try {
        // CLI11 takes the words from the back.
        app_->parse(std::vector<std::string>(arguments_.rbegin(), arguments_.rend() - 1));
    } catch (const CLI::CallForHelp&) {
        return {{}, app_->help(), {}};
    } catch (const CLI::CallForVersion& version) {
        return {{}, std::string(version.what()) + "\n", {}};
    } catch (const CLI::ExtrasError&) {
        return usage_error(unknown_option());
    } catch (const CLI::ParseError& error) {
        return usage_error(error.what());
    }
    return {run_, {}, {}};
}

ExitCode Program::run() {
    const Parsed parsed = parse();
    if (!parsed.data.empty()) print_data(parsed.data);
    if (!parsed.message.empty()) print_message(parsed.message);
    return parsed.command ? parsed.command() : parsed.code;
}

}  // namespace drape::cli
