#include <fmt/format.h>

#include "options.h"
#include "program.h"
#include "scene/nearest_word.h"
#include "shell_words.h"
#include "streams.h"

namespace drape::cli {

void add_completions(Program& program) {
    const auto shell = std::make_shared<std::string>();
    const auto run = [=, &program] {
        const std::vector<CommandText> commands = program.commands();
        if (*shell == "bash")
            print_data(bash_completion(commands));
        else if (*shell == "zsh")
            print_data(zsh_completion(commands));
        else if (*shell == "fish")
            print_data(fish_completion(commands));
        else
            throw UsageError(fmt::format("completions: expected bash, zsh or fish, got '{}'", *shell));
        return ExitCode::ok;
    };
    CLI::App& command = program.add("completions", "Print the completion script of a shell: bash, zsh or fish", R"text(
Examples:
  source <(drape completions bash)
  drape completions zsh > ~/.zsh/_drape            with ~/.zsh in $fpath
  drape completions fish > ~/.config/fish/completions/drape.fish
)text",
                                    run);
    add_required_file(command, "SHELL", "bash, zsh or fish", *shell);
}

}  // namespace drape::cli
