#include "bench/store.h"

#include <json/json.h>

#include "bench/result_json.h"
#include "output/json_text.h"

namespace drape::bench {

std::string result_line(const CaseResult& result) { return json_line(json_of(result)); }

std::optional<CaseResult> parsed_result(const std::string& line) {
    try {
        return result_of(parsed_line(line));
    } catch (const Json::Exception&) {  // a member of another type, or nested too deeply
        return std::nullopt;
    }
}

ResultStore::ResultStore(const std::filesystem::path& file)
    : file_(file, [this](const std::string& line) {
          if (std::optional<CaseResult> result = parsed_result(line)) results_[result->key] = std::move(*result);
      }) {}

std::optional<CaseResult> ResultStore::find(const std::string& key) const {
    const auto found = results_.find(key);
    return found == results_.end() ? std::nullopt : std::optional(found->second);
}

void ResultStore::add(const CaseResult& result) {
    file_.add(result_line(result));
    results_[result.key] = result;
}

}  // namespace drape::bench
