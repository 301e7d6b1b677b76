#include <fmt/format.h>

#include "run/exit_code.h"
#include "shell_words.h"

namespace drape::cli {

namespace {

/// Returns text that roff prints as it stands: without escapes and requests.
std::string plain(const std::string& text) {
    std::string roff;
    for (const char c : text) {
        if (c == '\\')
            roff += "\\e";
        else if (c == '-')
            roff += "\\-";
        else if ((c == '.' || c == '\'') && (roff.empty() || roff.back() == '\n'))
            roff += std::string("\\&") + c;
        else
            roff += c;
    }
    return roff;
}

/// Returns a paragraph, in which lines of the help begin lines.
std::string filled(const std::string& text) {
    std::string roff;
    for (const char c : plain(text)) roff += c == '\n' ? std::string("\n.br\n") : std::string(1, c);
    return roff;
}

/// Returns lines as they stand.
std::string verbatim(const std::string& text) {
    const std::size_t begin = text.find_first_not_of('\n');
    if (begin == std::string::npos) return {};
    std::string lines = plain(text.substr(begin));
    if (lines.back() != '\n') lines += '\n';
    return ".PP\n.nf\n" + lines + ".fi\n";
}

std::string option_entry(const OptionText& option) {
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + name;
    const std::string value =
        option.is_positional || option.value.empty() ? "" : " \\fI" + plain(option.value) + "\\fR";
    return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", plain(names), value, filled(option.help));
}

}  // namespace

std::string manual_page(const std::vector<CommandText>& commands, const std::string& version) {
    std::string text = fmt::format(
        ".TH DRAPE 1 \"\" \"drape {}\" \"User Commands\"\n.SH NAME\ndrape \\- cloth simulation on the GPU\n"
        ".SH SYNOPSIS\n.B drape\n.I COMMAND\n[\\fIOPTION\\fR]...\n.SH DESCRIPTION\n{}\n.SH COMMANDS\n",
        plain(version), plain(commands.front().summary));
    for (const CommandText& command : commands) {
        if (command.name.empty()) continue;
        text += fmt::format(".SS \"drape {}\"\n{}\n", plain(command.name), plain(command.summary));
        for (const OptionText& option : command.options) text += option_entry(option);
        text += verbatim(command.details);
    }
    text += ".SH \"EXIT STATUS\"\n";
    for (const ExitCodeRow& row : exit_code_rows)
        text += fmt::format(".TP\n{}\n{}: {}\n", static_cast<int>(row.code), plain(row.name), plain(row.meaning));
    return text;
}

}  // namespace drape::cli
