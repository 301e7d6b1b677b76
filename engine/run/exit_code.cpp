#include "run/exit_code.h"

#include <fmt/format.h>

namespace drape {

std::string exit_code_list(std::size_t columns) {
    std::string text, line;
    for (const ExitCodeRow& row : exit_code_rows) {
        const bool last = &row == &exit_code_rows.back();
        const std::string entry = fmt::format("{} {}{}", static_cast<int>(row.code), row.name, last ? "" : ",");
        if (!line.empty() && line.size() + 1 + entry.size() > columns) {
            text += line + '\n';
            line.clear();
        }
        line += (line.empty() ? "" : " ") + entry;
    }
    return text + line;
}

std::string exit_code_table() {
    std::string text;
    for (const ExitCodeRow& row : exit_code_rows)
        text += fmt::format("  {:>3}  {:<15} {}\n", static_cast<int>(row.code), row.name, row.meaning);
    return text;
}

}  // namespace drape
