// Edges beside other materials than perfect conductors.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "utd/fringe/edge_look_result.h"
#include "utd/fringe/edge_scene.h"
#include "utd/impedance/coated_rim.h"
#include "utd/impedance/impedance_strips.h"
#include "utd/sheet/sheet_edges.h"

namespace raytube {

/// Whether anything is known of the currents of a wedge that is not between perfect conductors: it is the rim of a sheet, or
/// nothing goes through either of its faces.
bool is_material_edge(const Wedge& wedge, std::span<const Material> materials);

/// What edges need of the materials of a target, at all frequencies of its sweep.
struct EdgeMaterials {
  std::span<const Material> materials;
  SheetTable sheets;
  ImpedanceTable impedances;

  EdgeMaterials(std::span<const Material> of, std::span<const double> frequencies)
      : materials(of), sheets(of, frequencies), impedances(of, frequencies) {}

  bool radiates(const Wedge& wedge) const { return !wedge.enclosed && is_material_edge(wedge, materials); }

  /// How a wave that comes along `incident` meets a wedge; none if the edge adds nothing. A sheet is lit from both sides.
  std::optional<WedgeIncidence> meeting(const Wedge& wedge, const dvec3& incident) const;
};

/// One look, edge after edge. Keeps references to its arguments.
class MaterialEdges {
 public:
  MaterialEdges(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies, int order);

  /// Rims of sheets at the order asked for, edges of opaque materials to the second.
  void add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit);

  /// Adds all of it; nothing may be added after that.
  void add_to(EdgeLookResult& result);

 private:
  void add_opaque(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit);
  RimFaces rim_faces(const Wedge& wedge, const std::array<SurfaceImpedance, 2>& sides, std::size_t frequency) const;

  const EdgeMaterials* known_;
  std::span<const Wedge> wedges_;
  const LookVectors& look_;
  std::span<const double> frequencies_;
  std::optional<SheetEdges> sheets_;       // if there are any of other materials
  std::optional<ImpedanceStrips> strips_;  // from order 2 on
  std::vector<ScatteringMatrix> first_, higher_;
  std::vector<bool> windowed_;
  MaliuzhinetsFunctions functions_{full_digits};
  double work_ = 0.0;
};

}  // namespace raytube
