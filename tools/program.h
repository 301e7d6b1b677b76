// The command line as a set of commands, each of which adds itself (tools/commands).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "exit_code.h"

namespace CLI {
class App;
}

namespace drape::cli {

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

    /// Parses the command line and runs the command it names, or says what is wrong with it.
    ExitCode run();

    const std::vector<std::string>& arguments() const { return arguments_; }

  private:
    ExitCode usage_error(const std::string& text) const;
    std::string other_commands(const std::string& name) const;

    std::vector<std::string> arguments_;
    std::unique_ptr<CLI::App> app_;
    std::function<ExitCode()> run_;
};

/// Adds every command.
void add_commands(Program& program);

}  // namespace drape::cli
