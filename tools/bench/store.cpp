#include "bench/store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <json/json.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <memory>

#include "bench/result_json.h"
#include "output/file_descriptor.h"
#include "output/json_text.h"
#include "output/output_error.h"

namespace drape::bench {

std::string result_line(const CaseResult& result) { return json_line(json_of(result)); }

std::optional<CaseResult> parsed_result(const std::string& line) {
    Json::CharReaderBuilder builder;
    builder["failIfExtra"] = true;
    const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
    Json::Value value;
    std::string errors;
    try {
        if (!reader->parse(line.data(), line.data() + line.size(), &value, &errors)) return std::nullopt;
        return result_of(value);
    } catch (const Json::Exception&) {  // a member of another type, or nested too deeply
        return std::nullopt;
    }
}

ResultStore::ResultStore(std::filesystem::path file) : file_(std::move(file)) {
    std::ifstream input(file_, std::ios::binary);
    for (std::string line; std::getline(input, line);) {
        ends_in_line_ = !input.eof();
        if (std::optional<CaseResult> result = parsed_result(line)) results_[result->key] = std::move(*result);
    }
}

std::optional<CaseResult> ResultStore::find(const std::string& key) const {
    const auto found = results_.find(key);
    return found == results_.end() ? std::nullopt : std::optional(found->second);
}

void ResultStore::add(const CaseResult& result) {
    const std::string text = fmt::format("{}{}\n", ends_in_line_ ? "" : "\n", result_line(result));
    FileDescriptor descriptor(open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (!descriptor) throw system_error_at("write", file_.string(), errno);
    // A line goes out in one piece or, on a full disk, leaves a stump that the next line steps over.
    if (write(descriptor.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()) ||
        fsync(descriptor.get()) != 0)
        throw system_error_at("write", file_.string(), errno);
    ends_in_line_ = true;
    results_[result.key] = result;
}

}  // namespace drape::bench
