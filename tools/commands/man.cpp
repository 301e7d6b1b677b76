#include "options.h"
#include "program.h"
#include "shell_words.h"
#include "streams.h"

namespace drape::cli {

void add_man(Program& program) {
    const auto run = [&program] {
        print_data(manual_page(program.commands(), program_version()));
        return ExitCode::ok;
    };
    program.add("man", "Print the manual page, drape(1)", R"text(
Examples:
  drape man | man -l -
  drape man > ~/.local/share/man/man1/drape.1
)text",
                run);
}

}  // namespace drape::cli
