// Waves along the edges of plane sheets, from corner to corner.
//
// A wave that meets the corner of a sheet sends a wave along either edge there; at the next corner this one leaves for the radar,
// and the other way round. Strips (utd/multiple) do not have it: their currents start on edges, not at corners.
//   radial_wave      fields on the unit sphere, of which those of a corner are made
//   sheet_corner     one corner, exactly
//   corner_waves     which edges run between two corners, and what their waves add to S
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "utd/corner/sheet_corner.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

/// The edges of half planes that end, at both ends, at a corner of two such edges of one sheet and nothing else; an edge may bend
/// by 15 degrees on its way, of one wedge or several. A corner is solved when a look first asks for it; angles are
/// rounded to 0.1 degrees. Of more than `most_angles` only those of the longest edges have waves. Thread-safe.
class CornerWaves {
 public:
  /// Edges that radiate; they must not be needed after that.
  explicit CornerWaves(std::span<const Wedge> wedges);

  /// Whether edge `wedge` has any.
  bool run_along(std::uint32_t wedge) const { return wedge < edges_.size() && edges_[wedge].has_value(); }

  /// The waves of transmitter and receiver at a corner.
  struct Visit {
    LookVectors look;
    double in, out;  // their phases there over k [m]
  };
  /// Where edge `wedge` has its corners.
  std::array<dvec3, 2> corners_of(std::uint32_t wedge) const;
  /// The place that both ways along it have for a radar in this direction (scene/scattering_piece.h).
  dvec3 place(std::uint32_t wedge, const dvec3& towards) const;

  /// sum[f] += `share` times S [m] of the waves along `wedge`, both ways, at each frequency [Hz]; `visits` of corners_of().
  void add(std::uint32_t wedge, double share, const std::array<Visit, 2>& visits, std::span<const double> frequencies,
           std::span<ScatteringMatrix> sum) const;
  /// The same with antennas at infinity.
  void add(std::uint32_t wedge, double share, const LookVectors& look, std::span<const double> frequencies,
           std::span<ScatteringMatrix> sum) const;

  /// Of its corners, once they are solved.
  std::size_t bytes() const { return angles_.size() * SheetCorner::bytes(); }

  static constexpr std::size_t most_angles = 16;

 private:
  /// All corners of one angle.
  class Angle {
   public:
    explicit Angle(double angle) : angle_(angle) {}
    double value() const { return angle_; }
    const SheetCorner& corner() const;

   private:
    double angle_;
    mutable std::once_flag once_;
    mutable std::optional<SheetCorner> corner_;
  };
  /// Of one edge, with the frame of SheetCorner. Its height above the sheet is of the same rounding at both ends.
  struct End {
    dvec3 position, bisector, along;
    dvec3 normal;  // one for both ends; that of the frame has the sign `side`
    double side;
    dvec3 edge, other_edge;  // away from the corner
    double other_length;     // until it bends by 15 degrees
    const Angle* angle = nullptr;
  };
  struct Edge {
    std::array<End, 2> ends;
    double length;
    double part;  // the wedge's of that; less if it stands for several
  };
  class Finder;

  /// One end's part of a wave for both polarisations, without what depends on the wavelength.
  struct Passage {
    std::array<Complex, 2> flat, upright;
  };
  static Passage passage(const End& end, const dvec3& towards, const std::array<dvec3, 2>& fields);
  static Complex upright_factor(const End& end, const dvec3& towards, double electrical_length);
  static double weight(const End& end, const dvec3& towards, double wavenumber, double length);
  static void add_way(const Edge& edge, int from, double share, const std::array<Visit, 2>& visits,
                      std::span<const double> frequencies, std::span<ScatteringMatrix> sum);
  const Angle* angle_of(double angle);

  std::vector<std::unique_ptr<Angle>> angles_;
  std::vector<std::optional<Edge>> edges_;  // [wedge]
};

}  // namespace raytube
