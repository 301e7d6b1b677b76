// Prints the scene files of contact_scenes.h: `contact_scene twist 8 601 24 > twist.json`.
#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <vector>

#include "contact_scenes.h"

namespace {

using Numbers = std::vector<std::uint32_t>;

struct Kind {
    std::size_t numbers;
    std::string (*text)(const Numbers&);
    const char* usage;
};

const std::map<std::string, Kind>& kinds() {
    using namespace drape::test;
    static const std::map<std::string, Kind> all{
        {"twist", {3, [](const Numbers& n) { return twisted_strip(n[0], n[1], n[2]); }, "CELLS FRAMES SUBSTEPS"}},
        {"wrung", {1, [](const Numbers& n) { return wrung_strip(n[0]); }, "FRAMES"}},
        {"fold", {3, [](const Numbers& n) { return folding_sheet(n[0], n[1], n[2]); }, "PARTICLES FRAMES SUBSTEPS"}},
        {"cut", {3, [](const Numbers& n) { return cut_folds(n[0], n[1], n[2]); }, "PARTICLES FRAMES SUBSTEPS"}},
        {"stack",
         {5, [](const Numbers& n) { return falling_stack(n[0], n[1], n[2], n[3], n[4]); },
          "SHEETS PARTICLES FRAMES SUBSTEPS APART_MM"}},
        {"crumple",
         {3, [](const Numbers& n) { return crumpled_sheet(n[0], n[1], n[2]); }, "PARTICLES FRAMES SUBSTEPS"}},
        {"heap", {3, [](const Numbers& n) { return collapsing_strip(n[0], n[1], n[2]); }, "LINKS FRAMES SUBSTEPS"}},
        {"random", {2, [](const Numbers& n) { return random_contact_scene(n[0], n[1]); }, "SEED INDEX"}},
    };
    return all;
}

}  // namespace

int main(int argc, char** argv) {
    const auto kind = argc > 1 ? kinds().find(argv[1]) : kinds().end();
    Numbers numbers;
    for (int i = 2; i < argc; ++i) numbers.push_back(static_cast<std::uint32_t>(std::strtoul(argv[i], nullptr, 10)));
    if (kind != kinds().end() && numbers.size() == kind->second.numbers) {
        fmt::print("{}\n", kind->second.text(numbers));
        return 0;
    }
    for (const auto& [name, each] : kinds()) fmt::print(stderr, "contact_scene {} {}\n", name, each.usage);
    return 2;
}
