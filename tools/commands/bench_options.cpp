#include "commands/bench_options.h"

#include <cstdlib>

namespace drape::cli {

namespace {

std::string set_minutes(const std::string& text, bench::SelectedCases& request) {
    char* end = nullptr;
    const double minutes = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != 0 || !(minutes > 0 && minutes < 1e6))
        return "expected minutes above 0, got '" + text + "'";
    request.budget_minutes = minutes;
    return {};
}

}  // namespace

void add_bench_options(CLI::App& command, bench::BenchRequest& request) {
    add_device_option(command, request.device);
    add_validate_option(command, request.validate);
    add_flag(command, "-q,--quiet", "No progress", request.quiet);
}

void add_case_options(CLI::App& command, const CaseWords& words, bench::SelectedCases& request) {
    add_option(command, "--filter", "REGEX",
               std::string("Only cases whose name contains this regular expression; names are ") + words.names,
               request.filter);
    add_flag(command, "--short", words.is_short, request.is_short);
    add_option(
        command, "--budget", "MINUTES",
        "Start no case that would end later than after so many minutes, the important cases first; default: no limit",
        [&request](const std::string& text) { return set_minutes(text, request); });
    add_option(command, "--json", "FILE", words.json, request.json);
    add_option(command, "--csv", "FILE", words.csv, request.csv);
    add_option(command, "--svg", "DIR", words.svg, request.svg);
    add_bench_options(command, request);
}

}  // namespace drape::cli
