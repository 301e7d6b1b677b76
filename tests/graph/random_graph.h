#pragma once

#include <cstdint>
#include <random>

#include "graph/graph.h"

namespace drape::graph {

/// Makes random graphs of images and buffers of every lifetime, each with the accesses that its kind allows.
class RandomGraphs {
  public:
    explicit RandomGraphs(std::uint32_t seed);
    /// Returns another graph over the same resources.
    Graph make(std::uint32_t pass_count);

  private:
    std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(random_() % bound); }
    void declare(Graph& graph, std::uint32_t kind, std::uint32_t index);
    void use_something(Graph& graph, PassSetup& setup);
    std::mt19937 random_;
    std::vector<std::uint32_t> kinds_;
    std::vector<Handle> handles_;
};

}  // namespace drape::graph
