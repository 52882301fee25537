// Curved surfaces and sheets: over parts of facets, which sheets divide.
#pragma once

#include <vector>

#include "sbr/beams/beam_tree.h"
#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"
#include "sbr/curved/curved_piece.h"
#include "sbr/visible/beam_visibility.h"
#include "sbr/visible/line_of_sight.h"

namespace raytube {

/// What of their far field quadrature over curved surfaces may miss, and the shadow boundary of a tessellation: some times what
/// spheres show.
inline constexpr double curved_integration_error = 2e-3;

/// The surface that a facet of a look stands for, about where the ray from these launch coordinates meets it.
CurvedPiece piece_over(const TubeLook& look, const dvec2& at, std::uint32_t triangle);

/// Whether a receiver sees anything through sheets that the transmitter sees without them: not where both are at one place.
bool looks_from_elsewhere(const TubeLook& look);

/// Sheets before the antennas at a point, by their patches, in the order in which waves pass them.
struct SheetsBefore {
  std::vector<std::uint32_t> transmitter, receiver;
};

/// What the transmitter's wave excites on curved surfaces that it comes to through sheets, or that the receiver sees through
/// sheets. Sheets passed on the way from the transmitter are bounces. For one thread.
class CurvedThroughSheets {
 public:
  /// Keeps references to both. The look has sheets.
  CurvedThroughSheets(const TubeLook& look, BeamVisibility& visible);

  bool is_sheet(std::uint32_t triangle) const { return beams_.is_sheet(look_.faces.mesh().triangle_patch[triangle]); }

  /// Adds what the receiver has through sheets, less what it would have without, of the first bounce on a part of a face.
  void screen(TubeSums& to, const VisiblePart& part) { screen(to, BeamTree::root, part, 0); }

  /// Adds the currents on all curved surfaces that the incident wave comes to through this part of a sheet.
  void go_through(TubeSums& to, const VisiblePart& sheet) { go_through(to, BeamTree::root, sheet, 0); }

  /// At the point of a facet that the incident wave has at these launch coordinates and depth.
  SheetsBefore sheets_before(const dvec2& at, double depth, std::uint32_t triangle) const;

  /// S of a piece all of which has these sheets before it.
  std::vector<ScatteringMatrix> far_field(const SheetsBefore& sheets, const CurvedPiece& piece, const Bounds& box,
                                          TubeSums& incoherent) const;

 private:
  // Currents of a beam as a node of them is received.
  struct Source {
    std::uint32_t beam, node;
  };
  std::uint32_t patch(const VisiblePart& part) const { return look_.faces.faces()[part.face].patch; }
  void go_through(TubeSums& to, std::uint32_t beam, const VisiblePart& sheet, int bounce);
  void meet(TubeSums& to, std::uint32_t beam, const VisiblePart& part, int bounce);
  void screen(TubeSums& to, std::uint32_t beam, const VisiblePart& part, int bounce);
  void add(TubeSums& to, const Source& source, const VisiblePart& part, int bounce);
  void add_near(TubeSums& to, const Source& source, const VisiblePart& part, int bounce) const;
  void add_far(TubeSums& to, const Source& source, const VisiblePart& part, int bounce);
  std::vector<ScatteringMatrix> far_field(const Source& source, const CurvedPiece& piece, const ConvexPolygon& outline,
                                          TubeSums* incoherent) const;

  const TubeLook& look_;
  BeamVisibility& visible_;
  BeamTree beams_;  // the incident wave, and as it goes on behind sheets
  PolygonLineOfSight line_of_sight_;
};

}  // namespace raytube
