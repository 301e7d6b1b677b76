#include "scene/sewing_panels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "scene/scene_value.h"

namespace drape {
namespace {

std::string array_text(std::span<const double> numbers) {
    std::string text;
    for (const double x : numbers)
        text += fmt::format("{}{:.9g}", text.empty() ? "" : ", ", std::abs(x) < 1e-12 ? 0 : x);
    return "[" + text + "]";
}

std::string cloth_text(const PatternPanel& panel, const PatternOptions& options) {
    std::string path;
    for (const std::vector<PatternEdge>& loop : panel.loops) {
        path += "M" + path_point(loop[0].from);
        for (const PatternEdge& edge : loop) path += " " + edge.segment;
        path += " Z";
    }
    const Placement& placement = panel.placement;
    return fmt::format(R"(    {{
      "name": "{}", "fabric": "{}",
      "outline": {{"spacing": {}, "path": "{}"}},
      "placement": {{"origin": {}, "u": {}, "v": {}}}
    }})",
                       panel.name, options.fabric, options.spacing, path, array_text(placement.origin),
                       array_text(placement.u), array_text(placement.v));
}

std::string side_text(const std::vector<PatternPanel>& panels, const PatternSide& side) {
    const PatternPanel& panel = panels[side.panel];
    const std::vector<PatternEdge>& loop = panel.loops[side.loop];
    const auto edge = [&](std::size_t number) -> const PatternEdge& {
        return loop[(side.first + (side.step > 0 ? number : loop.size() - number)) % loop.size()];
    };
    double length = 0, around = 0;
    for (const PatternEdge& each : loop) around += each.length;
    for (std::size_t i = 0; i < side.count; ++i) length += edge(i).length;
    const PatternEdge &first = edge(0), &last = edge(side.count - 1);
    return fmt::format(
        R"({{"cloth": "{}", "from": {}, "to": {}{}}})", panel.name, array_text(side.step > 0 ? first.from : first.to),
        array_text(side.step > 0 ? last.to : last.from), length > around / 2 ? R"(, "way": "longer")" : "");
}

}  // namespace

std::string path_point(const PatternPoint& p) { return fmt::format("{:.9g} {:.9g}", p[0], p[1]); }

void write_pattern_scene(const std::vector<PatternPanel>& panels, const std::vector<PatternSeam>& seams,
                         const PatternOptions& options, PatternResult& result) {
    std::vector<std::string> cloths, sewn, meshes;
    for (const PatternPanel& panel : panels) cloths.push_back(cloth_text(panel, options));
    for (const PatternSeam& seam : seams)
        sewn.push_back(fmt::format("    {{\"a\": {},\n     \"b\": {}, \"close\": {}}}", side_text(panels, seam.a),
                                   side_text(panels, seam.b), options.close));
    for (const std::string& body : options.bodies) meshes.push_back("{\"file\": " + drape::quoted(body) + "}");
    result.panels = cloths.size();
    result.seams = sewn.size();
    // Clothes would fall off while they are sewn, so gravity comes afterwards; then they have two seconds to settle.
    const double weighed = options.close + 0.3;
    result.scene = fmt::format("{{\n  \"time\": {{\"frames\": {}}},\n", std::ceil(60 * (weighed + 2)));
    result.scene +=
        fmt::format(R"(  "gravity_keys": [{{"t": 0, "gravity": [0, 0, 0]}}, {{"t": {}, "gravity": [0, 0, 0]}},
                   {{"t": {}, "gravity": [0, -9.81, 0]}}],
)",
                    std::max(options.close, 1e-3), weighed);
    result.scene += fmt::format("  \"cloths\": [\n{}\n  ]", fmt::join(cloths, ",\n"));
    if (!sewn.empty()) result.scene += fmt::format(",\n  \"seams\": [\n{}\n  ]", fmt::join(sewn, ",\n"));
    if (!meshes.empty())
        result.scene += fmt::format(",\n  \"colliders\": {{\"meshes\": [{}]}}", fmt::join(meshes, ", "));
    result.scene += "\n}\n";
}

}  // namespace drape
