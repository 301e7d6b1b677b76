// Reports the judgements to people, programs and test servers.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <json/json.h>

#include <algorithm>

#include "base/printable_text.h"
#include "output/json_text.h"
#include "output/xml_text.h"
#include "run/verify.h"

namespace drape::verify {

namespace {

std::size_t missed_count(const Report& report) {
    return static_cast<std::size_t>(std::ranges::count(report.findings, false, &Finding::met));
}

std::string error_text(const Report& report) {
    std::vector<std::string> lines;
    for (const SceneError& error : report.errors) lines.push_back(error.text());
    return fmt::format("{}", fmt::join(lines, "\n"));
}

std::string suite(const Report& report) {
    const std::size_t errors = report.errors.empty() ? 0 : 1, cases = report.findings.size() + errors;
    std::string text =
        fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n",
                    xml_text(report.file), cases, missed_count(report), errors, report.seconds);
    if (errors > 0)
        text += fmt::format("    <testcase classname=\"{}\" name=\"scene\"><error message=\"{}\"/></testcase>\n",
                            xml_text(report.file), xml_text(error_text(report)));
    for (const Finding& finding : report.findings)
        text += fmt::format("    <testcase classname=\"{}\" name=\"{}\">{}</testcase>\n", xml_text(report.file),
                            xml_text(finding.check),
                            finding.met ? fmt::format("<system-out>{}</system-out>", xml_text(finding.text))
                                        : fmt::format("<failure message=\"{}\"/>", xml_text(finding.text)));
    return text + "  </testsuite>\n";
}

}  // namespace

std::string report_text(const Report& report) {
    if (!report.errors.empty()) return fmt::format("{}: not run\n{}\n", printable(report.file), error_text(report));
    std::string text =
        fmt::format("{}: {} ({} frames, {:.1f} s)\n", printable(report.file),
                    report.met() ? "ok" : fmt::format("{} of {} missed", missed_count(report), report.findings.size()),
                    report.frame_count, report.seconds);
    for (const Finding& finding : report.findings)
        text += fmt::format("  {}  {}: {}\n", finding.met ? "met   " : "MISSED", finding.check, finding.text);
    return text;
}

std::string reports_json(const std::vector<Report>& reports) {
    Json::Value list(Json::arrayValue);
    for (const Report& report : reports) {
        Json::Value& row = list.append(Json::Value(Json::objectValue));
        row["file"] = report.file;
        row["ok"] = report.met();
        row["frames"] = report.frame_count;
        row["seconds"] = report.seconds;
        row["errors"] = row["checks"] = Json::Value(Json::arrayValue);
        for (const SceneError& error : report.errors) row["errors"].append(error.text());
        for (const Finding& finding : report.findings) {
            Json::Value& check = row["checks"].append(Json::Value(Json::objectValue));
            check["check"] = finding.check;
            check["met"] = finding.met;
            check["text"] = finding.text;
        }
    }
    return json_text(list);
}

std::string reports_junit(const std::vector<Report>& reports) {
    std::size_t cases = 0, failures = 0, errors = 0;
    double seconds = 0;
    std::string suites;
    for (const Report& report : reports) {
        const std::size_t error = report.errors.empty() ? 0 : 1;
        cases += report.findings.size() + error;
        failures += missed_count(report);
        errors += error;
        seconds += report.seconds;
        suites += suite(report);
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{}\" failures=\"{}\" errors=\"{}\" "
        "time=\"{:.3f}\">\n{}</testsuites>\n",
        cases, failures, errors, seconds, suites);
}

}  // namespace drape::verify
