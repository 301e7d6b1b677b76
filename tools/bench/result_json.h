// A case's result as JSON: a line of the store, and a row of the report.
#pragma once

#include <json/value.h>

#include <optional>
#include <string>

#include "bench/bench_case.h"

namespace drape::bench {

/// Null when it is no JSON. Throws Json::Exception where it is nested too deeply.
Json::Value parsed_line(const std::string& line);

Json::Value json_of(const CaseResult& result);
/// Nothing unless every member is there. Throws Json::Exception for members of other types.
std::optional<CaseResult> result_of(const Json::Value& value);

}  // namespace drape::bench
