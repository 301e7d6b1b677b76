#include "graph/fold.h"

#include <algorithm>
#include <map>
#include <utility>

namespace drape::graph {
namespace {

constexpr std::size_t longest_block = 2048;  // items; bounds the search on sequences without repetition

/// Folds a sequence. Equal ids mean equal content, because leaves and repeated blocks share one numbering.
class Folder {
  public:
    explicit Folder(std::span<const std::uint32_t> sequence) {
        for (const std::uint32_t item : sequence) items_.push_back(intern({1, {item}}));
        // A folded block is one item, so the block around it may now repeat at a length already tried.
        for (std::size_t length = 1; length <= std::min(items_.size() / 2, longest_block);) {
            length = fold_blocks(length) ? 1 : length + 1;
        }
        result_.representative.resize(sequence.size());
        std::uint32_t position = 0;
        for (const std::uint32_t item : items_) {
            result_.folds.push_back(tree(item, position));
            position = represent(item, position, position);
        }
    }
    Folding take() { return std::move(result_); }

  private:
    /// A leaf has count 1 and the item, a block count > 1 and the ids of its parts.
    using Node = std::pair<std::uint32_t, std::vector<std::uint32_t>>;

    std::uint32_t intern(Node node) {
        const auto [place, added] = ids_.emplace(std::move(node), static_cast<std::uint32_t>(nodes_.size()));
        if (added) nodes_.push_back(&place->first);
        return place->second;
    }

    bool fold_blocks(std::size_t length) {
        std::vector<std::uint32_t> folded;
        for (std::size_t i = 0; i < items_.size();) {
            const auto block = items_.begin() + static_cast<std::ptrdiff_t>(i);
            std::uint32_t count = 1;
            while (i + (count + 1) * length <= items_.size() &&
                   std::equal(block, block + static_cast<std::ptrdiff_t>(length),
                              block + static_cast<std::ptrdiff_t>(count * length))) {
                ++count;
            }
            if (count == 1) {
                folded.push_back(items_[i++]);
                continue;
            }
            folded.push_back(intern({count, {block, block + static_cast<std::ptrdiff_t>(length)}}));
            i += count * length;
        }
        const bool found = folded.size() < items_.size();
        items_ = std::move(folded);
        return found;
    }

    std::uint32_t span(std::uint32_t id) const {
        const auto& [count, parts] = *nodes_[id];
        if (count == 1) return 1;
        std::uint32_t sum = 0;
        for (const std::uint32_t part : parts) sum += span(part);
        return count * sum;
    }

    Fold tree(std::uint32_t id, std::uint32_t position) const {
        const auto& [count, parts] = *nodes_[id];
        Fold fold{count, position, {}};
        if (count == 1) return fold;
        for (const std::uint32_t part : parts) {
            fold.body.push_back(tree(part, position));
            position += span(part);
        }
        return fold;
    }

    /// Fills `representative` from `position` on; returns the position after the node.
    std::uint32_t represent(std::uint32_t id, std::uint32_t position, std::uint32_t stands_for_it) {
        const auto& [count, parts] = *nodes_[id];
        if (count == 1) {
            result_.representative[position] = stands_for_it;
            return position + 1;
        }
        for (std::uint32_t repetition = 0; repetition < count; ++repetition) {
            std::uint32_t place = stands_for_it;
            for (const std::uint32_t part : parts) {
                const std::uint32_t next = represent(part, position, place);
                place += next - position;
                position = next;
            }
        }
        return position;
    }

    std::map<Node, std::uint32_t> ids_;
    std::vector<const Node*> nodes_;
    std::vector<std::uint32_t> items_;
    Folding result_;
};

}  // namespace

Folding fold(std::span<const std::uint32_t> sequence) { return Folder(sequence).take(); }

}  // namespace drape::graph
