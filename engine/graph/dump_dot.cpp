#include <fmt/core.h>

#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>

#include "graph/dump.h"

namespace drape::graph {
namespace {

/// Lines are placed below each other: side by side they would make the picture wide.
std::string in_quotes(const std::vector<std::string>& lines, const char* line_end = "\\n") {
    std::string out = "\"";
    for (const std::string& line : lines) {
        if (&line != &lines.front()) out += line_end;
        for (const char c : line) {
            if (c == '"' || c == '\\') out += '\\';
            out += c;
        }
    }
    return out + "\"";
}

std::string in_quotes(const std::string& text) { return in_quotes(std::vector{text}); }

/// Boxes are passes (one per folded place), arrows the resources that flow between them, ellipses what enters from and
/// leaves to other frames or the host; dashed arrows lead back into a repeated block.
class DotWriter {
  public:
    DotWriter(const Graph& graph, const Plan& plan)
        : graph_(graph), plan_(plan), folding_(fold_passes(graph, plan)), writers_(graph.resources().size()) {
        text_ = "digraph frame {\n  rankdir=TB;\n  node [shape=box, fontname=\"sans-serif\"];\n";
        write_folds(folding_.folds, 1);
        collect_edges();
        for (const auto& [edge, names] : edges_) write_edge(edge, names);
        write_skipped();
        text_ += "}\n";
    }
    std::string take() { return std::move(text_); }

  private:
    using Edge = std::pair<std::string, std::string>;
    struct Names {
        std::set<std::string> forward, back;
    };

    static std::string node(std::uint32_t representative) { return fmt::format("pass{}", representative); }

    void write_folds(std::span<const Fold> folds, std::size_t depth) {
        const std::string indent(depth * 2, ' ');
        for (const Fold& fold : folds) {
            if (fold.body.empty()) {
                const Pass& pass = graph_.passes()[plan_.passes[fold.position].pass];
                text_ += fmt::format("{}{} [label={}, tooltip={}];\n", indent, node(fold.position),
                                     in_quotes(pass.label), in_quotes(pass.stage));
                continue;
            }
            text_ += fmt::format("{}subgraph cluster{} {{\n{}  label=\"x {}\";\n", indent, cluster_count_++, indent,
                                 fold.count);
            write_folds(fold.body, depth + 1);
            text_ += indent + "}\n";
        }
    }

    /// An arrow starts at the node that made what a pass reads: a pass, or the resource as it was before the frame.
    void arrow_to(std::uint32_t resource, std::uint32_t position) {
        const std::uint32_t reader = folding_.representative[position];
        const std::string& name = graph_.resources()[resource].name;
        if (!writers_[resource]) {
            edges_[{fmt::format("resource{}", resource), node(reader)}].forward.insert("");
            shown_.insert(resource);
            return;
        }
        const std::uint32_t writer = *writers_[resource];
        Names& names = edges_[{node(writer), node(reader)}];
        (writer >= reader ? names.back : names.forward).insert(name);
    }

    void collect_edges() {
        for (std::uint32_t p = 0; p < plan_.passes.size(); ++p) {
            const Pass& pass = graph_.passes()[plan_.passes[p].pass];
            for (const Use& use : pass.uses) {
                // A write keeps what it does not overwrite, so it too depends on the version before; the first write of
                // a transient has none.
                const bool fresh = is_write(use.access) && use.handle.version == 1 &&
                                   graph_.resources()[use.handle.resource].lifetime == Lifetime::transient;
                if (!fresh) arrow_to(use.handle.resource, p);
            }
            for (const Use& use : pass.uses) {
                if (is_write(use.access)) writers_[use.handle.resource] = folding_.representative[p];
            }
        }
        for (std::uint32_t r = 0; r < writers_.size(); ++r) {
            const Lifetime lifetime = graph_.resources()[r].lifetime;
            if (!writers_[r] || lifetime == Lifetime::transient) continue;
            edges_[{node(*writers_[r]), fmt::format("resource{}", r)}].forward.insert("");
            shown_.insert(r);
        }
        for (const std::uint32_t r : shown_) {
            const Resource& resource = graph_.resources()[r];
            text_ += fmt::format("  resource{} [shape=ellipse, label={}];\n", r,
                                 in_quotes(fmt::format("{} ({})", resource.name, lifetime_name(resource.lifetime))));
        }
    }

    void write_edge(const Edge& edge, const Names& names) {
        for (const bool back : {false, true}) {
            const std::set<std::string>& list = back ? names.back : names.forward;
            if (list.empty()) continue;
            text_ += fmt::format("  {} -> {} [label={}{}];\n", edge.first, edge.second,
                                 in_quotes(std::vector(list.begin(), list.end())),
                                 back ? ", style=dashed, constraint=false" : "");
        }
    }

    void write_note(const char* name, const char* colour, std::vector<std::string> lines) {
        if (lines.empty()) return;
        lines.insert(lines.begin(), std::string(name) + ":");
        lines.emplace_back();  // a line that ends in \l stands at the left
        text_ += fmt::format("  {} [style=dashed, color={}, label={}];\n", name, colour, in_quotes(lines, "\\l"));
    }

    void write_skipped() {
        std::vector<std::string> skipped, compromises, choices;
        for (const SkippedGroup& group : group_skipped(graph_, plan_)) {
            const std::string times = group.count > 1 ? fmt::format(" x {}", group.count) : "";
            skipped.push_back(group.what + times + ": " + group.reason);
        }
        for (const Remark& compromise : graph_.compromises())
            compromises.push_back(compromise.what + ": " + compromise.reason);
        for (const Remark& choice : graph_.choices()) choices.push_back(choice.what + ": " + choice.reason);
        write_note("skipped", "gray", std::move(skipped));
        write_note("compromises", "orange", std::move(compromises));
        write_note("kernels", "gray", std::move(choices));
    }

    const Graph& graph_;
    const Plan& plan_;
    Folding folding_;
    std::vector<std::optional<std::uint32_t>> writers_;  ///< representative of the latest writer
    std::map<Edge, Names> edges_;
    std::set<std::uint32_t> shown_;
    std::size_t cluster_count_ = 0;
    std::string text_;
};

}  // namespace

std::string dump_dot(const Graph& graph, const Plan& plan) { return DotWriter(graph, plan).take(); }

}  // namespace drape::graph
