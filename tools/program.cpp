#include "program.h"

#include <CLI/CLI.hpp>

#include "drape.h"
#include "streams.h"

namespace drape::cli {

namespace {

constexpr const char* examples = R"text(
Examples:
  drape check scenes/*.json
  drape render scenes/flag.json -o out/flag
  drape simulate scenes/hanging_sheet.json -o out/hang
  drape graph scenes/flag.json --format dot | dot -Tsvg > flag.svg
  drape bench accuracy --short
`drape COMMAND --help` has each command's options and examples.

Data goes to stdout, messages to stderr. Exit codes:
)text";

constexpr const char* about_exit_codes =
    "\nData goes to stdout, messages to stderr. `drape --help` says what each exit code means.\nExit codes: ";

}  // namespace

Program::Program(std::vector<std::string> arguments)
    : arguments_(std::move(arguments)),
      app_(std::make_unique<CLI::App>(
          "drape: cloth simulation on the GPU (Vulkan compute); scene file in, PNG sequence out.", "drape")) {
    app_->set_version_flag("--version", std::string("drape ") + program_version());
    app_->require_subcommand(1);
    app_->footer(examples + exit_code_table());
}

Program::~Program() = default;

CLI::App& Program::add(const std::string& name, const char* summary, const char* details,
                       const std::function<ExitCode()>& run) {
    const std::size_t space = name.find(' ');
    CLI::App* parent = space == std::string::npos ? app_.get() : app_->get_subcommand(name.substr(0, space));
    CLI::App* command = parent->add_subcommand(name.substr(space + 1), summary);
    command->footer(std::string(details) + about_exit_codes + exit_code_list(98) + ".\n");
    if (run)
        command->callback([this, run] { run_ = run; });
    else
        command->require_subcommand(1);
    return *command;
}

/// Says what is wrong with the command line, and where help is.
ExitCode Program::usage_error(const std::string& text) const {
    std::string name = "drape";
    for (const CLI::App* command = app_.get(); !command->get_subcommands().empty();) {
        command = command->get_subcommands().front();
        name += " " + command->get_name();
    }
    print_message(name + ": " + text + "\nSee `" + name + " --help`.");
    return ExitCode::usage;
}

/// Empty when `name` is a command, else the names of all.
std::string Program::other_commands(const std::string& name) const {
    std::string names;
    for (const CLI::App* command : app_->get_subcommands({})) {
        if (command->get_name() == name) return {};
        names += (names.empty() ? "" : ", ") + command->get_name();
    }
    return names;
}

ExitCode Program::run() {
    const std::string first = arguments_.size() < 2 ? "" : arguments_[1];
    if (!first.starts_with('-')) {
        const std::string commands = other_commands(first);
        if (!commands.empty())
            return usage_error((first.empty() ? "no command given" : "unknown command '" + first + "'") +
                               ": expected one of " + commands);
    }
    try {
        // CLI11 takes the words from the back.
        app_->parse(std::vector<std::string>(arguments_.rbegin(), arguments_.rend() - 1));
    } catch (const CLI::CallForHelp&) {
        print_data(app_->help());
        return ExitCode::ok;
    } catch (const CLI::CallForVersion& version) {
        print_data(std::string(version.what()) + "\n");
        return ExitCode::ok;
    } catch (const CLI::ParseError& error) {
        return usage_error(error.what());
    }
    return run_();
}

}  // namespace drape::cli
