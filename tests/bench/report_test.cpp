// JSON, CSV and plots hold every case; plots are well-formed and told apart by more than colour.
#include "bench/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <memory>
#include <regex>
#include <set>

#include "results.h"

namespace drape::bench {
namespace {

using testing::HasSubstr;

/// Returns the number of elements; throws unless tags nest, attributes are quoted and text is escaped.
std::size_t element_count(const std::string& xml) {
    static const std::regex token("<(/?)([A-Za-z]+)((?: [A-Za-z0-9-]+=\"[^\"<&]*\")*)(/?)>|([^<]+)");
    static const std::regex text("([^<>&]|&(amp|lt|gt|quot);)*");
    std::vector<std::string> open;
    std::size_t count = 0, at = 0;
    for (std::sregex_iterator it(xml.begin(), xml.end(), token), end; it != end; ++it) {
        if (static_cast<std::size_t>(it->position()) != at)
            throw std::runtime_error("not a token at " + xml.substr(at, 60));
        at += static_cast<std::size_t>(it->length());
        if ((*it)[5].matched) {
            if (!std::regex_match((*it)[5].str(), text)) throw std::runtime_error("unescaped: " + (*it)[5].str());
        } else if ((*it)[1].length() > 0) {
            if (open.empty() || open.back() != (*it)[2]) throw std::runtime_error("wrong end: " + it->str());
            open.pop_back();
        } else {
            ++count;
            if ((*it)[4].length() == 0) open.push_back((*it)[2]);
        }
    }
    if (at != xml.size() || !open.empty()) throw std::runtime_error("not whole");
    return count;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

Report report() {
    Report report{{"1.2.3", "2026-01-01T00:00:00Z", "a device", "a driver 5"}};
    for (const std::uint32_t n : {10u, 20u, 40u})
        report.results.push_back(test::swing_result(SolverMethod::relax, n, n, 1.0 / n, 1.0 / n));
    for (const std::uint32_t n : {32u, 64u})
        report.results.push_back(test::swing_result(SolverMethod::explicit_steps, n, n, 1e-3 / n, 1e-3 / n));
    report.results.push_back(test::swing_result(SolverMethod::explicit_steps, 640, 5, 0, 0));
    report.results.back().diverged = true;
    report.results.back().metrics.clear();
    report.targets = {{"swing", {{"stretch_error", 0.01}, {"position_rms", 1e-3}}}};
    evaluate(report);
    return report;
}

TEST(PlotTest, IsWellFormedAndHoldsEverySeries) {
    plot::Plot plot{"a < b & \"c\"", "time, ms", "error, m", {}, {-1, -2}, {{"1 %", 0.01}}};
    std::set<std::string> colours;
    for (int k = 0; k < 8; ++k)
        plot.curves.push_back(
            {"series <" + std::to_string(k) + ">", {{1, 0.1}, {10, 1e-3 * (k + 1)}, {0, 1}, {5, -1}}});
    plot.curves.push_back({"empty", {}});
    const std::string svg = plot::svg_of(plot);
    EXPECT_GT(element_count(svg), 60u);
    for (int k = 0; k < 8; ++k) EXPECT_THAT(svg, HasSubstr("<title>series &lt;" + std::to_string(k) + "&gt;</title>"));
    EXPECT_THAT(svg, HasSubstr("<title>empty</title>"));
    EXPECT_EQ(occurrences(svg, "class=\"series\""), 9u);
    EXPECT_EQ(occurrences(svg, "slope -"), 2u);
    EXPECT_THAT(svg, testing::AllOf(HasSubstr(">time, ms<"), HasSubstr(">error, m<"), HasSubstr(">1 %<")));
    EXPECT_THAT(svg, testing::Not(HasSubstr("nan")));
    EXPECT_THAT(svg, testing::Not(HasSubstr("doubtful")));
    plot.curves[2].doubtful = {false, true, false, false};
    const std::string marked = plot::svg_of(plot);
    EXPECT_EQ(occurrences(marked, "class=\"doubtful\""), 1u);
    EXPECT_THAT(marked, HasSubstr(">hollow: time doubtful<"));
    EXPECT_GT(element_count(marked), element_count(svg));
}

TEST(PlotTest, PutsPointsWhereTheLogarithmsAre) {
    // From 1 to 100 and 1e-4 to 1 the middle decade's point stands in the middle of the frame.
    const std::string svg = plot::svg_of({"t", "x", "y", {{"s", {{1, 1}, {10, 1e-2}, {100, 1e-4}}}}, {}, {}});
    std::smatch match;
    const std::regex line("<polyline points=\"([0-9.]+),([0-9.]+) ([0-9.]+),([0-9.]+) ([0-9.]+),([0-9.]+) \"");
    ASSERT_TRUE(std::regex_search(svg, match, line));
    const auto value = [&](std::size_t k) { return std::stod(match[k]); };
    EXPECT_NEAR(value(3), 0.5 * (value(1) + value(5)), 0.11);
    EXPECT_NEAR(value(4), 0.5 * (value(2) + value(6)), 0.11);
    EXPECT_LT(value(1), value(5));
    EXPECT_LT(value(2), value(6)) << "y grows downwards on paper";
}

TEST(ReportTest, PlotsHoldEveryFamily) {
    const auto plots = report_plots(report(), all_problems(false));
    std::set<std::string> names;
    for (const auto& [name, plot] : plots) {
        names.insert(name);
        EXPECT_GT(element_count(plot::svg_of(plot)), 20u) << name;
        ASSERT_EQ(plot.curves.size(), 2u) << name;
        EXPECT_EQ(plot.curves[0].name, "explicit");
        EXPECT_EQ(plot.curves[0].points.size(), 2u);
        EXPECT_EQ(plot.curves[1].name, "relax");
        EXPECT_EQ(plot.curves[1].points.size(), 3u);
    }
    EXPECT_EQ(names, (std::set<std::string>{"swing_64_position_time.svg", "swing_64_position_passes.svg",
                                            "swing_64_stretch_time.svg", "swing_64_stretch_passes.svg"}));
}

TEST(ReportTest, JsonHoldsCasesAndConclusions) {
    const std::string text = report_json(report());
    Json::Value value;
    std::string errors;
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    ASSERT_TRUE(reader->parse(text.data(), text.data() + text.size(), &value, &errors)) << errors;
    EXPECT_EQ(value["format"].asString(), "drape bench accuracy 1");
    EXPECT_EQ(value["results"].size(), 6u);
    EXPECT_EQ(value["results"][1]["metrics"]["position_rms"].asDouble(), 1.0 / 20);
    EXPECT_TRUE(value["results"][5]["diverged"].asBool());
    EXPECT_EQ(value["soonest"].size(), 4u);
    EXPECT_FALSE(value["soonest"][1]["meets"].asBool()) << "relax has 2.5 % at best";
    EXPECT_EQ(value["limits"].size(), 1u) << "swing/64/relax/20 is in the table, with one of its metrics";
}

TEST(ReportTest, CsvHasTheSameColumnsInEveryRow) {
    const std::string text = report_csv(report());
    std::vector<std::string> rows;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        rows.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    ASSERT_EQ(rows.size(), 7u);
    for (const std::string& row : rows) EXPECT_EQ(occurrences(row, ","), 18u) << row;
    EXPECT_THAT(rows[0], testing::EndsWith(",diverged,position_rms,stretch_error,stretch_rms"));
    EXPECT_THAT(rows[2], testing::AllOf(testing::StartsWith("swing/64/relax/20,swing,64,relax,20,1,20,"),
                                        testing::EndsWith(",0,0.05,0.05,0.05")));
    EXPECT_THAT(rows[6], testing::EndsWith(",1,,,"));
}

TEST(ReportTest, TextSaysWhatIsMetAndWhatIsNot) {
    const std::string text = report_text(report(), all_problems(false));
    EXPECT_THAT(text, testing::AllOf(HasSubstr("a device (a driver 5)"), HasSubstr("swing/64/explicit/640"),
                                     HasSubstr("diverged"), HasSubstr("NOT MET"), HasSubstr("no measured setting")));
}

}  // namespace
}  // namespace drape::bench
