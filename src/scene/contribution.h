// What one mechanism gives one look: the same for all of them, so that looks are kept, sent and written by one loop.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/field.h"

namespace raytube {

/// How the counts of several bands of frequencies become one count of the look. Counts of looks are added up.
enum class Fold : std::uint8_t {
  sum,   // they are added up
  most,  // the largest one
  least  // the smallest one
};

/// Something that a mechanism did so often, or left out for a reason.
struct Count {
  std::string what;         // done: its name in run.json; left out: in words
  std::string why{};        // it was left out, and a remedy where there is one; empty: it was done
  std::uint64_t count = 0;  // how often
  Fold fold = Fold::sum;    // over bands

  /// Whether both count the same thing.
  bool like(const Count& other) const { return what == other.what && why == other.why; }
  /// All members, as bytes are made of them (core/bytes.h).
  static void members(auto& c, auto&& take) { take(c.what), take(c.why), take(c.count), take(c.fold); }
};

/// Adds a count to those of the same thing, as its `fold` says.
inline void put(Count part, std::vector<Count>& all) {
  const auto found = std::ranges::find_if(all, [&](const Count& each) { return each.like(part); });
  if (found == all.end()) return all.push_back(std::move(part));
  std::uint64_t& count = found->count;
  count = part.fold == Fold::sum    ? count + part.count
          : part.fold == Fold::most ? std::max(count, part.count)
                                    : std::min(count, part.count);
}

/// A count by its name; 0 if there is none.
inline std::uint64_t count_named(const std::vector<Count>& counts, std::string_view what) {
  const auto found = std::ranges::find(counts, what, &Count::what);
  return found == counts.end() ? 0 : found->count;
}

/// One mechanism in one look, at all frequencies of a band or of a sweep. Phase reference as for the tubes.
struct Contribution {
  std::vector<std::vector<ScatteringMatrix>> s{};  // [column of the mechanism][frequency] [m]; empty columns add nothing
  std::vector<ChannelErrors> error{};              // [frequency] estimated numerical error [m]; empty: none
  std::vector<double> missing{};                   // [frequency] left out for the budget's sake [m]; empty: nothing
  std::vector<bool> ran{};                         // [frequency]; empty: at none
  double most_db = 0.0;         // most by which it was expected to move a co-polar row where it did not run [dB]
  double work = 0.0;            // counted work (utd/wedge/work.h)
  double reach = 1.0;           // share of what is expected of it that its budget allows, where that is too little
  std::vector<Count> counts{};  // of what it did and left out

  /// Its budget was too small for it to be begun.
  bool out_of_reach() const { return reach < 1.0; }
  /// It ran at this frequency.
  bool ran_at(std::size_t frequency) const { return !ran.empty() && ran[frequency]; }
  /// S of one column at one frequency; zero where nothing is added [m].
  ScatteringMatrix at(std::size_t column, std::size_t frequency) const {
    return column < s.size() && !s[column].empty() ? s[column][frequency] : ScatteringMatrix();
  }
  /// All members, as bytes are made of them (core/bytes.h).
  static void members(auto& c, auto&& take) {
    take(c.s), take(c.error), take(c.missing), take(c.ran), take(c.most_db), take(c.work), take(c.reach), take(c.counts);
  }
};

}  // namespace raytube
