#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene_templates.h"
#include "shell_words.h"

namespace drape::cli {

namespace {

constexpr const char* shells = "bash zsh fish";

/// Returns the words that an option's value may be, separated by spaces; empty when it is none of a few.
std::string choices(const OptionText& option) {
    if (option.names.front() == "TEMPLATE") {
        std::string names;
        for (const SceneTemplate& each : scene_templates()) names.append(names.empty() ? "" : " ").append(each.name);
        return names;
    }
    if (option.names.front() == "SHELL") return shells;
    if (option.value.find('|') == std::string::npos) return {};
    std::string words = option.value;
    for (char& c : words)
        if (c == '|') c = ' ';
    return words;
}

bool is_folder(const OptionText& option) { return option.value == "DIR" || option.names.front() == "DIR"; }

/// Any path counts, as the shell itself completes it.
bool is_file(const OptionText& option) {
    const std::string& name = option.is_positional ? option.names.front() : option.value;
    return name == "FILE" || name == "SCENE" || name == "SPEC" || name == "BEFORE" || name == "AFTER";
}

/// "bench speed" -> "_drape_bench_speed", "" -> "_drape"
std::string function_name(const CommandText& command) {
    std::string name = fmt::format("_drape{}{}", command.name.empty() ? "" : "_", command.name);
    for (char& c : name)
        if (c == ' ') c = '_';
    return name;
}

/// Shortens a help text to what a menu has room for: up to the first semicolon, colon, sentence or line.
std::string brief(const std::string& help) {
    std::size_t end = help.find('\n');
    for (const char* mark : {"; ", ": ", ". "}) end = std::min(end, help.find(mark));
    return help.substr(0, end);
}

/// Puts text in single quotes of a shell.
std::string quoted_word(const std::string& text) {
    std::string word = "'";
    for (const char c : text) {
        if (c == '\'')
            word += "'\\''";
        else
            word += c;
    }
    return word += "'";
}

/// Returns the commands of a group ("" or "bench"), as the words that complete it.
std::vector<const CommandText*> members(const std::vector<CommandText>& commands, const std::string& group) {
    const std::string begin = group.empty() ? "" : group + " ";
    std::vector<const CommandText*> found;
    for (const CommandText& command : commands)
        if (command.name.size() > begin.size() && command.name.starts_with(begin) &&
            command.name.find(' ', begin.size()) == std::string::npos)
            found.push_back(&command);
    return found;
}

std::string last_word(const std::string& name) { return name.substr(name.rfind(' ') + 1); }

/// Words complete the members of a group and the long options.
std::string bash_words(const std::vector<CommandText>& commands, const CommandText& command) {
    std::vector<std::string> words;
    if (command.is_group)
        for (const CommandText* member : members(commands, command.name)) words.push_back(last_word(member->name));
    for (const OptionText& option : command.options)
        if (!option.is_positional) words.push_back(option.names.back());
    return fmt::format("{}", fmt::join(words, " "));
}

std::string bash_value(const OptionText& option) {
    if (const std::string words = choices(option); !words.empty())
        return fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$word\"))", words);
    return is_folder(option) ? "COMPREPLY=($(compgen -d -- \"$word\"))"
           : is_file(option) ? "COMPREPLY=($(compgen -f -- \"$word\"))"
                             : "COMPREPLY=()";
}

/// Returns the cases of a command: after an option come its values, else words, else what stands at a place.
std::string bash_command(const std::vector<CommandText>& commands, const CommandText& command) {
    std::string text = fmt::format("    '{}')\n        case $before in\n", command.name), place;
    for (const OptionText& option : command.options) {
        if (option.is_positional)
            place = bash_value(option);
        else if (!option.value.empty())
            text += fmt::format("        {}) {}; return ;;\n", fmt::join(option.names, "|"), bash_value(option));
    }
    text += fmt::format("        esac\n        words='{}'\n", bash_words(commands, command));
    if (!place.empty()) text += fmt::format("        if [[ $word != -* ]]; then {}; return; fi\n", place);
    return text + "        ;;\n";
}

}  // namespace

std::string bash_completion(const std::vector<CommandText>& commands) {
    std::string cases, groups;
    for (const CommandText& command : commands) {
        cases += bash_command(commands, command);
        if (command.is_group && !command.name.empty()) groups += (groups.empty() ? "" : "|") + command.name;
    }
    return fmt::format(R"bash(# Completion of drape for bash: source <(drape completions bash)
_drape() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words= command=
    if ((COMP_CWORD > 1)); then command=${{COMP_WORDS[1]}}; fi
    case $command in
    {}) if ((COMP_CWORD > 2)); then command+=" ${{COMP_WORDS[2]}}"; fi ;;
    esac
    case $command in
{}    esac
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o filenames -F _drape drape
)bash",
                       groups, cases);
}

namespace {

std::string zsh_action(const OptionText& option) {
    const std::string name = option.is_positional ? option.names.front() : option.value;
    std::string shown = name;
    for (char& c : shown)
        if (c == ':') c = ' ';
    if (const std::string words = choices(option); !words.empty()) return fmt::format(":{}:({})", shown, words);
    return fmt::format(":{}:{}", shown, is_folder(option) ? "_files -/" : is_file(option) ? "_files" : " ");
}

/// Returns an argument of _arguments, whose end brackets and colons of the help would be.
std::string zsh_argument(const OptionText& option, const std::string& name) {
    std::string help;
    for (const char c : brief(option.help)) {
        if (c == '[' || c == ']' || c == ':') help += '\\';
        help += c;
    }
    return quoted_word(fmt::format("*{}[{}]{}", name, help, option.value.empty() ? "" : zsh_action(option)));
}

std::string zsh_command(const std::vector<CommandText>& commands, const CommandText& command) {
    const std::string function = function_name(command);
    std::string text = fmt::format("{}() {{\n", function);
    if (command.is_group) {
        text += "    local -a members=(\n";
        for (const CommandText* member : members(commands, command.name))
            text += fmt::format("        {}\n",
                                quoted_word(fmt::format("{}:{}", last_word(member->name), member->summary)));
        text += "    )\n    if (( CURRENT == 2 )); then _describe command members; return; fi\n";
        text += fmt::format("    local name={}_$words[2]\n", function);
        return text + "    shift words; (( CURRENT-- ))\n    (( $+functions[$name] )) && $name\n}\n";
    }
    text += "    _arguments -s";
    for (const OptionText& option : command.options) {
        if (option.is_positional)
            text += " \\\n        " + quoted_word("*" + zsh_action(option));
        else
            for (const std::string& name : option.names) text += " \\\n        " + zsh_argument(option, name);
    }
    return text + "\n}\n";
}

}  // namespace

std::string zsh_completion(const std::vector<CommandText>& commands) {
    std::string text =
        "#compdef drape\n# Completion of drape for zsh: drape completions zsh > DIR/_drape, with DIR in $fpath\n";
    for (const CommandText& command : commands) text += zsh_command(commands, command);
    return text + "if [[ $zsh_eval_context[-1] == loadautofunc ]]; then _drape \"$@\"; else compdef _drape drape; fi\n";
}

std::string fish_completion(const std::vector<CommandText>& commands) {
    std::string text =
        "# Completion of drape for fish: drape completions fish > ~/.config/fish/completions/drape.fish\n"
        "complete -c drape -f\n";
    for (const CommandText& command : commands) {
        // The words written so far begin with the command's, and no member of a group follows.
        std::string condition;
        for (std::size_t begin = 0; begin < command.name.size();) {
            const std::size_t end = std::min(command.name.find(' ', begin), command.name.size());
            condition += fmt::format("{}__fish_seen_subcommand_from {}", condition.empty() ? "" : "; and ",
                                     command.name.substr(begin, end - begin));
            begin = end + 1;
        }
        std::string among;
        for (const CommandText* member : members(commands, command.name)) among += " " + last_word(member->name);
        if (command.name.empty()) condition = "__fish_use_subcommand";
        if (command.is_group && !command.name.empty()) condition += "; and not __fish_seen_subcommand_from" + among;
        const std::string begin = fmt::format("complete -c drape -n {}", quoted_word(condition));
        if (command.is_group)
            for (const CommandText* member : members(commands, command.name))
                text += fmt::format("{} -a {} -d {}\n", begin, last_word(member->name), quoted_word(member->summary));
        for (const OptionText& option : command.options) {
            std::string line = begin;
            if (!option.is_positional)
                for (const std::string& name : option.names)
                    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (const std::string words = choices(option); !words.empty())
                line += (option.is_positional ? " -a " : " -x -a ") + quoted_word(words);
            else if (is_folder(option))
                line += " -x -a '(__fish_complete_directories)'";
            else if (is_file(option))
                line += option.is_positional ? " -F" : " -r -F";
            else if (option.is_positional)
                continue;
            else if (!option.value.empty())
                line += " -x";
            text += line + " -d " + quoted_word(brief(option.help)) + "\n";
        }
    }
    return text;
}

}  // namespace drape::cli
