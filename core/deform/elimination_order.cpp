// SPDX-License-Identifier: Apache-2.0
#include "core/deform/elimination_order.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

enum class Cost : uint8_t { neighbours, pairs, pairs_over_root, pairs_over_neighbours };

class Greedy {
 public:
  Greedy(Arena& scratch, std::size_t n)
      : graph_(scratch, n),
        degree_(scratch.take<uint32_t>(n)),
        pairs_(scratch.take<uint32_t>(n)),
        gone_(scratch.take<uint8_t>(n)) {}
  bool ok() const { return graph_.ok() && !degree_.empty() && !pairs_.empty() && !gone_.empty(); }

  // Returns the number of entries of the factor.
  std::size_t order(const BitTable& graph, Cost by, std::span<uint16_t> place) {
    graph_.copy(graph);
    std::fill(gone_.begin(), gone_.end(), uint8_t{0});
    for (std::size_t v = 0; v < pairs_.size(); ++v) {
      degree_[v] = static_cast<uint32_t>(graph_.count(v));
      pairs_[v] = apart(v);
    }
    std::size_t entries = 0;
    for (uint16_t& next : place) {
      const std::size_t v = cheapest(by);
      next = static_cast<uint16_t>(v);
      entries += degree_[v];
      take_out(v);
    }
    return entries;
  }

 private:
  // Pairs of neighbours that are not joined, each counted twice.
  uint32_t apart(std::size_t v) const {
    std::size_t joined = 0;
    graph_.each(v, [&](std::size_t j) { joined += graph_.count_common(v, j); });
    return degree_[v] * (degree_[v] - 1) - static_cast<uint32_t>(joined);
  }

  double cost(std::size_t v, Cost by) const {
    const auto pairs = static_cast<double>(pairs_[v]), neighbours = static_cast<double>(degree_[v]);
    switch (by) {
      case Cost::neighbours:
        return neighbours;
      case Cost::pairs:
        return pairs;
      case Cost::pairs_over_root:
        return pairs / det::sqrt(neighbours + 1.0);
      default:
        return pairs / (neighbours + 1.0);
    }
  }

  std::size_t cheapest(Cost by) const {
    std::size_t best = pairs_.size();
    double least = 0.0;
    for (std::size_t v = 0; v < pairs_.size(); ++v) {
      if (gone_[v]) continue;
      const double here = cost(v, by);
      if (best == pairs_.size() || here < least) best = v, least = here;
    }
    return best;
  }

  void take_out(std::size_t v) {
    gone_[v] = 1;
    graph_.each(v, [&](std::size_t j) {
      graph_.clear(j, v);
      --degree_[j];
      pairs_[j] -= 2 * (degree_[j] - static_cast<uint32_t>(graph_.count_common(j, v)));
    });
    graph_.each(v, [&](std::size_t a) {
      graph_.each(v, [&](std::size_t b) {
        if (a < b && !graph_.at(a, b)) join(a, b);
      });
    });
  }

  void join(std::size_t a, std::size_t b) {
    const auto common = static_cast<uint32_t>(graph_.count_common(a, b));
    graph_.each_common(a, b, [&](std::size_t q) { pairs_[q] -= 2; });
    pairs_[a] += 2 * (degree_[a]++ - common);
    pairs_[b] += 2 * (degree_[b]++ - common);
    graph_.set(a, b);
    graph_.set(b, a);
  }

  BitTable graph_;
  std::span<uint32_t> degree_, pairs_;
  std::span<uint8_t> gone_;
};

}  // namespace

bool smallest_factor_order(Arena& scratch, const BitTable& graph, std::span<uint16_t> place) {
  Greedy greedy(scratch, graph.size());
  const auto candidate = scratch.take<uint16_t>(place.size());
  if (!greedy.ok() || candidate.empty() || place.size() != graph.size()) return false;
  std::size_t fewest = greedy.order(graph, Cost::neighbours, place);
  for (const Cost by : {Cost::pairs, Cost::pairs_over_root, Cost::pairs_over_neighbours}) {
    const std::size_t entries = greedy.order(graph, by, candidate);
    if (entries >= fewest) continue;
    fewest = entries;
    std::copy(candidate.begin(), candidate.end(), place.begin());
  }
  return true;
}

}  // namespace nt
