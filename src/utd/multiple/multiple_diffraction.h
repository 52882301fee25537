// Multiple diffraction: edge currents that end where their face ends, and the waves that the edge there starts.
//
// Notation in the files of this folder, which are written like the formulas of docs/theory/edges.md:
//   s', s           directions of incidence and of scattering, unit; k the wavenumber
//   x_f, n_f, t     of one face of an edge: into the face, out of the metal, and x_f x n_f along the edge
//   beta'           angle between t and s'; phi' the angle from the face through free space towards the source, in [0, n pi]
//   sigma           sin(beta') x_f + cos(beta') t, the grazing diffracted ray: along it the current of an edge point runs over
//                   its face, in phase with the diffracted wave. What lies on one such ray is a strip (Michaeli 1986)
//   mu, g, h        the observer against sigma: mu = 1 - |s - sigma|^2 / (2 sin^2 beta') = -cos g, h = cos(g/2)
//   X               k l sin^2(beta'), electrical length of a strip that is l long
//   G_s, G_h, G_x   kernels, integrals of the fringe current (exact less physical optics) over the strip: of the soft one for
//                   unit E along the edge, of the hard one for unit eta H along it, and of the part of that along the edge
// A strip ends at the next edge, arrives there as a wave that grazes its face, and starts strips on both faces of that edge. So
// one lit edge starts a tree of waves; neighbouring strips of a wave that end at the same edge are a bundle.
//
//   strip_waves           one wave: where its strips end, which waves follow
//   wave_tree             all waves and bundles that one wave on a lit edge starts
//   edge_panels           the points on that edge at which strips are taken
//   strip_groups          which strips are added up together, where many frequencies are found from a few (math/path_bins), or
//                         none of them, where each is to have its place
//   strip_layout          what no frequency changes: faces, and where the numbers of each bundle are kept
//   curved_strips         strips over curved faces, point by point: strip_walk along a geodesic, what they add in
//                         curved_strip_radiation
//   strip_rays            such strips as polylines, for pictures
//   strip_kernels         one strip in closed form; thin_plate_edge what the thickness of a plate changes
//   strip_wave_kernels    all kernels of a wave at some wavenumbers
//   strip_radiation       S of the tree from these, and the amplitudes handed on from edge to edge
#pragma once

#include "scene/surface_rays.h"
#include "utd/multiple/strip_radiation.h"
#include "utd/surface/surface_arrival.h"

namespace raytube {

/// What the strips of all edges radiate in one look, per frequency: S [m], phase reference the origin of the wedges' coordinates.
struct StripSums {
  std::vector<ScatteringMatrix> first;   // strips of the edges that the incident wave lights
  std::vector<ScatteringMatrix> higher;  // all that follow from them
  std::vector<bool> windowed;            // the forward-grazing window of semi-infinite strips touched the sum
  double work = 0.0;                     // counted (utd/wedge/work.h)
};

/// Adds edge after edge of one look. Where a face ends at a convex wedge the fringe current grazes that edge and diffracts there
/// into both of its faces; `order` counts the strips one after another, 1 or more. A strip that ends at a concave wedge ends
/// there or, with `continue_by_images`, runs on mirrored if the angle is a right one; one that reaches a smooth crease is taken
/// as semi-infinite. Keeps its buffers between edges. `wedges`, `outlines` and `look` must outlive it; `frequencies` [Hz], at
/// least one.
class MultipleDiffraction {
 public:
  MultipleDiffraction(std::span<const Wedge> wedges, const Outlines& outlines, const CurvedFaces* curved, const LookVectors& look,
                      std::span<const double> frequencies, int order, bool continue_by_images = false);

  /// The strips of both faces of wedge `index`, which start on its lit pieces.
  void add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit);

  /// What a wave over a curved surface starts at the wedge it has reached; its frequencies are those of the look.
  void arrive(const SurfaceArrival& arrival, std::span<const std::size_t> frequencies);

  /// Has all strips over curved faces that are added from now on put there, as at the first frequency; null: nowhere.
  void keep_rays(std::vector<SurfaceRay>* rays) { rays_ = rays; }

  /// Has all that is added from now on taken apart; with the directions of a monostatic look, and one frequency.
  void keep_pieces(StripPieces* pieces) { bins_.pieces = pieces; }
  /// What was, each piece at its place.
  std::vector<ImageEdge> take_pieces();

  /// Nothing may be added after that.
  StripSums take();

 private:
  void start(const StripWave& wave, std::span<const LitInterval> lit);
  void count(const StripPath& path, int order);
  void lay_out_tree(const StripWave& wave, std::span<const LitInterval> lit);
  void start_beside(const StripWave& wave, std::span<const LitInterval> lit);
  void add_tree(const TreeShare& share);

  StripScene scene_;
  int order_;
  Band band_;
  StripBins bins_;
  PathBins answer_;  // to a unit wave that arrives at an edge
  std::vector<ScatteringMatrix> answers_;
  StripLayout strips_;  // those of the present tree
  CurvedWaves curved_;  // those of the present tree
  StripRadiation radiation_;
  StripSums sums_;
  std::vector<SurfaceRay>* rays_ = nullptr;
};

}  // namespace raytube
