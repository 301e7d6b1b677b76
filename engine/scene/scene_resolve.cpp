#include <fmt/format.h>
#include <json/writer.h>

#include <algorithm>
#include <set>

#include "drape/scene_reader.h"
#include "scene/scene_node.h"

namespace drape {
namespace {

/// Finds the defaults of one scene by reading it, adding what is missing, and reading again: a default may have members
/// with defaults of their own.
class Resolution {
  public:
    Resolution(std::string_view text, std::span<const std::string> overrides, const std::string& folder)
        : text_(text), overrides_(overrides.begin(), overrides.end()), folder_(folder) {}

    std::string run() {
        Reading reading = read();
        if (!reading.errors.empty()) throw SceneFailure({{}, std::move(reading.errors), {}, {}, {}, false});
        const std::vector<SceneError> known = reading.warnings;
        while (add(reading.missing)) {
            reading = read();
            // A default that its object or method does not want is better left out: a capsule has one radius or two.
            while (leave_out(reading, known)) reading = read();
        }
        return reading.json;
    }

  private:
    using Default = std::pair<std::string, std::string>;  ///< JSON pointer, JSON
    struct Reading {
        std::vector<SceneError> errors, warnings;
        std::vector<MissingKey> missing;
        std::string json;
    };

    Reading read() {
        SceneDocument document(text_, "scene");
        Reading reading;
        if (document.errors().empty()) {
            for (const std::string& each : overrides_) document.apply_override(each);
            for (const auto& [pointer, value] : defaults_)
                document.apply_override(fmt::format("{}={}", pointer, value));
        }
        if (!document.errors().empty()) {
            for (const PlacedError& error : document.errors()) reading.errors.push_back(error.error);
            return reading;
        }
        SceneReport report{document, {}, {}, &reading.missing, Up::y, folder_};
        SceneDescription scene;
        read_scene_object(SceneNode(report, document.root()), scene);
        reading.errors = report.errors.told();
        reading.warnings = report.warnings.told();
        Json::StreamWriterBuilder builder;
        builder["indentation"] = "";
        builder["commentStyle"] = "None";
        reading.json = Json::writeString(builder, document.root());
        last_ = std::move(scene);
        return reading;
    }

    bool add(const std::vector<MissingKey>& missing) {
        const std::size_t before = defaults_.size();
        for (const MissingKey& key : missing) {
            const std::string pointer = key.object + "/" + key.key;
            // The first default told counts: an object tells that of its own case before the published one.
            const bool known = std::ranges::find(defaults_, pointer, &Default::first) != defaults_.end();
            if (!known && !left_out_.contains(pointer)) defaults_.emplace_back(pointer, key.default_value);
        }
        return defaults_.size() > before;
    }

    bool leave_out(const Reading& reading, const std::vector<SceneError>& known) {
        const std::size_t before = defaults_.size();
        const auto drop = [&](const SceneError& told) {
            if (std::ranges::any_of(known, [&](const SceneError& each) { return each.message == told.message; }))
                return;
            std::erase_if(defaults_, [&](const auto& each) {
                const std::string& pointer = each.first;
                const bool blamed = pointer == told.pointer || pointer.substr(0, pointer.rfind('/')) == told.pointer;
                if (blamed) left_out_.insert(pointer);
                return blamed;
            });
        };
        std::ranges::for_each(reading.errors, drop);
        std::ranges::for_each(reading.warnings, drop);
        return defaults_.size() < before;
    }

    std::string_view text_;
    std::vector<std::string> overrides_;
    std::string folder_;
    std::vector<Default> defaults_;
    std::set<std::string> left_out_;
    SceneDescription last_{};  ///< keeps what its files hold, which the next reading then shares
};

}  // namespace

std::string resolved_scene(std::string_view text, std::span<const std::string> overrides, const std::string& folder) {
    return Resolution(text, overrides, folder).run();
}

}  // namespace drape
