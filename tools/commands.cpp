#include "commands.h"

#include <fmt/format.h>
#include <json/json.h>

#include <csignal>
#include <cstdio>
#include <new>

#include "output/output_error.h"
#include "vulkan/instance.h"

namespace drape::cli {

namespace {

volatile std::sig_atomic_t signal_number = 0;

void remember_signal(int number) { signal_number = number; }

void print_error(const std::string& text) { fmt::print(stderr, "drape: {}\n", text); }

Json::Value json_error(const SceneError& error) {
    Json::Value value(Json::objectValue);
    value["file"] = error.file;
    value["line"] = error.line;
    value["column"] = error.column;
    value["pointer"] = error.pointer;
    value["message"] = error.message;
    return value;
}

void print_json(const Json::Value& value) {
    Json::StreamWriterBuilder builder;
    builder["indentation"] = "  ";
    fmt::print("{}\n", Json::writeString(builder, value));
}

ExitCode signal_code(int number) { return number == SIGTERM ? ExitCode::terminated : ExitCode::interrupted; }

}  // namespace

int caught_signal() { return signal_number; }

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = remember_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESETHAND;  // a second signal ends the program at once
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

ExitCode run(const RunRequest& request) {
    const RunSummary summary = run_scene(request);
    if (!summary.complete) {
        print_error(fmt::format("stopped by a signal after {} frames; no manifest was written", summary.frame_count));
        return signal_code(caught_signal());
    }
    if (summary.validation_count > 0) {
        print_error(fmt::format("{} validation messages", summary.validation_count));
        return ExitCode::validation;
    }
    if (!request.quiet) fmt::print(stderr, "{} frames in {}\n", summary.frame_count, request.output);
    return ExitCode::ok;
}

ExitCode graph(const SceneRequest& request, bool draw, const std::string& format) {
    fmt::print("{}", describe_graph(request, draw, format));
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
            if (!json) fmt::print(stderr, "{}\n", error.text());
        }
        for (const SceneError& warning : result.warnings) {
            row["warnings"].append(json_error(warning));
            if (!json) fmt::print(stderr, "warning: {}\n", warning.text());
        }
        report.append(row);
        if (!json && !quiet && result.scene) fmt::print("{}: ok\n", path);
    }
    if (json) print_json(report);
    return code;
}

ExitCode schema() {
    fmt::print("{}", scene_schema());
    return ExitCode::ok;
}

ExitCode devices(bool json) {
    const vulkan::Instance instance({});
    Json::Value list(Json::arrayValue);
    for (const vulkan::DeviceInfo& info : instance.devices()) {
        if (json) {
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
            list.append(row);
        } else {
            fmt::print("{}  {}  ({}, {} {}, Vulkan {})\n   uuid {}{}\n", info.index, info.name, info.type, info.driver,
                       info.driver_version, info.api_version, info.uuid_text(),
                       info.usable ? "" : "\n   not usable: " + info.unusable_reason);
        }
    }
    if (json) print_json(list);
    return ExitCode::ok;
}

ExitCode report_current_exception() {
    try {
        throw;
    } catch (const SceneFailure& failure) {
        fmt::print(stderr, "{}\n", failure.what());
        return failure.result().unreadable ? ExitCode::io : ExitCode::scene;
    } catch (const UsageError& error) {
        print_error(error.what());
        return ExitCode::usage;
    } catch (const OutputError& error) {
        print_error(error.what());
        return ExitCode::io;
    } catch (const vulkan::VulkanError& error) {
        print_error(error.what());
        return ExitCode::device;
    } catch (const std::bad_alloc&) {
        print_error("out of memory");
        return ExitCode::device;
    } catch (const std::exception& error) {
        print_error(fmt::format("internal error: {}", error.what()));
        return ExitCode::device;
    }
}

}  // namespace drape::cli
