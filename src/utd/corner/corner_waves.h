// Waves along the edges of plane sheets, of thin bodies and of solids, from corner to corner.
//
// A wave that meets a corner sends a wave along every edge there; at the next corner this one leaves for the radar,
// and the other way round. Strips (utd/multiple) do not have it: their currents start on edges, not at corners.
//   radial_wave      fields on the unit sphere, of which those of a corner are made
//   order_nodes      the orders over which these are summed
//   radial_basis     those sums, of few functions
//   sheet_corner     one corner of a sheet, exactly
//   solid_corner     one corner of three faces of a solid, exactly
//   wedge_ends       which wedges meet where
//   solid_edges      which edges of solids run between two of those
//   thin_ends        ends of bodies that are thin to such a wave
//   corner_waves     which edges run between two corners, and what their waves add to S
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "scene/options.h"
#include "utd/corner/sheet_corner.h"
#include "utd/corner/solid_edges.h"
#include "utd/corner/thin_ends.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

/// What edges run between two corners.
enum class CornerWaveKind { plate, thin_end, solid };

/// The edges of half planes that end, at both ends, at a corner of two such edges of one sheet and nothing else; an edge may bend
/// by 15 degrees on its way, of one wedge or several. Ends of thin bodies and the sharp edges between them are such edges, too,
/// of the sheets in the middle of these; those of solids are the ones of SolidEdges. A corner is solved when a look first asks
/// for it; angles are rounded to 0.1 degrees. Of more than `most_angles` only those of the longest edges have waves. Thread-safe.
class CornerWaves {
 public:
  /// Edges that radiate; they must not be needed after that.
  explicit CornerWaves(std::span<const Wedge> wedges, const CornerWaveOptions& kinds = {});

  /// Of which kind edge `wedge` is; none if it has no such waves.
  std::optional<CornerWaveKind> kind(std::uint32_t wedge) const { return kinds_[wedge]; }
  /// How many wedges are of this kind.
  std::size_t count(CornerWaveKind kind) const;

  /// The waves of transmitter and receiver at a corner.
  struct Visit {
    LookVectors look;
    double in, out;  // their phases there over k [m]
  };
  /// The first wedge of the edge that `wedge` is a part of, if it is one of a thin body; else `wedge` itself.
  std::uint32_t first_of(std::uint32_t wedge) const { return edges_[wedge] ? edges_[wedge]->first : wedge; }
  /// Null unless it is one of a solid.
  const SolidEdge* solid(std::uint32_t wedge) const { return edges_[wedge] ? nullptr : solids_[wedge]; }
  /// How much of the edge the wedge is to a wave that comes in this direction: of a thin end the line on its near side counts.
  double part(std::uint32_t wedge, const dvec3& incident) const;

  /// Where edge `wedge` has its corners.
  std::array<dvec3, 2> corners_of(std::uint32_t wedge) const;
  /// The place that both ways along it have for a radar in this direction (scene/scattering_piece.h).
  dvec3 place(std::uint32_t wedge, const dvec3& towards) const;

  /// sum[f] += `share` times S [m] of the waves along the edge of `wedge`, both ways, at each frequency [Hz]; `visits` of
  /// corners_of().
  void add(std::uint32_t wedge, double share, const std::array<Visit, 2>& visits, std::span<const double> frequencies,
           std::span<ScatteringMatrix> sum) const;

  /// Of the corners of this kind, once they are solved.
  std::size_t bytes(CornerWaveKind kind) const;

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
  struct Passage;
  /// Of one edge, with the frame of SheetCorner. Its height above the sheet is of the same rounding at both ends.
  struct End {
    dvec3 position, bisector, along;
    dvec3 normal;  // one for both ends; that of the frame has the sign `side`
    double side;
    dvec3 edge, other_edge;  // away from the corner
    double other_length;     // until it bends by 15 degrees
    const Angle* angle = nullptr;

    Passage passage(const dvec3& towards, const std::array<dvec3, 2>& fields) const;
    double weight(const dvec3& towards, double wavenumber, double length) const;
  };
  /// One end's part of a wave for both polarisations.
  struct Passage {
    const End& end;
    dvec3 towards;
    std::array<Complex, 2> flat{}, upright{};

    std::array<Complex, 2> at(double electrical_length) const;
  };
  struct Edge {
    std::array<End, 2> ends;
    double length;
    double part;  // the wedge's of that; less if it stands for several
    CornerWaveKind kind = CornerWaveKind::plate;
    std::uint32_t first = no_index;
    // Of a thin end: mean thickness [m], the face's normal, and where the wedge lies, seen from the face's middle.
    double thickness = 0.0;
    dvec3 outwards{0.0}, towards{0.0};
    static constexpr double n = 2.0;  // exterior angle / pi

    /// How much of a wave runs along it, by its length and thickness.
    double length_weight(double wavenumber) const;
  };
  class Finder;

  static Complex upright_factor(const End& end, const dvec3& towards, double electrical_length);
  static std::optional<End> corner_at(const ThinEnd& thin, int tip, bool along_sharp);
  static std::optional<std::array<End, 2>> both(std::optional<End> first, std::optional<End> last);
  void find_thin(std::span<const Wedge> wedges);
  void put_end(std::span<const Wedge> wedges, const ThinEnd& thin);
  void put_sharp_edge(std::span<const Wedge> wedges, const ThinEnd& thin, int tip, std::span<const ThinEnd> all);
  template <class AnyEdge>
  static void add_both_ways(const AnyEdge& edge, double share, const std::array<Visit, 2>& visits,
                            std::span<const double> frequencies, std::span<ScatteringMatrix> sum);
  const Angle* angle_of(double angle);

  std::vector<std::unique_ptr<Angle>> angles_;
  std::vector<std::unique_ptr<Edge>> edges_;  // [wedge]
  SolidEdges solids_;
  std::vector<std::optional<CornerWaveKind>> kinds_;  // [wedge]
};

}  // namespace raytube
