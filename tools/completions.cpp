#include <fmt/format.h>

#include <algorithm>

#include "scene_templates.h"
#include "shell_words.h"

namespace drape::cli {

namespace {

constexpr const char* files = ":files\n";
constexpr const char* folders = ":folders\n";

/// Returns a word of a menu with what there is room for of its help: up to the first semicolon, colon, sentence or
/// line.
std::string offer(std::string_view word, std::string_view help) {
    std::size_t end = help.find('\n');
    for (const char* mark : {"; ", ": ", ". "}) end = std::min(end, help.find(mark));
    return fmt::format("{}\t{}\n", word, help.substr(0, end));
}

/// Returns the values of an option or a place: one of a few words, a folder, a file, or whatever the user thinks of.
std::string values(const OptionText& option) {
    const std::string& kind = option.is_positional ? option.names.front() : option.value;
    std::string text;
    if (kind == "TEMPLATE")
        for (const SceneTemplate& each : scene_templates()) text += offer(each.name, each.summary);
    if (kind == "SHELL") text = "bash\nzsh\nfish\n";
    if (kind.find('|') != std::string::npos) {
        text = kind + "\n";
        std::ranges::replace(text, '|', '\n');
    }
    if (kind == "DIR") return folders;
    const bool is_file = std::ranges::count(std::array{"FILE", "SCENE", "SPEC", "BEFORE", "AFTER"}, kind) > 0;
    return is_file ? files : text;
}

}  // namespace

std::string completions(const std::vector<CommandText>& commands, const std::vector<std::string>& words) {
    const std::string before = words.size() > 1 ? words[words.size() - 2] : "",
                      word = words.empty() ? "" : words.back();
    const CommandText* command = &commands.front();
    const auto member = [&](const CommandText& each) {
        const std::string group = command->name.empty() ? "" : command->name + " ";
        return each.name.size() > group.size() && each.name.starts_with(group) &&
                       each.name.find(' ', group.size()) == std::string::npos
                   ? each.name.substr(group.size())
                   : "";
    };
    for (std::size_t k = 0; k + 1 < words.size(); ++k) {
        const auto found = std::ranges::find(commands, words[k], member);
        if (!words[k].empty() && found != commands.end()) command = &*found;
    }
    std::string members, options, place;
    for (const CommandText& each : commands)
        if (const std::string name = member(each); !name.empty()) members += offer(name, each.summary);
    for (const OptionText& option : command->options) {
        const bool is_named = !option.is_positional;
        if (is_named && !option.value.empty() && std::ranges::count(option.names, before) > 0) return values(option);
        if (is_named) options += offer(option.names.back(), option.help);
        if (!is_named && place.empty()) place = values(option);
    }
    if (word.starts_with('-')) return options;
    return !members.empty() ? members : place.empty() ? options : place;
}

std::string completion_script(const std::string& shell) {
    if (shell == "bash")
        return R"bash(# Completion of drape for bash: source <(drape completions bash)
_drape() {
    local IFS=$'\n' word=${COMP_WORDS[COMP_CWORD]}
    local offers=$("${COMP_WORDS[0]}" completions words -- "${COMP_WORDS[@]:1:COMP_CWORD}")
    case $offers in
    :files) COMPREPLY=($(compgen -f -- "$word")) ;;
    :folders) COMPREPLY=($(compgen -d -- "$word")) ;;
    *) COMPREPLY=($(compgen -W "$(cut -f 1 <<< "$offers")" -- "$word")) ;;
    esac
}
complete -o filenames -F _drape drape
)bash";
    if (shell == "zsh")
        return R"zsh(#compdef drape
# Completion of drape for zsh: drape completions zsh > DIR/_drape, with DIR in $fpath
_drape() {
    local line
    local -a offers
    for line in ${(f)"$($words[1] completions words -- "${(@)words[2,CURRENT]}")"}; do
        case $line in
        :files) _files ;;
        :folders) _files -/ ;;
        *) offers+=("${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}") ;;
        esac
    done
    (( $#offers )) && _describe -o drape offers
}
if [[ $zsh_eval_context[-1] == loadautofunc ]]; then _drape "$@"; else compdef _drape drape; fi
)zsh";
    if (shell == "fish")
        return R"fish(# Completion of drape for fish: drape completions fish > ~/.config/fish/completions/drape.fish
function __drape_completions
    set -l words (commandline -opc)
    for line in ($words[1] completions words -- $words[2..] (commandline -ct))
        switch $line
            case :files
                __fish_complete_path (commandline -ct)
            case :folders
                __fish_complete_directories (commandline -ct)
            case '*'
                echo $line
        end
    end
end
complete -c drape -f -a '(__drape_completions)'
)fish";
    return {};
}

}  // namespace drape::cli
