#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>

#include "graph/dump.h"

namespace drape::graph {
namespace {

/// A table in text form. Cells are padded to the width of their column; the last column is not.
template <std::size_t Columns>
class Table {
  public:
    using Row = std::array<std::string, Columns>;
    void row(std::size_t indent, Row cells) {
        cells[0].insert(0, indent * 2, ' ');
        rows_.push_back({std::move(cells), {}});
    }
    /// Adds a line that is no row and does not affect the widths of columns.
    void line(std::string text) { rows_.push_back({{}, std::move(text)}); }

    std::string text() const {
        std::array<std::size_t, Columns> widths{};
        for (const auto& [cells, line] : rows_) {
            for (std::size_t c = 0; c < Columns; ++c) widths[c] = std::max(widths[c], cells[c].size());
        }
        std::string text;
        for (const auto& [cells, line] : rows_) {
            std::string out = line;
            for (std::size_t c = 0; line.empty() && c < Columns; ++c) {
                out += c + 1 == Columns ? cells[c] : fmt::format("{:<{}}  ", cells[c], widths[c]);
            }
            text += "  " + out.substr(0, out.find_last_not_of(' ') + 1) + "\n";
        }
        return text;
    }

  private:
    std::vector<std::pair<Row, std::string>> rows_;
};
using PassTable = Table<6>;

class PassLister {
  public:
    PassLister(const Graph& graph, const Plan& plan) : graph_(graph), plan_(plan), folding_(fold_passes(graph, plan)) {
        barriers_.resize(plan.passes.size(), {SIZE_MAX, 0});
        for (std::size_t p = 0; p < plan.passes.size(); ++p) {
            auto& [least, most] = barriers_[folding_.representative[p]];
            least = std::min(least, plan.passes[p].barriers.size());
            most = std::max(most, plan.passes[p].barriers.size());
        }
        table_.row(0, {"#", "stage", "pass", "reads", "writes", "barriers"});
        list(folding_.folds, 0);
    }
    std::string text() const { return table_.text(); }

  private:
    void list(std::span<const Fold> folds, std::size_t indent) {
        for (const Fold& fold : folds) {
            if (fold.body.empty()) {
                list_pass(fold.position, indent);
            } else if (fold.body.size() == 1 && fold.body[0].body.empty()) {
                list_pass(fold.position, indent, fmt::format(" x {}", fold.count));
            } else {
                table_.line(fmt::format("{}x {} {{", std::string(indent * 2, ' '), fold.count));
                list(fold.body, indent + 1);
                table_.line(std::string(indent * 2, ' ') + "}");
            }
        }
    }

    void list_pass(std::uint32_t position, std::size_t indent, const std::string& times = {}) {
        const Pass& pass = graph_.passes()[plan_.passes[position].pass];
        std::string reads, writes;
        for (const Use& use : pass.uses) {
            std::string& list = is_write(use.access) ? writes : reads;
            const std::string& name = graph_.resources()[use.handle.resource].name;
            if (!list.empty()) list += ", ";
            list += name;
        }
        const auto [least, most] = barriers_[position];
        table_.row(indent, {fmt::format("{}", position), pass.stage, pass.label + times, reads, writes,
                            least == most ? fmt::format("{}", most) : fmt::format("{}-{}", least, most)});
    }

    const Graph& graph_;
    const Plan& plan_;
    Folding folding_;
    std::vector<std::pair<std::size_t, std::size_t>> barriers_;  ///< the smallest and largest number, by representative
    PassTable table_;
};

std::string describe(const Resource& resource) {
    if (!resource.is_image) return "buffer";
    const ImageDeclaration& image = resource.image;
    std::string text = fmt::format("image {} {}x{}", format_name(image.format), image.width, image.height);
    if (image.samples != VK_SAMPLE_COUNT_1_BIT) text += fmt::format(" {} samples", static_cast<int>(image.samples));
    if (image.buffer_view) text += ", buffer view";
    return text;
}

std::string list_resources(const Graph& graph, const Plan& plan) {
    Table<5> made;
    std::string unmade;
    made.row(0, {"resource", "kind", "lifetime", "size", "passes"});
    for (std::size_t r = 0; r < graph.resources().size(); ++r) {
        const Resource& resource = graph.resources()[r];
        const Lifespan& lifespan = plan.lifespans[r];
        if (!lifespan.used()) {
            unmade += fmt::format("  {} ({}, {}): no pass that runs uses it\n", resource.name, describe(resource),
                                  size_text(resource.byte_count()));
            continue;
        }
        const std::uint32_t copies = copy_count(resource);
        std::string size = size_text(resource.byte_count());
        if (copies > 1) size += fmt::format(" x {} slots", copies);
        made.row(0, {resource.name, describe(resource), std::string(lifetime_name(resource.lifetime)), size,
                     fmt::format("{}-{}", lifespan.first, lifespan.last)});
    }
    std::string text = fmt::format("resources: {}\n{}", size_text(plan.byte_count), made.text());
    if (!unmade.empty()) text += "not made:\n" + unmade;
    return text;
}

}  // namespace

std::string dump_text(const Graph& graph, const Plan& plan) {
    std::string text = fmt::format("passes: {} of {}, {} barriers ({} after the last pass)\n", plan.passes.size(),
                                   graph.passes().size(), barrier_count(plan), plan.final_barriers.size());
    text += PassLister(graph, plan).text();
    text += list_resources(graph, plan);
    text += "skipped:\n";
    const auto groups = group_skipped(graph, plan);
    for (const SkippedGroup& group : groups) {
        const std::string times = group.count > 1 ? fmt::format(" x {}", group.count) : "";
        text += fmt::format("  {}{}: {}\n", group.what, times, group.reason);
    }
    if (groups.empty()) text += "  nothing\n";
    const auto list = [&](const char* title, const std::vector<Remark>& remarks) {
        if (!remarks.empty()) text += title;
        for (const Remark& remark : remarks) text += fmt::format("  {}: {}\n", remark.what, remark.reason);
    };
    list("compromised:\n", graph.compromises());
    list("kernels:\n", graph.choices());
    return text;
}

}  // namespace drape::graph
