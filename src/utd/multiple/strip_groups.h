// Strips whose waves are added up in one bin of paths. Notation in multiple_diffraction.h.
#pragma once

#include "math/path_bins.h"
#include "scene/image.h"
#include "utd/multiple/strip_layout.h"
#include "utd/wedge/path_place.h"

namespace raytube {

/// What the strips of a look add to S, point by point of the first edges, each wave at the place of its path. Looks are back to
/// where light comes from, perhaps over mirrors, and of one frequency.
struct StripPieces {
  PathPlace place;
  std::vector<dvec3> places{};      // where single bins are, one after the other [m]
  std::vector<ImageEdge> curved{};  // pieces of strips over curved faces
};

/// By how much the paths of waves may differ that are one piece [m].
inline double one_piece(double wavenumber) { return 0.125 * 2.0 * pi / wavenumber; }

/// S of a look in bins of paths: that of first strips, and of all that follow from them. With pieces in bins of places, together.
struct StripBins {
  PathBins first, higher;
  StripPieces* pieces = nullptr;

  PathBins& of(std::size_t wave) { return wave == 0 || pieces ? first : higher; }
  std::size_t at(const dvec3& place) {
    pieces->places.push_back(place);
    return first.append();
  }
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
  /// The groups of the first `waves` waves of a tree.
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
  void take_apart(const StripLayout& strips, std::size_t wave, std::uint32_t bundle, StripBins& bins);
  /// Where light meets the first edge and a strip starts or ends, its phase over k there, and the bin of what radiates from it.
  struct StripEnd {
    dvec3 first, last;
    double path;
    std::size_t& bin;
  };
  void put_apart(const StripRow& one, const StripEnd& start, const StripEnd& end, StripBins& bins);
  void put(StripPart part, const Linear& path, std::span<const PanelPoint> points, const StripRow& row, PathBins& bins);
  void append(StripPart part, std::size_t bin, const StripRow& row);

  std::vector<StripRow> rows_;
  std::vector<StripGroup> groups_;
  std::vector<std::size_t> first_;  // group of each wave, and their number
  // What has pieces: the bins of the starts of first strips, by point, and of the ends of all, where others start.
  std::vector<std::size_t> starts_, ends_;
};

}  // namespace raytube
