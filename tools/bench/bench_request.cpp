#include "bench/bench_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "output/output_error.h"
#include "run/run.h"

namespace drape::bench {

CaseFilter::CaseFilter(const std::string& text) try : text_(text), expression_(text) {
} catch (const std::regex_error& error) {
    throw UsageError(fmt::format("--filter '{}': {}", text, error.what()));
}

void CaseFilter::refuse(const std::string& example) const {
    throw UsageError(fmt::format("--filter '{}' matches no case; their names are like {}", text_, example));
}

void Budget::done(double work, double seconds) {
    work_ += work;
    seconds_ += seconds;
}

double Budget::spent() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

std::string duration_text(double seconds) {
    const auto total = static_cast<std::uint64_t>(std::max(0.0, std::ceil(seconds)));
    return total >= 3600 ? fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60)
                         : fmt::format("{}:{:02}", total / 60, total % 60);
}

void make_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw OutputError(fmt::format("cannot make folder '{}': {}", folder, error.message()));
}

}  // namespace drape::bench
