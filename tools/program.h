// The command line is a set of commands, each of which adds itself (tools/commands).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "run/exit_code.h"

namespace CLI {
class App;
}

namespace drape::cli {

/// An option as its help has it, for completions and the manual page.
struct OptionText {
    std::vector<std::string> names;  ///< "-o", "--output"; an option by its place has its name
    std::string value;               ///< "DIR"; empty: a flag
    std::string help;
    bool is_positional = false;
};

struct CommandText {
    std::string name;  ///< "bench speed"; empty: the program itself
    std::string summary, details;
    std::vector<OptionText> options;
    bool is_group = false;
};

class Program {
  public:
    /// `arguments`: the program's name first.
    explicit Program(std::vector<std::string> arguments);
    ~Program();

    /// Adds a command, to whose options the caller adds. Its name has two words when it is a member of the group that
    /// the first one names; `summary` is its line in the list, `details` stand below its options. `run` is called once
    /// the options are parsed; a group has none.
    CLI::App& add(const std::string& name, const char* summary, const char* details,
                  const std::function<ExitCode()>& run);

    /// The result of a command line: a command to run, or else texts to print and a code to end with.
    struct Parsed {
        std::function<ExitCode()> command;
        std::string data;     ///< for stdout
        std::string message;  ///< for stderr: the error, and where help is
        ExitCode code = ExitCode::ok;
    };
    /// Parses without running or printing.
    Parsed parse();

    /// Parses the command line and runs the command that it names, or prints the error.
    ExitCode run();

    const std::vector<std::string>& arguments() const { return arguments_; }

    /// Returns the program and every command, in the order in which they were added.
    std::vector<CommandText> commands() const;
    /// Returns the text of `drape COMMAND --help`. Throws UsageError when there is no such command.
    std::string help(const std::vector<std::string>& command) const;

  private:
    const CLI::App* find(const std::vector<std::string>& words) const;
    std::string unknown_command() const;
    std::string unknown_option() const;
    Parsed usage_error(const std::string& text) const;

    std::vector<std::string> arguments_;
    std::unique_ptr<CLI::App> app_;
    std::vector<std::pair<const CLI::App*, CommandText>> added_;
    std::function<ExitCode()> run_;
};

void add_commands(Program& program);

}  // namespace drape::cli
