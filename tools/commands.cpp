#include "commands.h"

#include <fmt/format.h>
#include <json/json.h>

#include <csignal>
#include <new>

#include "output/json_text.h"
#include "output/output_error.h"
#include "streams.h"
#include "vulkan/instance.h"

namespace drape::cli {

namespace {

volatile std::sig_atomic_t signal_number = 0;

void remember_signal(int number) { signal_number = number; }

/// From here on SIGINT and SIGTERM are remembered; a second one ends the program at once.
void catch_signals() {
    struct sigaction action {};
    action.sa_handler = remember_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESETHAND;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

void print_error(const std::string& text) { print_message("drape: " + text); }

std::string frame_count_text(std::uint64_t count) { return fmt::format("{} frame{}", count, count == 1 ? "" : "s"); }

ExitCode report_stop(const RunRequest& request, const RunSummary& summary) {
    const bool terminated = signal_number == SIGTERM;
    std::string left;
    if (summary.dropped.size() < request.formats.size())
        left = fmt::format("{} in {}; ", frame_count_text(summary.frame_count + summary.kept_count), request.output);
    if (!summary.dropped.empty()) left += fmt::format("{}, incomplete, dropped; ", fmt::join(summary.dropped, ", "));
    print_error(fmt::format("stopped by {}: {}no manifest was written{}", terminated ? "SIGTERM" : "SIGINT", left,
                            request.draws() ? "; --resume draws the missing ones" : ""));
    return terminated ? ExitCode::terminated : ExitCode::interrupted;
}

Json::Value json_error(const SceneError& error) {
    Json::Value value(Json::objectValue);
    value["file"] = error.file;
    value["line"] = error.line;
    value["column"] = error.column;
    value["pointer"] = error.pointer;
    value["message"] = error.message;
    return value;
}

Json::Value json_device(const vulkan::DeviceInfo& info) {
    Json::Value row(Json::objectValue);
    row["index"] = info.index;
    row["name"] = info.name;
    row["type"] = info.type;
    row["driver"] = info.driver;
    row["driver_version"] = info.driver_version;
    row["api_version"] = info.api_version;
    row["uuid"] = info.uuid_text();
    row["usable"] = info.usable;
    if (!info.usable) row["unusable_reason"] = info.unusable_reason;
    return row;
}

std::string vulkan_hint(const vulkan::VulkanError& error) {
    if (error.result() != VK_ERROR_INCOMPATIBLE_DRIVER) return {};
    return "\n  A driver that runs on any CPU is in Debian's package mesa-vulkan-drivers; VK_ICD_FILENAMES, "
           "if set, "
           "must name existing driver files.";
}

}  // namespace

ExitCode run(RunRequest request) {
    catch_signals();
    request.stop = [] { return signal_number != 0; };
    request.message = print_message;
    const RunSummary summary = run_scene(request);
    if (!summary.complete) return report_stop(request, summary);
    if (summary.validation_count > 0) {
        print_error(fmt::format("{} validation messages", summary.validation_count));
        return ExitCode::validation;
    }
    if (!request.quiet) {
        const std::string kept =
            summary.kept_count > 0 ? fmt::format(" ({} of them kept)", summary.kept_count) : std::string();
        print_message(fmt::format("{} in {}{}", frame_count_text(summary.frame_count + summary.kept_count),
                                  request.output, kept));
    }
    return ExitCode::ok;
}

ExitCode graph(const SceneRequest& request, bool draw, const std::string& format) {
    print_data(describe_graph(request, draw, format));
    return ExitCode::ok;
}

ExitCode check(const std::vector<std::string>& paths, const std::vector<std::string>& overrides, bool json,
               bool quiet) {
    ExitCode code = ExitCode::ok;
    Json::Value report(Json::arrayValue);
    for (const std::string& path : paths) {
        const SceneResult result = read_scene(path, overrides);
        if (!result.scene) code = result.unreadable || code == ExitCode::io ? ExitCode::io : ExitCode::scene;
        Json::Value row(Json::objectValue);
        row["file"] = path;
        row["ok"] = result.scene.has_value();
        row["errors"] = row["warnings"] = Json::Value(Json::arrayValue);
        for (const SceneError& error : result.errors) {
            row["errors"].append(json_error(error));
            if (!json) print_message(error.text());
        }
        for (const SceneError& warning : result.warnings) {
            row["warnings"].append(json_error(warning));
            if (!json) print_message("warning: " + warning.text());
        }
        report.append(row);
        if (!json && !quiet && result.scene) print_data(path + ": ok\n");
    }
    if (json) print_data(json_text(report));
    return code;
}

ExitCode schema() {
    print_data(scene_schema());
    return ExitCode::ok;
}

ExitCode devices(bool json) {
    const vulkan::Instance instance({});
    Json::Value list(Json::arrayValue);
    std::string text;
    for (const vulkan::DeviceInfo& info : instance.devices()) {
        list.append(json_device(info));
        text += fmt::format("{}: {} ({})\n   {} {}, Vulkan {}\n   UUID {}\n{}", info.index, info.name, info.type,
                            info.driver, info.driver_version, info.api_version, info.uuid_text(),
                            info.usable ? "" : "   cannot be used: " + info.unusable_reason + "\n");
    }
    print_data(json ? json_text(list) : text);
    if (!instance.devices().empty()) return ExitCode::ok;
    print_error("no Vulkan device found");
    return ExitCode::device;
}

ExitCode bench_accuracy(bench::AccuracyRequest request) {
    catch_signals();
    request.stop = [] { return signal_number != 0; };
    request.message = print_message;
    const bench::AccuracySummary summary = bench::run_accuracy(request);
    if (summary.stopped) {
        const bool terminated = signal_number == SIGTERM;
        print_error(fmt::format("stopped by {}: the finished cases are kept in {}; the same command goes on from there",
                                terminated ? "SIGTERM" : "SIGINT", request.folder.string()));
        return terminated ? ExitCode::terminated : ExitCode::interrupted;
    }
    print_data(summary.text);
    if (!request.quiet)
        print_message(fmt::format("{} cases measured, {} kept from before, {} left out by --budget",
                                  summary.measured_count, summary.kept_count, summary.left_out_count));
    if (summary.validation_count == 0) return ExitCode::ok;
    print_error(fmt::format("{} validation messages", summary.validation_count));
    return ExitCode::validation;
}

ExitCode report_current_exception() {
    try {
        throw;
    } catch (const ReaderGone&) {
        return ExitCode::io;
    } catch (const SceneFailure& failure) {
        print_message(failure.what());
        return failure.result().unreadable ? ExitCode::io : ExitCode::scene;
    } catch (const UsageError& error) {
        print_error(error.what());
        return ExitCode::usage;
    } catch (const OutputError& error) {
        print_error(error.what());
        return ExitCode::io;
    } catch (const Diverged& error) {
        print_error(fmt::format("{}; no manifest was written", error.what()));
        return ExitCode::diverged;
    } catch (const ToleranceMissed& error) {
        print_error(fmt::format("{}; no manifest was written", error.what()));
        return ExitCode::tolerance;
    } catch (const vulkan::VulkanError& error) {
        print_error(error.what() + vulkan_hint(error));
        return ExitCode::device;
    } catch (const std::bad_alloc&) {
        print_error("out of memory");
        return ExitCode::device;
    } catch (const std::exception& error) {
        print_error(fmt::format("internal error: {}", error.what()));
        return ExitCode::internal;
    }
}

}  // namespace drape::cli
