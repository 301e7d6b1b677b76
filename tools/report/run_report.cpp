#include "report/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "output/json_text.h"
#include "output/xml_text.h"
#include "plot/plot.h"
#include "report/page.h"
#include "report/space.h"

namespace drape::report {

namespace {

constexpr const char* script = R"js(
const players = document.querySelectorAll('.player');
let timer = 0;
// Two players go together.
const showAll = at => players.forEach(one => one.show(Math.min(at, one.querySelector('input').max)));
const stop = () => {
  clearInterval(timer);
  timer = 0;
  players.forEach(one => one.querySelector('button').textContent = 'Play');
};
for (const player of players) {
  const frames = [...document.querySelectorAll('#' + player.dataset.frames + ' img')];
  const shown = player.querySelector('img'), slider = player.querySelector('input');
  const button = player.querySelector('button'), label = player.querySelector('output');
  player.show = at => { slider.value = at; shown.src = frames[at].src; label.textContent = frames[at].alt; };
  slider.oninput = () => { stop(); showAll(+slider.value); };
  button.onclick = () => {
    if (timer) return stop();
    players.forEach(one => one.querySelector('button').textContent = 'Stop');
    timer = setInterval(() => showAll((+slider.value + 1) % frames.length), 1000 * player.dataset.seconds);
  };
  player.show(0);
}
)js";

std::string value_text(const Json::Value& value) {
    if (value.isString()) return value.asString();
    if (value.isDouble()) return fmt::format("{:.6g}", value.asDouble());
    return json_line(value);
}

std::string row(const std::string& name, const std::string& value) {
    return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", xml_text(name), xml_text(value));
}

std::string title_of(const RunFolder& run) {
    const std::string name = run.manifest["scene"]["name"].asString();
    return name.empty() ? run.path.string() : name;
}

/// Returns what a run was asked for and chose, named by its place in the manifest.
std::map<std::string, std::string> settings_of(const RunFolder& run) {
    std::map<std::string, std::string> values{{"program_version", value_text(run.manifest["program_version"])}};
    for (const char* group : {"scene", "device", "frames", "picture", "solver", "validation"})
        for (const std::string& name :
             run.manifest.isMember(group) ? run.manifest[group].getMemberNames() : Json::Value::Members{})
            values[fmt::format("{}.{}", group, name)] = value_text(run.manifest[group][name]);
    return values;
}

std::string settings(const RunFolder& run) {
    const Json::Value& manifest = run.manifest;
    std::string html = "<table>\n" + row("folder", run.path.string()) + row("run_key", value_text(manifest["run_key"]));
    for (const auto& [name, value] : settings_of(run)) html += row(name, value);
    html += row("created", value_text(manifest["run"]["created"]));
    std::string command;
    for (const Json::Value& word : manifest["run"]["command_line"])
        command += (command.empty() ? "" : " ") + word.asString();
    return html + row("command line", command) + "</table>\n";
}

/// The settings of two runs that are not the same.
std::string differences(const RunFolder& a, const RunFolder& b) {
    const std::map<std::string, std::string> settings_a = settings_of(a), settings_b = settings_of(b);
    std::map<std::string, std::array<std::string, 2>> both;
    for (const auto& [name, value] : settings_a) both[name][0] = value;
    for (const auto& [name, value] : settings_b) both[name][1] = value;
    std::string rows;
    for (const auto& [name, values] : both)
        if (values[0] != values[1])
            rows += fmt::format("<tr><th>{}</th><td>{}</td><td>{}</td></tr>\n", xml_text(name), xml_text(values[0]),
                                xml_text(values[1]));
    return "<section>\n<h2>Settings that differ</h2>\n" +
           (rows.empty() ? "<p>None.</p>\n"
                         : "<table>\n<tr><th></th><th>A</th><th>B</th></tr>\n" + rows + "</table>\n") +
           "</section>\n";
}

/// A line on all cuts of a cloth.
std::string cuts(const Json::Value& list) {
    struct Sum {
        Json::Int64 first, last;
        Json::UInt64 springs, torn, triangles, crumbs;
    };
    std::map<std::string, Sum> sums;
    for (const Json::Value& cut : list) {
        const Json::Int64 frame = cut["frame"].asInt64();
        Sum& sum = sums.try_emplace(cut["cloth"].asString(), Sum{frame, frame, 0, 0, 0, 0}).first->second;
        sum.first = std::min(sum.first, frame);
        sum.last = std::max(sum.last, frame);
        sum.springs += cut["springs"].asUInt64();
        sum.torn += cut["torn"].asUInt64();
        sum.triangles += cut["triangles"].asUInt64();
        sum.crumbs = cut["crumbs"].asUInt64();  // those there are
    }
    std::string html;
    for (const auto& [cloth, sum] : sums)
        html += fmt::format(
            "<p>Cloth '{}' was {} in frames {} to {}: {} springs and {} triangles; "
            "{} of its pieces are crumbs of less than four triangles.</p>\n",
            xml_text(cloth),
            sum.torn == 0             ? "cut"
            : sum.torn == sum.springs ? "torn"
                                      : "cut and torn",
            sum.first, sum.last, sum.springs, sum.triangles, sum.crumbs);
    return html;
}

std::string status(const RunFolder& run) {
    const Json::Value& manifest = run.manifest;
    const std::string state = manifest["status"].asString();
    std::string html =
        fmt::format("<p>Status: <span class=\"{}\">{}</span></p>\n", state == "done" ? "good" : "bad", xml_text(state));
    if (manifest.isMember("failure"))
        html += fmt::format("<p class=\"bad\">{}</p>\n", xml_text(manifest["failure"].asString()));
    std::string items;
    for (const Json::Value& warning : manifest["warnings"]) items += "<li>" + xml_text(value_text(warning)) + "</li>\n";
    const auto messages = manifest["validation"]["messages"].asUInt64();
    if (messages > 0) items += fmt::format("<li class=\"bad\">{} validation messages</li>\n", messages);
    html += items.empty() ? "<p>No warnings.</p>\n" : "<ul>\n" + items + "</ul>\n";
    html += cuts(manifest["cuts"]);
    if (const Json::Value& contact = manifest["self_collision"]; !contact.isNull())
        html += fmt::format("<h2>Certificate</h2>\n<p class=\"{}\">{}</p>\n",
                            contact["proved"].asBool() ? "good" : "bad", xml_text(contact["certificate"].asString()));
    for (const Json::Value& split : manifest["self_collision"]["not_covered"])
        html += fmt::format("<p>Not covered: {} triangles of cloth '{}', from frame {} on.</p>\n",
                            split["triangles"].asUInt64(), xml_text(split["cloth"].asString()),
                            split["first_frame"].asInt64());
    return html;
}

/// Milliseconds per frame by stage, of the device.
std::string times(const RunFolder& run) {
    const Json::Value& timing = run.manifest["run"];
    std::string html = "<table>\n<tr><th>stage</th><th>ms per frame, median</th></tr>\n";
    const Json::Value& stages = timing["stage_median_ms"];
    for (const std::string& stage : stages.isObject() ? stages.getMemberNames() : Json::Value::Members{})
        html += fmt::format("<tr><td>{}</td><td class=\"number\">{:.3f}</td></tr>\n", xml_text(stage),
                            stages[stage].asDouble());
    if (timing.isMember("frame_ms"))
        html += fmt::format("<tr><td>frame, wall clock</td><td class=\"number\">{:.3f}</td></tr>\n",
                            timing["frame_ms"]["median"].asDouble());
    return html + "</table>\n";
}

constexpr std::size_t sheet_pictures = 12;

std::string pictures(const RunFolder& run, std::size_t id, const ReportOptions& options) {
    if (run.pictures.empty()) return "<p>This run drew no pictures.</p>\n";
    const std::vector<std::size_t> numbers = evenly_chosen(run.pictures.size(), options.frames);
    const Json::Value& frames = run.manifest["frames"];
    const double spacing = static_cast<double>(run.pictures.size()) / static_cast<double>(numbers.size()) *
                           frames["step"].asDouble() /
                           (run.is_finished ? std::max(frames["fps"].asDouble(), 1e-3) : 25.0);
    std::string html = fmt::format(
        "<div class=\"player\" data-frames=\"frames{}\" data-seconds=\"{:.4f}\">\n<img alt=\"\"/>\n"
        "<button type=\"button\">Play</button> <input type=\"range\" min=\"0\" max=\"{}\" value=\"0\"/> "
        "<output></output>\n</div>\n<h2>Contact sheet</h2>\n<div class=\"sheet\" id=\"frames{}\">\n",
        id, spacing, numbers.size() - 1, id);
    // All are in the player; the sheet shows some.
    const std::vector<std::size_t> shown = evenly_chosen(numbers.size(), sheet_pictures);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::string name = xml_text(run.pictures[numbers[i]]);
        const bool between = std::ranges::find(shown, i) == shown.end();
        html += fmt::format(
            "<figure{2}><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"/><figcaption>{0}</figcaption></figure>\n",
            name, small_picture(run.path / run.pictures[numbers[i]], options.width),
            between ? " class=\"between\"" : "");
    }
    return html + "</div>\n";
}

/// The frame's time, s; of a run that is not finished, whose frame rate is not known, its number.
double time_of(const RunFolder& run, const Json::Value& frame) {
    if (!run.is_finished) return frame.asDouble();
    return frame.asDouble() / std::max(run.manifest["frames"]["fps"].asDouble(), 1e-3);
}

/// What a line has of a frame's numbers that are named so: the largest of any cloth and of all together, that of all
/// together, or the sum over bodies that cloth moves.
enum class Of { worst, whole, bodies };

struct Line {
    const char *plot, *unit;
    double factor;
    const char *name, *key;
    Of of = Of::worst;
};
constexpr Line lines[] = {{"Stretch", "%", 100, "largest", "stretch_max"},
                          {"Stretch", "%", 100, "RMS", "stretch_rms"},
                          {"Stretch", "%", 100, "error, RMS", "stretch_error_rms"},
                          {"Energy", "J", 1, "kinetic", "kinetic_energy_j"},
                          {"Energy", "J", 1, "potential", "potential_energy_j"},
                          {"Energy", "J", 1, "elastic", "elastic_energy_j"},
                          {"Energy", "J", 1, "total", "energy_j"},
                          {"Momentum", "kg m/s", 1, "x, all", "momentum_x_kg_m_s", Of::whole},
                          {"Momentum", "kg m/s", 1, "y, all", "momentum_y_kg_m_s", Of::whole},
                          {"Momentum", "kg m/s", 1, "z, all", "momentum_z_kg_m_s", Of::whole},
                          {"Momentum", "kg m/s", 1, "x, bodies", "momentum_x_kg_m_s", Of::bodies},
                          {"Momentum", "kg m/s", 1, "y, bodies", "momentum_y_kg_m_s", Of::bodies},
                          {"Momentum", "kg m/s", 1, "z, bodies", "momentum_z_kg_m_s", Of::bodies},
                          {"Penetration", "mm", 1000, "deepest", "penetration_m"},
                          {"Substeps and iterations", "per frame", 1, "substeps", "substeps"},
                          {"Substeps and iterations", "per frame", 1, "iterations", "iterations"},
                          {"Largest speed", "m/s", 1, "speed", "speed_max_m_s"},
                          {"Motion error, estimated", "mm/s", 1000, "error", "motion_error_m_s"},
                          {"Position error, estimated", "mm", 1000, "error", "position_error_m"}};

/// Returns what a line has of a frame; nothing: the frame has none of it.
std::optional<double> value_of(const Json::Value& frame, const Line& line) {
    const std::string key = line.key, of_a_cloth = "/" + key, of_a_body = "_" + key;
    std::optional<double> found;
    for (const std::string& member : frame.getMemberNames()) {
        const double value = frame[member].asDouble();
        switch (line.of) {
            case Of::worst:
                if (member == key || member.ends_with(of_a_cloth)) found = std::max(found.value_or(-INFINITY), value);
                break;
            case Of::whole:
                if (member == key) found = value;
                break;
            case Of::bodies:
                if (member.starts_with("body_") && member.ends_with(of_a_body)) found = found.value_or(0) + value;
                break;
        }
    }
    return found;
}

plot::Curve curve(const RunFolder& run, const std::string& name, const Line& line, std::size_t look, bool dashed) {
    plot::Curve result{.name = name, .look = look, .dashed = dashed};
    for (const Json::Value& frame : run.manifest["statistics"])
        if (const auto value = value_of(frame, line))
            result.points.push_back({time_of(run, frame["frame"]), *value * line.factor});
    return result;
}

/// Returns a curve for each force on a cloth that a run tells, of its magnitude: the mean of each frame, and the worst
/// of its substeps.
std::vector<plot::Curve> forces(const RunFolder& run, const std::string& before, bool dashed) {
    constexpr std::pair<const char*, const char*> kinds[] = {{"/force_", ""}, {"/worst_force_", ", worst"}};
    constexpr std::string_view x = "_x_n";
    std::map<std::string, plot::Curve> curves;
    for (const Json::Value& frame : run.manifest["statistics"])
        for (const std::string& name : frame.getMemberNames())
            for (const auto& [kind, addition] : kinds) {
                const std::size_t at = name.find(kind);
                if (at == std::string::npos || !name.ends_with(x)) continue;
                const std::string stem = name.substr(0, name.size() - x.size());
                const auto along = [&](const char* end) { return frame[stem + end].asDouble(); };
                const std::string by = stem.substr(at + std::string_view(kind).size());
                curves[name.substr(0, at) + ", " + by + addition].points.push_back(
                    {time_of(run, frame["frame"]), std::hypot(along("_x_n"), along("_y_n"), along("_z_n"))});
            }
    std::vector<plot::Curve> all;
    for (auto& [name, curve] : curves) {
        curve.name = before + name;
        curve.look = all.size();
        curve.dashed = dashed;
        all.push_back(std::move(curve));
    }
    return all;
}

/// Returns the plots over time, by their titles, in the order of `lines`; runs share them.
std::vector<std::pair<std::string, std::string>> plots_of(const std::vector<RunFolder>& runs) {
    double last = 0;
    for (const RunFolder& run : runs) last = std::max(last, time_of(run, run.manifest["frames"]["end"]));
    std::vector<std::pair<std::string, std::string>> plots;
    for (const Line *first = lines, *end = first; first != std::end(lines); first = end) {
        end = std::find_if(first, std::end(lines),
                           [&](const Line& line) { return line.plot != std::string(first->plot); });
        const bool in_frames = std::ranges::any_of(runs, [](const RunFolder& run) { return !run.is_finished; });
        plot::Plot drawing{.title = first->plot,
                           .x_label = in_frames ? "frame" : "s",
                           .y_label = first->unit,
                           .logarithmic = false,
                           .x_last = last};
        for (std::size_t i = 0; i < runs.size(); ++i)
            for (const Line* line = first; line != end; ++line) {
                const std::string run = runs.size() == 1 ? "" : i == 0 ? "A " : "B ";
                plot::Curve one =
                    curve(runs[i], run + line->name, *line, static_cast<std::size_t>(line - first), i > 0);
                if (!one.points.empty()) drawing.curves.push_back(std::move(one));
            }
        if (!drawing.curves.empty()) plots.emplace_back(first->plot, plot::svg_of(drawing));
    }
    plot::Plot drawing{
        .title = "Forces on cloths", .x_label = "s", .y_label = "N", .logarithmic = false, .x_last = last};
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (plot::Curve& each : forces(runs[i], runs.size() == 1 ? "" : i == 0 ? "A " : "B ", i > 0))
            drawing.curves.push_back(std::move(each));
    if (!drawing.curves.empty()) plots.emplace_back(drawing.title, plot::svg_of(drawing));
    return plots;
}

std::string plot_section(const std::vector<RunFolder>& runs) {
    std::string html = "<section>\n<h2>Over time</h2>\n<div class=\"plots\">\n";
    for (const auto& [title, svg] : plots_of(runs)) html += "<div>" + svg + "</div>\n";
    return html + "</div>\n</section>\n";
}

/// The view, beside strain and errors over time where there is room, which is with one run.
std::string space_beside_plots(const std::vector<RunFolder>& runs, std::size_t id, double megabytes) {
    std::string view = space_view(runs[id], id, megabytes);
    if (runs.size() > 1 || !view.starts_with("<div")) return view;
    std::string html = "<div class=\"beside\">\n<div>\n" + view + "</div>\n<div>\n";
    for (const auto& [title, svg] : plots_of(runs))
        if (title == "Stretch" || title.starts_with("Position error")) html += svg;
    return html + "</div>\n</div>\n";
}

/// A section with a column per run.
std::string section(const std::string& title, const std::vector<RunFolder>& runs,
                    const std::function<std::string(const RunFolder&, std::size_t)>& content) {
    std::string html = fmt::format("<section>\n<h2>{}</h2>\n<div class=\"runs\">\n", title);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::string head =
            runs.size() == 1 ? ""
                             : fmt::format("<h2>{}: {}</h2>\n", i == 0 ? "A" : "B", xml_text(runs[i].path.string()));
        html += "<div>\n" + head + content(runs[i], i) + "</div>\n";
    }
    return html + "</div>\n</section>\n";
}

}  // namespace

std::string report_html(const std::vector<RunFolder>& runs, const ReportOptions& options) {
    std::string title = title_of(runs.front());
    if (runs.size() > 1 && title_of(runs[1]) != title) title += " and " + title_of(runs[1]);
    std::string html;
    html += section("Result", runs, [](const RunFolder& run, std::size_t) { return status(run); });
    if (runs.size() > 1 && runs[0].is_finished && runs[1].is_finished) html += differences(runs[0], runs[1]);
    html += section("In 3-D", runs,
                    [&](const RunFolder&, std::size_t id) { return space_beside_plots(runs, id, options.megabytes); });
    html += section("Pictures", runs, [&](const RunFolder& run, std::size_t id) { return pictures(run, id, options); });
    html += plot_section(runs);
    const auto once_finished = [](auto content) {
        return [content](const RunFolder& run, std::size_t) {
            return run.is_finished ? content(run) : "<p>Known when the run has ended.</p>\n";
        };
    };
    html += section("Times", runs, once_finished(times));
    html += section("Settings", runs, once_finished(settings));
    std::string scripts = std::string("<script>//<![CDATA[") + script + "//]]></script>\n";
    // Libraries that draw in 3-D are most of a small page, so that they come with a view alone.
    if (html.find("<div class=\"space\"") != std::string::npos)
        scripts += "<script>//<![CDATA[\n" + space_script() + "//]]></script>\n";
    return page_of(title, html, scripts);
}

}  // namespace drape::report
