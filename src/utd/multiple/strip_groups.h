// Strips whose waves are added up in one bin of paths. Notation in multiple_diffraction.h.
#pragma once

#include "math/path_bins.h"
#include "utd/multiple/strip_layout.h"

namespace raytube {

/// S of a look in bins of paths: that of first strips, and of all that follow from them.
struct StripBins {
  PathBins first, higher;

  PathBins& of(std::size_t wave) { return wave == 0 ? first : higher; }
  std::span<const double> nodes() const { return first.nodes(); }
};

/// A strip radiates two waves, of the paths over its start and over its end; as one where these are near enough.
enum class StripPart { whole, start, end };

/// Neighbouring strips of a wave in one bin: rows [first, end).
struct StripGroup {
  StripPart part;
  std::size_t bin;
  std::size_t first, end;
};

/// Keeps its buffers from one tree to the next.
class StripGroups {
 public:
  /// Of the first `waves` waves of a tree.
  void find(const StripLayout& strips, std::size_t waves, StripBins& bins);

  std::span<const StripGroup> of(std::size_t wave) const {
    return std::span(groups_).subspan(first_[wave], first_[wave + 1] - first_[wave]);
  }
  std::span<const StripRow> rows(const StripGroup& group) const {
    return std::span(rows_).subspan(group.first, group.end - group.first);
  }
  /// Whether the kernels of some strips are needed in parts.
  bool splits(std::size_t wave) const;

 private:
  void cut(const StripLayout& strips, std::size_t wave, std::uint32_t bundle, PathBins& bins);
  void put(StripPart part, const Linear& path, std::span<const PanelPoint> points, const StripRow& row, PathBins& bins);
  void append(StripPart part, std::size_t bin, const StripRow& row);

  std::vector<StripRow> rows_;
  std::vector<StripGroup> groups_;
  std::vector<std::size_t> first_;  // group of each wave, and their number
};

}  // namespace raytube
