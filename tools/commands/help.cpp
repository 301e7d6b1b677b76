#include "options.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

void add_help(Program& program) {
    const auto words = std::make_shared<std::vector<std::string>>();
    const auto run = [=, &program] {
        print_data(program.help(*words));
        return ExitCode::ok;
    };
    CLI::App& command = program.add("help", "The help of the program or of a command", R"text(
Examples:
  drape help
  drape help render
  drape help bench speed
)text",
                                    run);
    add_word_list(command, "COMMAND", "A command", *words);
}

}  // namespace drape::cli
