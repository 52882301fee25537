// How a solve is done: tubes, edges, threads. Plain data with the defaults of the library, which are those of the program.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "core/field.h"
#include "core/work_team.h"

namespace raytube {

/// How tubes are laid over the target.
enum class TubeMode {
  uniform,  // one tube a cell of the launch grid
  adaptive  // tubes as wide as the surfaces they meet allow
};

/// Where facets that stand for a curved surface are taken as that surface.
enum class CurvedSurfaces {
  never,   // facets are flat
  convex,  // on convex bodies: what a curved surface reflects has to be sampled, what facets reflect has not
  always   // on every target
};

/// Cells are counted per wavelength along each side of the launch plane, at the highest frequency.
struct TubeOptions {
  TubeMode mode = TubeMode::adaptive;  // how tubes are laid
  double per_wavelength = 10.0;        // density of the grid; where it is refined, of the first one
  double max_per_wavelength = 40.0;    // cap of the density where it is refined (refines())
  double tolerance_db = 0.1;           // refined until the estimated error of every channel is below this: scene/tolerance.h
  double model_share = 0.25;           // or below this share of the model uncertainty: digits that the physics lacks are dear
  CurvedSurfaces curved = CurvedSurfaces::convex;  // of adaptive tubes
  int max_bounces = 8;                             // surfaces that a tube meets at most
  bool skip = true;                                // false: also what adds nothing, or is known from another look, is computed
  std::optional<dvec3> up;                         // rows of the launch grid follow this vector's projection; default -theta_hat

  /// Whether grids are refined to a tolerance: those of tubes that are cut exactly at edges.
  bool refines() const { return mode == TubeMode::adaptive; }
};

/// What edges add.
enum class EdgeMethod {
  none,    // nothing: physical optics alone
  fringe,  // the currents that physical optics lacks
  utd  // no currents at all, but rays of geometrical optics and rays that one edge diffracts (gtd/ray_fields.h), a mode to
       // compare with programs that trace paths
};

/// An EdgeOptions::interaction_budget from which on there is no limit, and nothing is left out.
inline constexpr double unlimited_interaction_budget = 1e6;

/// What edges add beside other materials than perfect conductors.
enum class MaterialEdgeMethod {
  none,   // nothing
  fringe  // the currents that physical optics lacks (utd/fringe/material_edges.h)
};

/// Whether a mechanism takes part: always, never, or where it can change the answer.
class Use {
 public:
  /// Where it can change the answer.
  constexpr Use() = default;
  /// Always, or never.
  constexpr Use(bool on) : kind_(on ? Kind::always : Kind::never) {}

  /// Not ruled out.
  constexpr bool possible() const { return kind_ != Kind::never; }
  /// Asked for in any case.
  constexpr bool forced() const { return kind_ == Kind::always; }

 private:
  enum class Kind { never, where_it_counts, always };
  Kind kind_ = Kind::where_it_counts;
};

/// Which waves run from corner to corner along an edge, from edge order 2 on.
struct CornerWaveOptions {
  bool plates = true;     // along edges of plane plates
  bool thin_ends = true;  // along the ends of thin bodies, and along the sharp edges between them
  bool solids = true;     // along edges of solids
};

/// What edges add, and how much work it may take.
struct EdgeOptions {
  EdgeMethod method = EdgeMethod::fringe;  // what edges add
  int order = 3;                           // edges in a row that a current passes, 1 to 3; 1 takes every face as semi-infinite
  Use interaction;                  // edges light other surfaces; by default where its budget reaches half of what is expected
  double interaction_budget = 4.0;  // work that this may take in a look, in units of all its other work; 0: none
  CornerWaveOptions corners{};      // what runs along edges
  bool receiver_shadow = false;     // an edge hidden from the receiver does not count
  MaterialEdgeMethod materials = MaterialEdgeMethod::fringe;  // what edges of other materials add
  double utd_range = 0.0;  // of transmitter and receiver with method utd [m]; 0: default_ray_range
};

/// What curved surfaces add beyond physical optics.
struct SurfaceOptions {
  Use waves;  // currents run smoothly into the dark over curved surfaces, and on in it; with edges.method fringe. By default in
              // looks to which they may add tolerance_db
  bool rounded_edges = true;  // where waves run, sharp bends between flatter flanks are edges of a rounded section
  bool flat_tips = true;      // where two rounded edges meet, waves along them go back as from the corner of a sheet
  bool round_tips = true;     // where waves run, tips of cones send them back
};

/// Which creases of a mesh are edges: what a Target is made with.
struct WedgeOptions {
  double min_wedge_angle = 15.0 * degree;  // a crease flatter than this is tessellation, not an edge [rad]
  bool thin_plates = true;                 // the narrow face of a plate thinner than wavelength / 10 is the edge of a half plane
};

/// Finished looks in the hands of whoever calls, as bytes whose meaning is the solver's own (of the same program, target, sweep
/// and options): a solve that was stopped goes on from them and gives the same bits as one that was not.
struct KeptLooks {
  std::function<void(std::size_t looks)> begin;                    // told first: how many are computed in all
  std::function<std::string(std::size_t index)> find;              // those kept for one of them; empty: it has to be computed
  std::function<void(std::size_t index, std::string bytes)> keep;  // of one just computed. Both from any thread
};

/// All that is not the target and not the sweep.
struct SolveOptions {
  TubeOptions tubes{};        // physical optics
  EdgeOptions edges{};        // diffraction at edges
  SurfaceOptions surfaces{};  // waves over curved surfaces
  int threads = 0;            // 0: all cores
  bool keep_parts = false;    // fill SweepResult::bounces and SweepResult::parts
  /// Called now and then with the finished share of the work (0..1), kept looks first; return false to stop (solve then throws
  /// Interrupted).
  std::function<bool(double)> progress{};
  KeptLooks kept{};          // empty: none are kept
  WorkTeam* team = nullptr;  // of the processes that solve the same; this one leads it. Null: alone
};

}  // namespace raytube
