// The `drape` command.
#include "ending.h"
#include "program.h"
#include "streams.h"

int main(int argc, char** argv) {
    using namespace drape::cli;
    prepare_streams();
    try {
        Program program({argv, argv + argc});
        add_commands(program);
        return static_cast<int>(program.run());
    } catch (...) {
        return static_cast<int>(report_current_exception());
    }
}
