#include "options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <filesystem>

#include "output/frame_writer.h"

namespace drape::cli {

namespace {

constexpr std::uint32_t largest_side = 16384;

std::optional<std::uint32_t> parse_whole(std::string_view text, std::uint32_t least, std::uint32_t most) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < least || value > most) return std::nullopt;
    return value;
}

std::string set_size(const std::string& text, SceneRequest& scene) {
    const std::size_t cross = text.find('x');
    if (cross != std::string::npos) {
        const auto width = parse_whole(std::string_view(text).substr(0, cross), 1, largest_side);
        const auto height = parse_whole(std::string_view(text).substr(cross + 1), 1, largest_side);
        if (width && height) {
            scene.image_size = {*width, *height};
            return {};
        }
    }
    return fmt::format("expected WIDTHxHEIGHT in pixels, 1 to {} each, got '{}'", largest_side, text);
}

std::string check_override(const std::string& text) {
    if (text.starts_with('/') && text.find('=') != std::string::npos) return {};
    return fmt::format("expected /json/pointer=value, got '{}'", text);
}

/// Returns a paragraph per format that --export takes.
std::string format_help(bool drawn) {
    std::string text;
    for (const OutputFormat* format : output_formats())
        if (exported(*format, drawn)) text += fmt::format("\n{:10}{}: {}", format->name, format->files, format->holds);
    return text;
}

void add_formats(CLI::App& command, const std::string& help, bool drawn,
                 const std::function<void(const std::vector<std::string>&)>& set) {
    const auto check = [drawn](const std::string& name) {
        const OutputFormat* format = find_output_format(name);
        return format && exported(*format, drawn)
                   ? std::string()
                   : fmt::format("expected {}, got '{}'", export_format_names(drawn), name);
    };
    command.add_option_function<std::vector<std::string>>("--export", set, help + format_help(drawn))
        ->delimiter(',')
        ->allow_extra_args(false)  // the next word is the scene
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("FORMAT,...")
        ->check(check, "");
}

/// Adds --export, whose formats come beside the pictures, or instead of what `request` has.
void add_export_option(CLI::App& command, RunRequest& request) {
    const bool drawn = request.draws();
    const auto set = [&request, drawn](const std::vector<std::string>& names) {
        if (!drawn) request.formats.clear();
        request.formats.insert(request.formats.end(), names.begin(), names.end());
    };
    add_formats(command,
                drawn ? "What to write beside the pictures; default: nothing"
                      : "What to write; default: " + fmt::format("{}", fmt::join(request.formats, ",")),
                drawn, set);
}

/// Adds --view, --view-range.
void add_view_options(CLI::App& command, PictureView& view) {
    std::vector<std::string> words;
    for (const auto& [name, kind] : view_spellings) words.emplace_back(name);
    add_choice(command, "--view", words,
               "What pictures show of the cloths. stretch: the largest strain of the springs at each particle, as a "
               "heat map with its legend; warp, weft: strain along the cloth's u (growing column) or v (growing row), "
               "also when pressed together; wire: triangles; normals: 0.5 + 0.5 n of the side in view, in world axes, "
               "as sRGB. Default: shaded",
               [&view](std::size_t place) { view.kind = view_spellings[place].value; });
    add_option(command, "--view-range", "PERCENT",
               "Strain at the end of the heat map, the same in every frame; what is beyond it has the end's colour. "
               "Default: a logarithmic scale that ends by weight, wind and stiffness of the scene",
               number("a strain in percent, above 0 and at most 1000", above_zero, 1000,
                      [&view](double percent) { view.range = percent / 100; }));
}

}  // namespace

SetText whole_number(std::uint32_t least, const std::function<void(std::uint32_t)>& set) {
    return [=](const std::string& text) {
        const auto value = parse_whole(text, least, UINT32_MAX);
        if (!value) return fmt::format("expected a whole number from {} to {}, got '{}'", least, UINT32_MAX, text);
        set(*value);
        return std::string();
    };
}

SetText number(const std::string& expected, double least, double most, const std::function<void(double)>& set) {
    return [=](const std::string& text) {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_number = error == std::errc{} && end == text.data() + text.size();
        if (!is_number || !(value >= least && value <= most))
            return fmt::format("expected {}, got '{}'", expected, text);
        set(value);
        return std::string();
    };
}

SetText not_negative(std::optional<double>& value) {
    return number("a number, not negative", 0, std::numeric_limits<double>::max(),
                  [&value](double taken) { value = taken; });
}

void add_choice(CLI::App& command, const std::string& names, const std::vector<std::string>& words,
                const std::string& help, const std::function<void(std::size_t)>& set) {
    const auto take = [=](const std::string& text) {
        const auto found = std::ranges::find(words, text);
        if (found == words.end()) return fmt::format("expected {}, got '{}'", fmt::join(words, " or "), text);
        set(static_cast<std::size_t>(found - words.begin()));
        return std::string();
    };
    add_option(command, names, fmt::format("{}", fmt::join(words, "|")).c_str(), help, take);
}

void add_flag(CLI::App& command, const std::string& names, const std::string& help, bool& value) {
    command.add_flag(names, value, help);
}

void add_option(CLI::App& command, const std::string& names, const char* type, const std::string& help,
                const SetText& set) {
    const auto take = [set, name = names.substr(names.find("--"))](const std::string& text) {
        if (const std::string wrong = set(text); !wrong.empty()) throw CLI::ValidationError(name, wrong);
    };
    command.add_option_function<std::string>(names, take, help)->type_name(type);
}

void add_option(CLI::App& command, const std::string& names, const char* type, const std::string& help,
                std::string& value) {
    command.add_option(names, value, help)->type_name(type);
}

void add_word_list(CLI::App& command, const char* name, const std::string& help, std::vector<std::string>& words) {
    command.add_option(name, words, help)->type_name("");
}

void add_scene_list(CLI::App& command, std::vector<std::string>& paths) {
    command.add_option("SCENE", paths, "Scene files, or folders of them")->required()->type_name("");
}

std::vector<std::string> scene_files(const std::vector<std::string>& paths) {
    std::vector<std::string> found;
    for (const std::string& path : paths) {
        std::error_code error;
        if (!std::filesystem::is_directory(path, error)) {
            found.push_back(path);
            continue;
        }
        const std::size_t before = found.size();
        for (const auto& entry : std::filesystem::directory_iterator(path, error))
            if (entry.path().extension() == ".json" && entry.is_regular_file(error)) found.push_back(entry.path());
        if (found.size() == before) throw UsageError(fmt::format("no .json file in {}", path));
        std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end());
    }
    return found;
}

void add_required_file(CLI::App& command, const char* name, const std::string& help, std::string& path) {
    command.add_option(name, path, help)->required()->type_name("");
}

void add_optional_file(CLI::App& command, const char* name, const std::string& help, std::string& path) {
    command.add_option(name, path, help)->type_name("");
}

void add_override_option(CLI::App& command, std::vector<std::string>& overrides) {
    CLI::Option* option =
        command.add_option("--set", overrides,
                           "Replace a value of the scene, as in /solver/substeps=40 or "
                           "/wind/velocity=[1,0,0]; - in place of an index appends; repeatable, applied in order");
    option->allow_extra_args(false)->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    option->type_name("/POINTER=VALUE")->check(check_override, "");
}

void add_compress_option(CLI::App& command, bool& deflates) {
    add_flag(command, "--compress", "Pack the archives of npz, which numpy.load reads as well: about a fifth smaller",
             deflates);
}

void add_format_option(CLI::App& command, const std::string& help, std::vector<std::string>& formats) {
    add_formats(command, help, false, [&formats](const std::vector<std::string>& names) { formats = names; });
}

namespace {
constexpr const char* device_help =
    "INDEX, UUID, unique part of the NAME, or cpu (`drape devices` lists them); default: what the environment variable "
    "DRAPE_DEVICE says, else a GPU when there is one";
}  // namespace

void add_device_option(CLI::App& command, std::string& device) {
    add_option(command, "--device", "DEVICE", device_help, device);
}

void add_devices_option(CLI::App& command, std::vector<std::string>& devices) {
    command.add_option("--device", devices, std::string(device_help) + "; repeated: processes take them in turn")
        ->type_name("DEVICE")
        ->allow_extra_args(false)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_validate_option(CLI::App& command, bool& validate) {
    add_flag(command, "--validate",
             "Core and synchronization validation by the Khronos layer: each message on stderr, and exit code 6 when "
             "there was one",
             validate);
}

void add_scene_options(CLI::App& command, SceneRequest& scene) {
    command.add_option("SCENE", scene.path, "Scene file: JSON, with // comments (`drape schema` prints its schema)")
        ->required()
        ->type_name("");
    add_override_option(command, scene.overrides);
    add_device_option(command, scene.device);
    add_validate_option(command, scene.validate);
    command.add_flag_callback(
        "--no-skip", [&scene] { scene.skip = false; },
        "Do the work that is skipped because it changes no bit of the result");
    add_option(
        command, "--kernels", "plain|auto|NAME,...",
        "The shaders that do a step's work: `plain` runs one pass per step, `auto` (the default) takes faster ones "
        "that "
        "suit the device and the scene, to the same bits but for those of lines; `drape graph` names them and says "
        "why each is used or not",
        [&scene](const std::string& text) {
            const auto kernels = Kernels::parse(text);
            if (!kernels) {
                std::string names = "auto";
                for (const KernelName& row : kernel_names) names += ", " + std::string(row.name);
                return fmt::format("expected names of kernels ({}), got '{}'", names, text);
            }
            scene.kernels = *kernels;
            return std::string();
        });
}

void add_size_option(CLI::App& command, SceneRequest& scene) {
    add_option(command, "--size", "WIDTHxHEIGHT",
               "Picture size in pixels, 1 to 16384 a side; default: the scene's, else 1280x720",
               [&scene](const std::string& text) { return set_size(text, scene); });
}

void add_image_options(CLI::App& command, SceneRequest& scene) {
    add_size_option(command, scene);
    add_view_options(command, scene.view);
    add_choice(command, "--samples", {"1", "4"}, "Samples per pixel; default: the scene's, else 4",
               [&scene](std::size_t place) { scene.samples = place == 0 ? 1 : 4; });
    add_option(
        command, "--motion-blur", "N",
        "Draw each picture at N moments, 1 to 256, of half the time from frame to frame, and take their mean: N times "
        "as long; default: the scene's, else 1",
        [&scene](const std::string& text) {
            scene.motion_blur = parse_whole(text, 1, 256);
            return scene.motion_blur ? std::string()
                                     : fmt::format("expected a whole number from 1 to 256, got '{}'", text);
        });
    add_flag(command, "--draft",
             "Pictures of half the scene's width and height with one sample per pixel and no motion blur, unless "
             "--size, --samples or --motion-blur say otherwise: about four times as fast to draw",
             scene.draft);
}

void add_run_options(CLI::App& command, RunRequest& request) {
    add_scene_options(command, request.scene);
    command
        .add_option(
            "-o,--output", request.output,
            request.draws()
                ? "Folder for the results, made when missing; refused when not empty without --overwrite or --resume. "
                  "- instead: video on stdout, y4m or what --export says, and nothing else"
                : "Folder for the results, made when missing; refused when not empty without --overwrite or --resume")
        ->required()
        ->type_name("DIR");
    add_option(command, "-s,--start", "FRAME",
               "First frame to write; default: 0, the initial state. Frame n shows the time n/fps seconds",
               whole(0, request.start));
    add_option(command, "-e,--end", "FRAME", "Last frame to write, inclusive; default, and at most: the scene's last",
               whole(0, request.end));
    add_option(command, "-j,--step", "N",
               "Write every N-th frame, counted from --start; default: 1. All frames up to the last one are simulated",
               whole(1, request.step));
    add_choice(command, "--on-failure", {"stop", "keep"},
               "At a frame that is not plausible or misses its tolerance: stop, or keep it and go on to the end, with "
               "the same exit code; default: stop",
               [&request](std::size_t place) { request.keep_failed = place == 1; });
    add_export_option(command, request);
    add_compress_option(command, request.deflates);
    CLI::Option* overwrite = command.add_flag_callback(
        "--overwrite", [&request] { request.existing = ExistingFiles::overwrite; },
        "Replace the files an earlier run wrote there; others stay");
    command
        .add_flag_callback(
            "--resume", [&request] { request.existing = ExistingFiles::resume; },
            request.draws()
                ? "Go on with an unfinished run of the same scene, size, samples, view, program, device and driver: "
                  "from its newest checkpoint, or, without one, keeping its pictures, from frame 0. The result has the "
                  "bytes of an undisturbed run. Refused, changing nothing, when a picture or checkpoint there is "
                  "another run's or damaged"
                : "Go on with an unfinished run of the same scene, program, device and driver: from its newest "
                  "checkpoint, or, without one, from frame 0. The result has the bytes of an undisturbed run. Refused, "
                  "changing nothing, when a checkpoint there is another run's or damaged")
        ->excludes(overwrite);
    add_option(command, "--checkpoint", "SECONDS|never",
               "How often what it takes to go on is written beside the results, and where the run is stopped by a "
               "signal; --resume goes on from there. Gone when the run is done. Default: 60",
               [&request](const std::string& text) {
                   request.checkpoint_interval.reset();
                   if (text == "never") return std::string();
                   const auto set = [&request](double seconds) { request.checkpoint_interval = seconds; };
                   return number("seconds, 0 or more, or never", 0, 1e9, set)(text);
               });
    CLI::Option* quiet = command.add_flag("-q,--quiet", request.quiet, "No progress, only warnings and errors");
    command.add_flag("-v,--verbose", request.verbose, "Say which device, driver, plan and how much memory")
        ->excludes(quiet);
}

}  // namespace drape::cli
