// The table of commands. A file of this folder (found by glob) has everything about one: words, options, examples and
// action. A new command takes its file, and its name here.
#include "program.h"

namespace drape::cli {

using AddCommand = void(Program&);
AddCommand add_new, add_pattern, add_render, add_simulate, add_camera, add_graph, add_check, add_schema, add_devices,
    add_bench_accuracy, add_bench_speed, add_bench_fabric, add_profile, add_compare, add_replay, add_verify, add_report,
    add_sweep, add_help, add_completions, add_man;

void add_commands(Program& program) {
    for (AddCommand* add :
         {add_new,    add_pattern, add_render,         add_simulate,    add_camera,       add_graph,       add_check,
          add_schema, add_devices, add_bench_accuracy, add_bench_speed, add_bench_fabric, add_profile,     add_compare,
          add_replay, add_verify,  add_report,         add_sweep,       add_help,         add_completions, add_man})
        add(program);
}

}  // namespace drape::cli
