// The waves that one wave on a lit edge starts: over its face to the far edges, from there over the next faces, and so on.
// Notation in multiple_diffraction.h; points on the first edge are named by their arc length from its start.
#pragma once

#include <span>
#include <vector>

#include "utd/multiple/strip_waves.h"
#include "utd/shadow/edge_visibility.h"
#include "utd/surface/curved_faces.h"

namespace raytube {

/// Where strips start, as a function of the arc length on the first edge [m].
struct EdgeLine {
  dvec3 origin, step;  // recentred coordinates [m]; change per metre
  dvec3 at(double arc_length) const { return origin + arc_length * step; }
};

/// What is linear in the arc length on the first edge.
struct Linear {
  double value = 0.0, growth = 0.0;
  double at(double arc_length) const { return value + arc_length * growth; }
};

/// Neighbouring strips of one wave that end at the same edge. Their length is linear in the arc length on the first edge.
struct StripBundle {
  double from, to;                    // on the first edge [m]
  const OutlineEdge* edge = nullptr;  // where they end; null if they are semi-infinite
  double length = 0.0, growth = 0.0;  // the strip from arc length z is length + growth z long [m]
  Linear start_path, end_path;        // phase at their starts and at their ends, over k [m]
  std::size_t first_beyond = 0;       // the first of the two waves that start where they end; 0: there are none

  double length_at(double arc_length) const { return length + growth * arc_length; }
};

/// One wave of the tree.
struct TreeWave {
  StripWave wave;
  EdgeLine line;                                   // where its strips start
  Linear path;                                     // its phase there, over k [m]
  std::uint32_t parent = no_index;                 // the bundle whose strips end there; none for the first wave
  std::uint32_t first_bundle = 0, end_bundle = 0;  // its own

  // For mirrored strips: how far their current has come, and how much the path over the image of its source, from which they run
  // straight, exceeds that over the source itself [m].
  Linear behind{}, detour{};
  bool direct = false;  // the current is that of the first wave
};

/// Finds all waves and bundles, each wave after the one it comes from. Keeps its buffers from one tree to the next.
class WaveTree {
 public:
  /// For a look with the directions s' and s.
  WaveTree(std::span<const Wedge> wedges, const Outlines& outlines, const CurvedFaces* curved, const dvec3& incident,
           const dvec3& scattered, bool continue_by_images)
      : wedges_(wedges),
        outlines_(outlines),
        curved_(curved),
        incident_(incident),
        scattered_(scattered),
        continue_by_images_(continue_by_images) {}

  /// The tree of `wave`, started on the lit pieces of its edge.
  void grow(const StripWave& wave, std::span<const LitInterval> lit);

  std::span<const TreeWave> waves() const { return waves_; }
  std::span<const StripBundle> bundles() const { return bundles_; }

  /// Points of the first edge that are nearer to one another than this are one [m].
  double rounding() const { return rounding_; }

  /// Whether one of the waves that go on to further edges runs exactly along an edge of its face.
  bool runs_along_edge() const { return runs_along_edge_; }

  /// Whether a wave is the diffracted one of a half plane, the same over both of its sides but for the sign.
  bool starts_at_half_plane(const TreeWave& wave) const;

  /// Whether a wave of it runs over a curved face: then it has a single bundle there, and what follows is not in the tree
  /// (curved_strips.h).
  bool runs_over_curved(const StripWave& wave) const { return curved_ != nullptr && curved_->curved(wave.wedge, wave.face); }

  /// Counted, of growing this tree (utd/wedge/work.h).
  double work() const { return work_; }

 private:
  void split(const TreeWave& wave, double from, double to);
  void end_bundle(const TreeWave& wave, double from, double to, const OutlineEdge* edge);
  void continue_beyond(std::size_t index);
  void mirror(std::size_t index, std::uint32_t bundle);
  const StripBundle* same_on_other_side(std::size_t index, const StripBundle& bundle) const;
  void project_corners(const TreeWave& wave, double from, double to);
  bool meets_edge_alongside(const StripWave& wave) const;

  std::span<const Wedge> wedges_;
  const Outlines& outlines_;
  const CurvedFaces* curved_;
  dvec3 incident_, scattered_;
  bool continue_by_images_;
  double rounding_ = 0.0;
  std::vector<TreeWave> waves_;
  std::vector<StripBundle> bundles_;
  std::vector<double> cuts_;
  bool runs_along_edge_ = false;
  double work_ = 0.0;
};

}  // namespace raytube
