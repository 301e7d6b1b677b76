#include <fmt/format.h>
#include <fmt/ranges.h>
#include <json/json.h>

#include "drape/device.h"
#include "options.h"
#include "output/json_text.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

namespace {

Json::Value json_device(const DeviceInfo& info) {
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
    row["without"] = Json::Value(Json::arrayValue);
    for (const std::string& name : info.lacks) row["without"].append(name);
    return row;
}

ExitCode list_devices(bool json) {
    const std::vector<DeviceInfo> devices = Device::list();
    Json::Value list(Json::arrayValue);
    std::string text;
    for (const DeviceInfo& info : devices) {
        list.append(json_device(info));
        text += fmt::format("{}: {} ({})\n   {} {}, Vulkan {}\n   UUID {}\n{}{}", info.index, info.name, info.type,
                            info.driver, info.driver_version, info.api_version, info.uuid_text(),
                            info.usable ? "" : "   cannot be used: " + info.unusable_reason + "\n",
                            info.lacks.empty() ? "" : fmt::format("   used without {}\n", fmt::join(info.lacks, ", ")));
    }
    print_data(json ? json_text(list) : text);
    if (!devices.empty()) return ExitCode::ok;
    print_error("no Vulkan device found");
    return ExitCode::device;
}

}  // namespace

void add_devices(Program& program) {
    const auto json = std::make_shared<bool>(false), needs = std::make_shared<bool>(false);
    const auto run = [=] {
        if (!*needs) return list_devices(*json);
        print_data(Device::requirements());
        return ExitCode::ok;
    };
    CLI::App& command = program.add("devices", "List the Vulkan devices, and why one cannot be used",
                                    "\nExample:\n  drape devices --json\n", run);
    add_flag(command, "--json", "As JSON", *json);
    add_flag(command, "--needs", "Instead: what a device must have, as Markdown", *needs);
}

}  // namespace drape::cli
