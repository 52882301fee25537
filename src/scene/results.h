// What comes out of a solve: amplitudes by mechanism, counts, and what was left out. Plain data only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/field.h"
#include "scene/contribution.h"

namespace raytube {

/// Something the solver did not do, how often, and why.
struct Skipped {
  std::string what;         // in words
  std::string why;          // the reason, and a remedy where there is one; "{:.2g}" in it stands for `figure`
  std::uint64_t count = 0;  // how often
  double figure = 0.0;      // the largest, where there are several
  /// All members, as bytes are made of them (core/bytes.h).
  static void members(auto& s, auto&& take) { take(s.what), take(s.why), take(s.count), take(s.figure); }
};

/// `what` of the times of a scene that moves between those that were traced; `figure` is the share of S that it is off by there.
inline constexpr const char* times_between = "times";

/// Why it was skipped, with the figure.
std::string reason_of(const Skipped& skipped);

/// Rows in which a mechanism exceeds what the size of the target allows it (solve/physical_bound.h): they are wrong.
struct BeyondBound {
  std::string part;         // the mechanism
  std::uint64_t rows = 0;   // so many
  std::uint64_t worst = 0;  // the one that exceeds it most
  double ratio = 0.0;       // of the amplitude there to its bound
  /// All members, as bytes are made of them.
  static void members(auto& b, auto&& take) { take(b.part), take(b.rows), take(b.worst), take(b.ratio); }
};

/// A ray that met a closed body from inside, or left a surface without a direction.
struct LostRay {
  dvec3 at{0.0};               // where [m]
  std::uint32_t triangle = 0;  // of the mesh as it is traced
  std::uint64_t look = 0;      // counted from 0
  Direction transmit{};        // of that look
};

/// Lost rays that are told by their place: the first ones of the first looks, so that threads do not choose.
inline constexpr std::size_t most_lost_rays_told = 3;

/// Why a tube was truncated.
enum class Truncation : std::uint8_t {
  bounces,  // it would have met a surface after the last bounce
  width,    // a curved surface made it wider than what holds about its middle
  number    // there were too many at once, and it was among the weakest
};
/// All reasons, in order.
inline constexpr std::array truncations{Truncation::bounces, Truncation::width, Truncation::number};

/// Tubes that were truncated for one reason.
struct TruncatedSum {
  std::uint64_t tubes = 0;  // how many
  double sigma =
      0.0;  // [m^2] area times squared amplitude of unit incident waves: what is left of them, into all directions alike

  /// A tube of this area across its wave [m^2] and this amplitude.
  void add(double area, double amplitude) { sigma += area * amplitude * amplitude; }
};

/// Truncated tubes by reason.
struct TruncatedSums {
  std::array<TruncatedSum, truncations.size()> of{};  // [Truncation]

  /// Those of one reason.
  TruncatedSum& operator[](Truncation reason) { return of[static_cast<std::size_t>(reason)]; }
  /// Those of one reason.
  const TruncatedSum& operator[](Truncation reason) const { return of[static_cast<std::size_t>(reason)]; }
  /// Of all reasons together.
  std::uint64_t tubes() const { return of[0].tubes + of[1].tubes + of[2].tubes; }
  /// Of all reasons together [m^2].
  double sigma() const { return of[0].sigma + of[1].sigma + of[2].sigma; }

  /// Other tubes of the same look.
  TruncatedSums& operator+=(const TruncatedSums& other) {
    for (const Truncation reason : truncations)
      (*this)[reason].tubes += other[reason].tubes, (*this)[reason].sigma += other[reason].sigma;
    return *this;
  }
};

/// Takes in the tubes of another look: counts are added up, of sigma the largest stays.
inline void add_look(TruncatedSums& all, const TruncatedSums& look) {
  for (const Truncation reason : truncations) {
    all[reason].tubes += look[reason].tubes;
    all[reason].sigma = std::max(all[reason].sigma, look[reason].sigma);
  }
}

/// What became of a mechanism in a solve.
struct MechanismUse {
  std::string name;                            // of its pieces
  std::string label;                           // in words
  std::string key;                             // of the case, by which it is asked for
  bool on = false;                             // it took part, in looks in which it could change the answer
  std::string why_not;                         // if it did not
  std::uint64_t looks = 0, looks_without = 0;  // computed looks with it, and without
  double most_db = 0.0;                        // by which it was expected to move a row without it at most [dB]
  /// All members, as bytes are made of them.
  static void members(auto& m, auto&& take) {
    take(m.name), take(m.label), take(m.key), take(m.on), take(m.why_not), take(m.looks), take(m.looks_without), take(m.most_db);
  }
};

/// What happened during a solve; every ray is accounted for.
struct Statistics {
  std::uint64_t tubes = 0;                 // launched
  std::uint64_t rays = 0;                  // segments traced: launched tubes and every reflected segment
  std::vector<std::uint64_t> hits;         // hits[m]: tubes that met a surface at bounce m + 1
  std::uint64_t lost_rays = 0;             // rays that met a closed body from inside (a leak), or left a surface without a
                                           // direction; their tube ends there
  std::uint64_t looks_with_lost_rays = 0;  // looks with at least one
  std::vector<LostRay> first_lost_rays;    // most_lost_rays_told at most, in metres of the mesh's own coordinates
  TruncatedSums truncated;                 // tubes: sum over looks; sigma: the largest one of a look
  double sliver_area = 0.0;  // [m^2], sum over looks: parts of adaptive tubes too thin to be more than rounding, left out
  std::uint64_t wedges = 0;  // wedges of the target, convex and concave
  std::uint64_t thin_plate_edges_lowest = 0, thin_plate_edges_highest = 0;  // half planes at the lowest and the highest frequency
  std::vector<Count> counts;                                                // of the mechanisms, sums over looks
  bool paths = false;                                                       // edges.method utd: tubes are paths of rays
  double ray_range = 0.0;                 // [m]: of these without [radar], amplitudes are apparent ones at this range; else 0
  std::vector<Skipped> skipped;           // what was left out, and why
  std::vector<MechanismUse> mechanisms;   // beside the tubes, in the order in which they run
  std::vector<BeyondBound> beyond_bound;  // none in a sound solve
  double solve_s = 0.0;                   // mesh and BVH ready -> last sum
  /// All members, as bytes are made of them.
  static void members(auto& s, auto&& take) {
    take(s.tubes), take(s.rays), take(s.hits), take(s.lost_rays), take(s.looks_with_lost_rays), take(s.first_lost_rays);
    take(s.truncated), take(s.sliver_area), take(s.wedges), take(s.thin_plate_edges_lowest), take(s.thin_plate_edges_highest);
    take(s.counts), take(s.paths), take(s.ray_range), take(s.skipped), take(s.mechanisms), take(s.beyond_bound), take(s.solve_s);
  }

  /// A count of a mechanism by its name in run.json; 0 if there is none.
  std::uint64_t counted(std::string_view what) const { return count_named(counts, what); }
};

/// One of the things that the asymptotic physics leaves out, over the rows of a sweep. An estimate, as of SweepResult::model.
struct ModelPart {
  std::string name;                   // one word
  std::string what;                   // it is
  std::string remedy;                 // the handle that makes it less
  double rms = 0.0;                   // over rows, of the two co-polar channels together [m]
  double share = 0.0;                 // of the sum of the squares of all parts, 0 ... 1
  std::uint64_t rows_largest = 0;     // rows in which no other part is larger
  std::vector<ChannelErrors> rows{};  // [row] [m]; empty unless parts are kept
  /// All members, as bytes are made of them.
  static void members(auto& p, auto&& take) {
    take(p.name), take(p.what), take(p.remedy), take(p.rms), take(p.share), take(p.rows_largest), take(p.rows);
  }
};

/// What adds to S in one column of parts.csv.
struct MechanismRows {
  std::string name;                    // of the column
  std::vector<ScatteringMatrix> rows;  // [row] [m]
  /// All members, as bytes are made of them.
  static void members(auto& m, auto&& take) { take(m.name), take(m.rows); }
};

/// Complex amplitudes of a sweep, one entry per row (Sweep::row), kept apart by mechanism. At a finite distance they are apparent
/// ones: what would make the same signal if it lay at the origin of the mesh's own coordinates (Antenna).
struct SweepResult {
  std::vector<ScatteringMatrix> total;  // sum of all mechanisms
  /// Estimated numerical error of |S_pq| by tubes and by edge-diffracted waves on faces [m]; not by the edges' own currents.
  std::vector<ChannelErrors> error;
  /// Model uncertainty: what the asymptotic physics may leave out in |S_pq| [m], root of the sum of the squares of its parts.
  std::vector<ChannelErrors> model;
  std::vector<ModelPart> model_parts;  // those that are not zero in every row, the largest share first

  // The mechanisms; empty unless parts are kept.
  std::vector<std::vector<ScatteringMatrix>> bounces;  // bounces[m][row]: PO currents of bounce m + 1
  std::vector<MechanismRows> mechanisms;               // what adds to them

  /// [row] of a column of `mechanisms` by its name; empty if it is not kept.
  const std::vector<ScatteringMatrix>& of(std::string_view column) const {
    static const std::vector<ScatteringMatrix> none;
    const auto found = std::ranges::find(mechanisms, column, &MechanismRows::name);
    return found == mechanisms.end() ? none : found->rows;
  }

  std::vector<std::array<double, 2>> incoherent;  // sigma of rough surfaces for transmitted V and H [m^2]; empty: there are none
  Statistics statistics;                          // counts and times
  /// All members, as bytes are made of them.
  static void members(auto& r, auto&& take) {
    take(r.total), take(r.error), take(r.model), take(r.model_parts), take(r.bounces), take(r.mechanisms), take(r.incoherent);
    take(r.statistics);
  }
};

}  // namespace raytube
