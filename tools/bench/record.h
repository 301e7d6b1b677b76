// A result as a line of JSON, and back; many results as a table of comma-separated values.
//
// A type of results says its members once, as
//   template <class Self> static void members(Self& self, const auto& see) { see("name", self.name); ... }
// with members of text, numbers, truth values, methods and Metrics.
#pragma once

#include <json/json.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "drape/scene.h"
#include "output/json_text.h"

namespace drape::bench {

/// Errors and other numbers by name, SI units.
using Metrics = std::map<std::string, double>;

/// A number that is not finite, which JSON does not have, is written as "infinite".
Json::Value member_json(const Metrics& numbers);
Json::Value member_json(SolverMethod method);
template <class T>
Json::Value member_json(const T& member) {
    return member;
}

/// These throw Json::Exception for a value of another type.
void read_member(const Json::Value& value, std::string& member);
void read_member(const Json::Value& value, Metrics& member);
void read_member(const Json::Value& value, SolverMethod& member);
template <class T>
void read_member(const Json::Value& value, T& member) {
    member = value.as<T>();
}

template <class Result>
Json::Value json_of(const Result& result) {
    Json::Value value(Json::objectValue);
    Result::members(result, [&](const char* name, const auto& member) { value[name] = member_json(member); });
    return value;
}

/// Points as arrays of two numbers.
Json::Value points_json(const std::vector<std::array<double, 2>>& points);

/// The value of a line; null when it is no JSON. Throws Json::Exception where it is nested too deeply.
Json::Value parsed_line(const std::string& line);

/// Nothing when the line is not the JSON of a whole result.
template <class Result>
std::optional<Result> parsed_result(const std::string& line) try {
    const Json::Value value = parsed_line(line);
    if (!value.isObject()) return std::nullopt;
    Result result;
    Result::members(result, [&](const char* name, auto& member) {
        if (!value.isMember(name)) Json::throwLogicError(name);
        read_member(value[name], member);
    });
    return result;
} catch (const Json::Exception&) {
    return std::nullopt;
}

/// A line of column names and one per row, which is an object; empty where it has no such member.
std::string csv_table(const std::vector<Json::Value>& rows, const std::vector<std::string>& columns);

}  // namespace drape::bench
