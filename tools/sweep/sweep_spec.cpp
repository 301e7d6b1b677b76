#include "sweep/sweep_spec.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "output/atomic_file.h"
#include "output/json_text.h"
#include "scene/scene_value.h"

namespace drape::sweep {

namespace {

constexpr std::string_view distribution_names = "uniform, log_uniform, normal, integer, choice or grid";

bool read_two(const SceneNode& node, double& first, double& second, std::string_view what) {
    std::array<double, 2> pair{};
    if (!node.read(std::span<double>(pair), what, any_number)) return false;
    first = pair[0], second = pair[1];
    return true;
}

/// Reads two numbers, the first below the second.
bool read_range(const SceneNode& node, double& low, double& high) {
    if (!read_two(node, low, high, "an array of 2 numbers, [low, high]")) return false;
    return low < high || node.fail_expected("a low end below the high one");
}

bool read_values(const SceneNode& node, std::vector<std::string>& values) {
    if (!node.open_array("an array of 1 to 1000000 values", 1, 1'000'000)) return false;
    for (std::size_t i = 0; i < node.size(); ++i) values.push_back(json_line(*node.element(i).value()));
    return true;
}

bool read_whole_numbers(const SceneNode& node, WholeNumber& range) {
    double low = 0, high = 0;
    constexpr double most = 9007199254740992;  // 2^53: doubles are exact
    if (!read_two(node, low, high, "an array of 2 integers, [low, high]")) return false;
    if (low != std::floor(low) || high != std::floor(high) || low > high || low < -most || high > most)
        return node.fail_expected("two integers, the first not above the second");
    range = {static_cast<std::int64_t>(low), static_cast<std::int64_t>(high)};
    return true;
}

/// Returns the share of the draws that is within the limits.
double share_within(const Normal& normal) {
    const auto below = [&](double limit) {  // of a deviation of 0 all are at the mean
        const double distance = (limit - normal.mean) / std::max(normal.deviation, DBL_MIN);
        return std::erfc(-distance / std::numbers::sqrt2) / 2;
    };
    return below(normal.high) - below(normal.low);
}

bool read_normal(const SceneNode& object, const SceneNode& node, Normal& normal) {
    bool fits = read_two(node, normal.mean, normal.deviation, "an array of 2 numbers, [mean, standard deviation]");
    if (fits && normal.deviation < 0) fits = node.fail_expected("a standard deviation of at least 0");
    normal.low = -FLT_MAX, normal.high = FLT_MAX;
    const SceneNode within = object.member("within");
    if (!within || !fits) return fits;
    if (!read_range(within, normal.low, normal.high)) return false;
    constexpr double least_share = 0.005;  // then 10,000 draws miss it once in 10^21 times
    return share_within(normal) >= least_share ||
           within.fail_expected("limits with at least 0.5 % of the normal distribution between them");
}

template <class Range>
bool read_reals(const SceneNode& node, Distribution& distribution) {
    Range range{};
    const bool fits = read_range(node, range.low, range.high);
    distribution = range;
    return fits;
}

template <class Values>
bool read_list(const SceneNode& node, Distribution& distribution) {
    Values values;
    const bool fits = read_values(node, values.values);
    distribution = std::move(values);
    return fits;
}

/// The keys of a distribution, whose values the functions above read.
const Definition& distribution_keys() {
    static const Definition keys = [] {
        Definition definition;
        definition.name = "distribution";
        for (const char* name : {"uniform", "log_uniform", "normal", "within", "integer", "choice", "grid"})
            definition.keys.push_back({.name = name, .help = "", .schema = {}, .words = {}, .default_value = {}});
        return definition;
    }();
    return keys;
}

bool read_distribution(const SceneNode& node, Distribution& distribution) {
    if (!node.open_object(distribution_keys())) return false;
    std::size_t count = 0;
    bool fits = true;
    const auto read = [&](const char* name, const auto& read_value) {
        const SceneNode value = node.member(name);
        if (!value) return;
        ++count;
        fits = read_value(value) && fits;
    };
    read("uniform", [&](const SceneNode& value) { return read_reals<Uniform>(value, distribution); });
    read("log_uniform", [&](const SceneNode& value) {
        if (!read_reals<LogUniform>(value, distribution)) return false;
        return std::get<LogUniform>(distribution).low > 0 || value.fail_expected("a low end above 0");
    });
    read("normal", [&](const SceneNode& value) {
        Normal normal{};
        const bool good = read_normal(node, value, normal);
        distribution = normal;
        return good;
    });
    read("integer", [&](const SceneNode& value) {
        WholeNumber range{};
        const bool good = read_whole_numbers(value, range);
        distribution = range;
        return good;
    });
    read("choice", [&](const SceneNode& value) { return read_list<Choice>(value, distribution); });
    read("grid", [&](const SceneNode& value) { return read_list<GridValues>(value, distribution); });
    if (count != 1) return node.fail(fmt::format("expected exactly one of {}, got {}", distribution_names, count));
    if (node.member("within") && !node.member("normal"))
        return node.member("within").fail("expected \"within\" beside \"normal\" only");
    return fits;
}

/// Reads the members of an object whose keys are JSON pointers.
template <class Take>
bool read_pointers(const SceneNode& node, const Take& take) {
    if (!node) return true;
    if (!node.value()->isObject()) return node.fail_expected("an object");
    bool fits = true;
    for (const std::string& pointer : node.value()->getMemberNames()) {
        const SceneNode value = node.member(pointer);
        const bool is_pointer = pointer.starts_with('/') && pointer.find('=') == std::string::npos;
        fits = (is_pointer ? take(pointer, value) : value.fail("expected a JSON pointer such as /wind/velocity/0")) &&
               fits;
    }
    return fits;
}

bool read_vary(const SceneNode& node, SweepSpec& spec) {
    return read_pointers(node, [&](const std::string& pointer, const SceneNode& value) {
        return read_distribution(value, spec.parameters[pointer]);
    });
}

bool read_set(const SceneNode& node, SweepSpec& spec) {
    return read_pointers(node, [&](const std::string& pointer, const SceneNode& value) {
        spec.set.push_back(pointer + "=" + json_line(*value.value()));
        return true;
    });
}

std::uint64_t grid_size(const SweepSpec& spec) {
    std::uint64_t size = 1;
    for (const auto& [pointer, distribution] : spec.parameters)
        if (const auto* grid = std::get_if<GridValues>(&distribution))
            size = std::min<std::uint64_t>(size * grid->values.size(), std::uint64_t{most_runs} + 1);
    return size;
}

bool check_sweep(const Members& members, SweepSpec& spec) {
    if (!members.fit({"vary", "count"}) || members["count"]) return true;
    const bool has_grid = std::ranges::any_of(
        spec.parameters, [](const auto& entry) { return std::holds_alternative<GridValues>(entry.second); });
    const std::uint64_t size = grid_size(spec);
    if (!has_grid) return members.object().fail("expected a count of runs: without a grid there is no other");
    if (size > most_runs) return members["vary"].fail(fmt::format("expected a grid of at most {} runs", most_runs));
    spec.count = static_cast<std::uint32_t>(size);
    return true;
}

bool check_split(const Members& members, Split& split) {
    if (!members.all_fit() || std::abs(split.train + split.validation + split.test - 1) <= 1e-9) return true;
    return members.object().fail(
        fmt::format("expected shares that add up to 1, got {:.6g}", split.train + split.validation + split.test));
}

const Object<Split>& split_format() {
    static const Object<Split> object{"split",
                                      "The shares of the runs that train, choose and judge a model.",
                                      {
                                          {"train", &Split::train, number(unit_interval), "Share of the runs."},
                                          {"validation", &Split::validation, number(unit_interval), "Likewise."},
                                          {"test", &Split::test, number(unit_interval), "Likewise."},
                                      },
                                      check_split};
    return object;
}

Value<std::uint64_t> seed_value() {
    return {{"\"type\": \"integer\"", "integer"}, [](const SceneNode& node, std::uint64_t& seed) {
                std::uint32_t read = 0;
                const bool fits = node.read(read, 0, UINT32_MAX);
                if (node && fits) seed = read;
                return fits;
            }};
}

const Object<SweepSpec>& format() {
    static const Object<SweepSpec> object{
        "sweep",
        "A scene, and which of its values change from run to run.",
        {
            {"scene", &SweepSpec::scene, text(), "The scene file, relative to this one.", "the path of a scene file"},
            {"seed", &SweepSpec::seed, seed_value(), "Of the random numbers."},
            {"count", &SweepSpec::count, integer(1, most_runs), "Runs; default: one per combination of the grids."},
            {"set", ValueText{"\"type\": \"object\"", "object"}, read_set, "Values that all runs have."},
            {"split", &SweepSpec::split, optional<Split>(split_format()), "Parts of a data set."},
            {"vary", ValueText{"\"type\": \"object\"", "object"}, read_vary, "What changes."},
        },
        check_sweep};
    return object;
}

}  // namespace

SweepSpec read_sweep_text(std::string_view text, const std::string& path) {
    SceneDocument document(text, path);
    SceneReport report{document, {}, {}};
    SweepSpec spec;
    spec.text = text;
    SceneResult result;
    for (const PlacedError& error : document.errors()) result.errors.push_back(error.error);
    if (result.errors.empty()) {
        const SceneNode root(report, document.root());
        format().read(root, spec);
        result.errors = report.errors.told();
    }
    if (!result.errors.empty()) throw SceneFailure(std::move(result));
    spec.scene = (std::filesystem::path(path).parent_path() / spec.scene).string();
    return spec;
}

SweepSpec read_sweep(const std::string& path) { return read_sweep_text(read_file(path), path); }

std::map<std::string, std::string> SweepSpec::parameters_of(std::uint32_t index) const {
    std::map<std::string, std::string> values;
    std::uint64_t rest = index;
    // The last grid in the order of pointers changes fastest.
    for (auto entry = parameters.rbegin(); entry != parameters.rend(); ++entry) {
        const auto& [pointer, distribution] = *entry;
        if (const auto* grid = std::get_if<GridValues>(&distribution)) {
            values[pointer] = grid->values[rest % grid->values.size()];
            rest /= grid->values.size();
        } else {
            values[pointer] = drawn(distribution, seed, index, pointer);
        }
    }
    return values;
}

std::string_view SweepSpec::part_of(std::uint32_t index) const {
    if (!split) return {};
    const double place = std::stod(drawn(Uniform{0, 1}, seed, index, "split"));  // no JSON pointer is called so
    return place < split->train ? "train" : place < split->train + split->validation ? "validation" : "test";
}

std::vector<std::string> SweepSpec::overrides_of(std::uint32_t index) const {
    std::vector<std::string> overrides = set;
    for (const auto& [pointer, value] : parameters_of(index)) overrides.push_back(fmt::format("{}={}", pointer, value));
    return overrides;
}

}  // namespace drape::sweep
