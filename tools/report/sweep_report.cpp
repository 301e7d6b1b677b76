#include "report/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "output/json_file.h"
#include "output/json_text.h"
#include "output/xml_text.h"
#include "plot/plot.h"
#include "report/page.h"
#include "report/run_folder.h"

namespace drape::report {

namespace fs = std::filesystem;

namespace {

/// A run's record, jobs/NUMBER.json; sweep_folder.h writes it.
struct SweepRun {
    std::string number;
    Json::Value record;
};

constexpr JsonRule job_rules[] = {{"/status", JsonRule::Kind::text},       {"/exit_code", JsonRule::Kind::whole_number},
                                  {"/message", JsonRule::Kind::text},      {"/seconds", JsonRule::Kind::number},
                                  {"/parameters", JsonRule::Kind::object}, {"/values", JsonRule::Kind::object},
                                  {"/values/*", JsonRule::Kind::number}};
constexpr JsonRule sweep_rules[] = {{"/scene", JsonRule::Kind::text}, {"/count", JsonRule::Kind::whole_number}};

/// Returns the runs that have a record, by number.
std::vector<SweepRun> read_runs(const fs::path& jobs) {
    std::set<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(jobs, error), end; !error && entry != end; entry.increment(error))
        if (entry->path().extension() == ".json") files.insert(entry->path());
    std::vector<SweepRun> runs;
    for (const fs::path& file : files) runs.push_back({file.stem().string(), read_json(file, job_rules)});
    return runs;
}

/// Names of all members that the records have below a key, each once.
std::set<std::string> columns_of(const std::vector<SweepRun>& runs, const char* key) {
    std::set<std::string> names;
    for (const SweepRun& run : runs)
        if (run.record[key].isObject())
            for (const std::string& name : run.record[key].getMemberNames()) names.insert(name);
    return names;
}

/// Names of the numbers below a key of which at least two runs have different ones.
std::vector<std::string> varied(const std::vector<SweepRun>& runs, const char* key) {
    std::vector<std::string> names;
    for (const std::string& name : columns_of(runs, key)) {
        std::set<double> found;
        for (const SweepRun& run : runs)
            if (const Json::Value& value = run.record[key][name]; value.isNumeric()) found.insert(value.asDouble());
        if (found.size() > 1) names.push_back(name);
    }
    return names;
}

plot::Plot scatter(const std::vector<SweepRun>& runs, const std::string& drawn, const std::string& result) {
    plot::Plot plot{.title = fmt::format("{} by {}", result, drawn),
                    .x_label = drawn,
                    .y_label = result,
                    .logarithmic = false,
                    .from_zero = false};
    plot::Curve& curve = plot.curves.emplace_back(plot::Curve{.name = "runs", .joined = false});
    for (const SweepRun& run : runs) {
        const Json::Value &x = run.record["parameters"][drawn], &y = run.record["values"][result];
        if (x.isNumeric() && y.isNumeric()) curve.points.push_back({x.asDouble(), y.asDouble()});
    }
    return plot;
}

constexpr std::size_t most_plots = 12;

/// Returns a plot for each number that was drawn and each result that differs, as many as a page bears.
std::string scatters(const std::vector<SweepRun>& runs) {
    std::string html;
    std::size_t count = 0;
    for (const std::string& drawn : varied(runs, "parameters"))
        for (const std::string& result : varied(runs, "values"))
            if (result != "bytes" && result != "frames" && count++ < most_plots)
                html += plot::svg_of(scatter(runs, drawn, result));
    if (html.empty()) return {};
    const std::string left_out =
        count > most_plots ? fmt::format("<p>{} more are not shown.</p>\n", count - most_plots) : std::string();
    return fmt::format("<section>\n<h2>Results by what was drawn</h2>\n<div class=\"plots\">\n{}</div>\n{}</section>\n",
                       html, left_out);
}

constexpr std::size_t most_thumbnails = 48;
constexpr std::uint32_t thumbnail_width = 240;

/// Returns the last pictures of runs that are done, of more than a page bears of evenly chosen ones.
std::string thumbnails(const fs::path& sweep, const std::vector<SweepRun>& runs) {
    std::vector<std::string> done;
    for (const SweepRun& run : runs) {
        std::error_code ignored;
        if (run.record["exit_code"].asInt() == 0 && fs::exists(sweep / "runs" / run.number / "manifest.json", ignored))
            done.push_back(run.number);
    }
    std::string html;
    for (const std::size_t k : evenly_chosen(done.size(), most_thumbnails)) {
        const fs::path folder = sweep / "runs" / done[k];
        const RunFolder run = read_run_folder(folder);
        if (run.pictures.empty()) continue;
        html += fmt::format(
            "<figure><img alt=\"{0}: {1}\" src=\"data:image/png;base64,{2}\"/><figcaption>{0}</figcaption></figure>\n",
            done[k], xml_text(run.pictures.back()), small_picture(folder / run.pictures.back(), thumbnail_width));
    }
    if (html.empty()) return {};
    return fmt::format("<section>\n<h2>Last pictures</h2>\n<div class=\"sheet\">\n{}</div>\n</section>\n", html);
}

std::string cell(const Json::Value& value) {
    if (value.isNumeric()) return fmt::format("<td class=\"number\">{:.5g}</td>", value.asDouble());
    const std::string text = value.isNull() ? "" : value.isString() ? value.asString() : json_line(value);
    return fmt::format("<td>{}</td>", xml_text(text));
}

/// The run's own page where it has one, else its folder.
std::string link(const fs::path& sweep, const std::string& number) {
    const std::string folder = fmt::format("runs/{}/", number);
    std::error_code ignored;
    const bool has_page = fs::exists(sweep / folder / "report.html", ignored);
    return fmt::format("<td><a href=\"{}{}\">{}</a></td>", folder, has_page ? "report.html" : "", number);
}

std::string table_of(const fs::path& path, const std::vector<SweepRun>& runs) {
    const std::set<std::string> parameters = columns_of(runs, "parameters"), values = columns_of(runs, "values");
    std::string html = "<div class=\"wide\"><table>\n<tr><th>run</th><th>status</th>";
    for (const std::set<std::string>* names : {&parameters, &values})
        for (const std::string& name : *names) html += fmt::format("<th>{}</th>", xml_text(name));
    html += "<th>seconds</th><th>message</th></tr>\n";
    for (const SweepRun& run : runs) {
        const Json::Value& record = run.record;
        html += fmt::format("<tr>{}<td class=\"{}\">{}</td>", link(path, run.number),
                            record["exit_code"].asInt() == 0 ? "good" : "bad", xml_text(record["status"].asString()));
        for (const std::string& name : parameters) html += cell(record["parameters"][name]);
        for (const std::string& name : values) html += cell(record["values"][name]);
        html += cell(record["seconds"]) + cell(record["message"]) + "</tr>\n";
    }
    return html + "</table></div>\n";
}

}  // namespace

bool is_sweep_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path / "sweep.json", ignored);
}

std::string sweep_html(const fs::path& path) {
    const Json::Value sweep = read_json(path / "sweep.json", sweep_rules);
    const std::vector<SweepRun> runs = read_runs(path / "jobs");
    const auto failed =
        std::ranges::count_if(runs, [](const SweepRun& run) { return run.record["exit_code"].asInt() != 0; });
    const auto done = static_cast<std::ptrdiff_t>(runs.size()) - failed;
    const std::string state = fmt::format("{} done, {} failed, {} missing, of {} runs of {}", done, failed,
                                          sweep["count"].asInt64() - static_cast<std::int64_t>(runs.size()),
                                          sweep["count"].asInt64(), xml_text(sweep["scene"].asString()));
    return page_of("Sweep " + path.string(),
                   fmt::format("<section>\n<h2>Result</h2>\n<p class=\"{}\">{}</p>\n</section>\n"
                               "{}{}<section>\n<h2>Runs</h2>\n{}</section>\n<section>\n<h2>Specification</h2>\n"
                               "<pre>{}</pre>\n</section>\n",
                               failed == 0 ? "good" : "bad", state, thumbnails(path, runs), scatters(runs),
                               table_of(path, runs), xml_text(json_text(sweep["specification"]))));
}

}  // namespace drape::report
