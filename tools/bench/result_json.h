// A case's result as JSON: a line of the store, and a row of the report.
#pragma once

#include <json/value.h>

#include <optional>

#include "bench/bench_case.h"

namespace drape::bench {

Json::Value json_of(const CaseResult& result);
/// Nothing unless every member is there. Throws Json::Exception for members of other types.
std::optional<CaseResult> result_of(const Json::Value& value);

}  // namespace drape::bench
