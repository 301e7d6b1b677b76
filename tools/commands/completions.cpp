#include <fmt/format.h>

#include "options.h"
#include "program.h"
#include "shell_words.h"
#include "streams.h"

namespace drape::cli {

void add_completions(Program& program) {
    struct Options {
        std::string shell;
        std::vector<std::string> words;
    };
    const auto options = std::make_shared<Options>();
    const auto run = [=, &program] {
        const bool is_asked = options->shell == "words";
        const std::string text =
            is_asked ? completions(program.commands(), options->words) : completion_script(options->shell);
        if (text.empty() && !is_asked)
            throw UsageError(fmt::format("completions: expected bash, zsh or fish, got '{}'", options->shell));
        print_data(text);
        return ExitCode::ok;
    };
    CLI::App& command = program.add("completions", "Print the completion script of a shell: bash, zsh or fish", R"text(
Examples:
  source <(drape completions bash)
  drape completions zsh > ~/.zsh/_drape            with ~/.zsh in $fpath
  drape completions fish > ~/.config/fish/completions/drape.fish
)text",
                                    run);
    add_required_file(command, "SHELL", "bash, zsh or fish; the scripts ask for `words`", options->shell);
    add_word_list(command, "WORD", "With `words`: what stands after `drape`; the last is completed", options->words);
}

}  // namespace drape::cli
