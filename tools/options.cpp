#include "options.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <functional>

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

/// An option with a whole number; the message says what was expected.
CLI::Option* add_whole(CLI::App& command, const std::string& names, const std::string& long_name, std::uint32_t least,
                       const std::function<void(std::uint32_t)>& set, const std::string& help) {
    const auto parse = [=](const std::string& text) {
        const auto value = parse_whole(text, least, UINT32_MAX);
        if (!value)
            throw CLI::ValidationError(
                long_name, fmt::format("expected a whole number from {} to {}, got '{}'", least, UINT32_MAX, text));
        set(*value);
    };
    return command.add_option_function<std::string>(names, parse, help);
}

std::array<std::uint32_t, 2> parse_size(const std::string& text) {
    const std::size_t cross = text.find('x');
    if (cross != std::string::npos) {
        const auto width = parse_whole(std::string_view(text).substr(0, cross), 1, largest_side);
        const auto height = parse_whole(std::string_view(text).substr(cross + 1), 1, largest_side);
        if (width && height) return {*width, *height};
    }
    throw CLI::ValidationError(
        "--size", fmt::format("expected WIDTHxHEIGHT in pixels, 1 to {} each, got '{}'", largest_side, text));
}

std::string check_override(const std::string& text) {
    if (text.starts_with('/') && text.find('=') != std::string::npos) return {};
    return fmt::format("expected /json/pointer=value, got '{}'", text);
}

std::string check_format(const std::string& name) {
    const OutputFormat* format = find_output_format(name);
    return format && !format->draws ? std::string()
                                    : fmt::format("expected {}, got '{}'", undrawn_format_names(), name);
}

/// A paragraph per format that needs no picture.
std::string format_help() {
    std::string text;
    for (const OutputFormat* format : output_formats()) {
        std::string help(format->help);
        for (std::size_t end = help.find('\n'); end != std::string::npos; end = help.find('\n', end + 1))
            help.insert(end + 1, 5, ' ');
        if (!format->draws) text += fmt::format("\n{:5}{}", format->name, help);
    }
    return text;
}

/// --export: beside the pictures, or instead of what `request` has.
void add_export_option(CLI::App& command, RunRequest& request) {
    const auto set = [&request](const std::vector<std::string>& names) {
        if (!request.draws()) request.formats.clear();
        request.formats.insert(request.formats.end(), names.begin(), names.end());
    };
    command
        .add_option_function<std::vector<std::string>>(
            "--export", set,
            (request.draws() ? "What to write beside the pictures; default: nothing" : "What to write; default: npy") +
                format_help())
        ->delimiter(',')
        ->type_name("FORMAT,...")
        ->check(check_format, "");
}

}  // namespace

void add_override_option(CLI::App& command, std::vector<std::string>& overrides) {
    CLI::Option* option = command.add_option("--set", overrides,
                                             "Replace a value of the scene, as in /solver/substeps=40 or\n"
                                             "/wind/velocity=[1,0,0]; repeatable, applied in order");
    option->allow_extra_args(false)->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    option->type_name("/POINTER=VALUE")->check(check_override, "");
}

void add_device_option(CLI::App& command, std::string& device) {
    command
        .add_option("--device", device,
                    "INDEX, UUID, unique part of the NAME, or cpu (`drape devices` lists them);\n"
                    "default: a GPU when there is one")
        ->type_name("DEVICE");
}

void add_validate_option(CLI::App& command, bool& validate) {
    command.add_flag("--validate", validate,
                     "Core and synchronization validation by the Khronos layer: each message on\n"
                     "stderr, and exit code 6 when there was one");
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
}

void add_image_options(CLI::App& command, SceneRequest& scene) {
    command
        .add_option_function<std::string>(
            "--size", [&scene](const std::string& text) { scene.image_size = parse_size(text); },
            "Picture size in pixels, 1 to 16384 a side; default: the scene's, else 1280x720")
        ->type_name("WIDTHxHEIGHT");
    const auto set_samples = [&scene](const std::string& text) {
        if (text != "1" && text != "4")
            throw CLI::ValidationError("--samples", fmt::format("expected 1 or 4, got '{}'", text));
        scene.samples = text == "1" ? 1 : 4;
    };
    command
        .add_option_function<std::string>("--samples", set_samples,
                                          "Samples per pixel, 1 or 4; default: the scene's, else 4")
        ->type_name("N");
}

void add_run_options(CLI::App& command, RunRequest& request) {
    add_scene_options(command, request.scene);
    command
        .add_option("-o,--output", request.output,
                    "Folder for the results, made when missing; refused when not empty without\n"
                    "--overwrite or --resume")
        ->required()
        ->type_name("DIR");
    add_whole(
        command, "-s,--start", "--start", 0, [&request](std::uint32_t value) { request.start = value; },
        "First frame to write; default: 0, the initial state. Frame n shows the time\n"
        "n/fps seconds")
        ->type_name("FRAME");
    add_whole(
        command, "-e,--end", "--end", 0, [&request](std::uint32_t value) { request.end = value; },
        "Last frame to write, inclusive; default, and at most: the scene's last")
        ->type_name("FRAME");
    add_whole(
        command, "-j,--step", "--step", 1, [&request](std::uint32_t value) { request.step = value; },
        "Write every N-th frame, counted from --start; default: 1. All frames up to\n"
        "the last one are simulated")
        ->type_name("N");
    add_export_option(command, request);
    CLI::Option* overwrite = command.add_flag_callback(
        "--overwrite", [&request] { request.existing = ExistingFiles::overwrite; },
        "Replace the files an earlier run wrote there; others stay");
    command
        .add_flag_callback(
            "--resume", [&request] { request.existing = ExistingFiles::resume; },
            request.draws() ? "Keep the pictures that an unfinished run of the same scene, size, samples,\n"
                              "program, device and driver left there, and draw the missing ones; the result\n"
                              "has the bytes of an undisturbed run. Refused, changing nothing, when a\n"
                              "picture there is any other's"
                            : "Run again in the folder of an unfinished run of the same scene, program,\n"
                              "device and driver: arrays appear only when complete")
        ->excludes(overwrite);
    CLI::Option* quiet = command.add_flag("-q,--quiet", request.quiet, "No progress, only warnings and errors");
    command.add_flag("-v,--verbose", request.verbose, "Say which device, driver, plan and how much memory")
        ->excludes(quiet);
}

void add_accuracy_options(CLI::App& command, bench::AccuracyRequest& request) {
    command
        .add_option("--filter", request.filter,
                    "Only cases whose name contains this regular expression; names are\n"
                    "PROBLEM/N/METHOD/SUBSTEPS or .../SUBSTEPSxITERATIONS, as in swing/64/relax/20;\n"
                    "default: all")
        ->type_name("REGEX");
    command.add_flag("--short", request.is_short, "A few small cases of every problem: under 3 minutes");
    command
        .add_option("--folder", request.folder,
                    "Where finished cases and references are kept: the same command goes on from\n"
                    "there, and only what has changed is measured again; default: bench")
        ->type_name("DIR");
    const auto check_minutes = [](const std::string& text) {
        char* end = nullptr;
        const double minutes = std::strtod(text.c_str(), &end);
        return end != text.c_str() && *end == 0 && minutes > 0 && minutes < 1e6
                   ? std::string()
                   : "expected minutes above 0, got '" + text + "'";
    };
    command
        .add_option("--budget", request.budget_minutes,
                    "Start no case that would end later than after so many minutes, the important\n"
                    "cases first; default: no limit")
        ->type_name("MINUTES")
        ->check(check_minutes, "");
    command.add_option("--json", request.json, "Write results, orders, limits and ratios as JSON")->type_name("FILE");
    command.add_option("--csv", request.csv, "Write a row per case")->type_name("FILE");
    command.add_option("--svg", request.svg, "Write plots of error against time, passes, substeps and N")
        ->type_name("DIR");
    add_device_option(command, request.device);
    add_validate_option(command, request.validate);
    command.add_flag("-q,--quiet", request.quiet, "No progress");
}

}  // namespace drape::cli
