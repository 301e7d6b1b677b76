// The options of commands: how one is made, and those that several commands share, with their help texts and checks.
// Only program.cpp and options.cpp see the parser itself: it costs every file that includes it seconds to compile.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "run/run.h"

namespace CLI {
class App;
}

namespace drape::cli {

void add_flag(CLI::App& command, const std::string& names, const std::string& help, bool& value);

/// Takes an option's text; returns what is wrong with it, or nothing.
using SetText = std::function<std::string(const std::string& text)>;

/// `names`: "-s,--start"; `type`: what the help calls its value.
void add_option(CLI::App& command, const std::string& names, const char* type, const std::string& help,
                const SetText& set);
void add_option(CLI::App& command, const std::string& names, const char* type, const std::string& help,
                std::string& value);

/// Takes a whole number, at least `least`, or says what was expected.
SetText whole_number(std::uint32_t least, const std::function<void(std::uint32_t)>& set);
/// Takes the same for a variable, which must outlive the parser.
template <class Value>
SetText whole(std::uint32_t least, Value& value) {
    return whole_number(least, [&value](std::uint32_t number) { value = number; });
}

inline constexpr double above_zero = std::numeric_limits<double>::min();
/// Takes a number from `least` to `most`, or says that it `expected` another.
SetText number(const std::string& expected, double least, double most, const std::function<void(double)>& set);
/// Takes any number that is not negative, for a variable, which must outlive the parser.
SetText not_negative(std::optional<double>& value);

/// Adds an option that is one of a few words; `set` is told its place among them.
void add_choice(CLI::App& command, const std::string& names, const std::vector<std::string>& words,
                const std::string& help, const std::function<void(std::size_t)>& set);

/// Takes any number of words by their place on the command line.
void add_word_list(CLI::App& command, const char* name, const std::string& help, std::vector<std::string>& words);
/// Takes SCENE..., at least one, or folders of them.
void add_scene_list(CLI::App& command, std::vector<std::string>& paths);
/// Replaces each folder by the .json files in it, by name. Throws UsageError where there are none.
std::vector<std::string> scene_files(const std::vector<std::string>& paths);
/// Takes a file, or a word, by its place on the command line.
void add_required_file(CLI::App& command, const char* name, const std::string& help, std::string& path);
/// Takes one file or none; `help` says what happens then.
void add_optional_file(CLI::App& command, const char* name, const std::string& help, std::string& path);
/// Adds --set.
void add_override_option(CLI::App& command, std::vector<std::string>& overrides);
/// Adds --export, with the formats that need no picture.
void add_format_option(CLI::App& command, const std::string& help, std::vector<std::string>& formats);
/// Adds --compress.
void add_compress_option(CLI::App& command, bool& deflates);
/// Adds --device.
void add_device_option(CLI::App& command, std::string& device);
/// Adds --device, which may be repeated.
void add_devices_option(CLI::App& command, std::vector<std::string>& devices);
/// Adds --validate.
void add_validate_option(CLI::App& command, bool& validate);
/// SCENE, --set, --device, --validate, --no-skip, --kernels
void add_scene_options(CLI::App& command, SceneRequest& scene);
/// Adds --size.
void add_size_option(CLI::App& command, SceneRequest& scene);
/// Adds --size, --samples, --motion-blur, --draft, --view, --view-range.
void add_image_options(CLI::App& command, SceneRequest& scene);
/// Adds the options of add_scene_options and those for folder, frames, formats and messages.
void add_run_options(CLI::App& command, RunRequest& request);

}  // namespace drape::cli
