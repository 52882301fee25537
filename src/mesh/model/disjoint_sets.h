// Sets of numbers that are joined two by two.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace raytube {

/// Disjoint sets of the numbers below some count, at first each by itself. Each set is a tree.
class DisjointSets {
 public:
  /// Of the numbers below `count`.
  explicit DisjointSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }

  /// The member that stands for the set of `i`; with path halving.
  std::uint32_t root(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

  /// Adds the set of `other` to that of `to`, whose root stands for both.
  void join(std::uint32_t to, std::uint32_t other) { parents_[root(other)] = root(to); }

  /// The set of each member, numbered in order of the sets' first members.
  std::vector<std::uint32_t> numbers() {
    std::vector<std::uint32_t> number(parents_.size(), 0xffffffffu), set(parents_.size());
    std::uint32_t sets = 0;
    for (std::uint32_t i = 0; i < parents_.size(); ++i) {
      std::uint32_t& mine = number[root(i)];
      if (mine == 0xffffffffu) mine = sets++;
      set[i] = mine;
    }
    return set;
  }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace raytube
