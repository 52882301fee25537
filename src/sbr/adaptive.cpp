#include "sbr/adaptive.h"

#include "sbr/beam_tree.h"
#include "sbr/lattice.h"
#include "sbr/polygon_integral.h"
#include "sbr/visible.h"

namespace raytube {

namespace {

// A tube of polygonal cross-section and the beam it travels in, just reflected by a patch.
struct PolygonTube {
  std::uint32_t beam, patch;
  ConvexPolygon outline;
};

class FaceTrace {
 public:
  explicit FaceTrace(const AdaptiveLook& look)
      : look_(look),
        beams_(look.tree.mesh(), look.receive, incident_beam(look.grid, look.transmit, dvec2(0.0))),
        visible_(look.tree) {}

  TubeSums run(std::uint32_t begin, std::uint32_t end) {
    visible_.of_faces(beams_.beam(BeamTree::root), begin, end, parts_);
    reflect(BeamTree::root, 0);
    sums_.tubes = sums_.rays = reflected_.size();
    for (int bounce = 1; !reflected_.empty(); ++bounce) {
      std::swap(tubes_, reflected_);
      reflected_.clear();
      for (const PolygonTube& tube : tubes_) follow(tube, bounce);
      sums_.rays += tubes_.size();
    }
    sums_.sliver_area = visible_.sliver_area();
    return std::move(sums_);
  }

 private:
  void follow(const PolygonTube& tube, int bounce) {
    visible_.from_surface(beams_.beam(tube.beam), tube.patch, tube.outline, parts_);
    if (bounce < look_.max_bounces) return reflect(tube.beam, bounce);
    sums_.tubes_cut += parts_.size();
    parts_.clear();
  }

  // Turns the parts that a beam has met into currents and reflected tubes.
  void reflect(std::uint32_t beam, int bounce) {
    for (VisiblePart& part : parts_) {
      const std::uint32_t patch = look_.tree.faces()[part.face].patch;
      const std::uint32_t node = beams_.child(beam, patch, middle(part.outline));
      if (!integrate(node, part.outline, bounce)) continue;
      ++sums_.hits[static_cast<std::size_t>(bounce)];
      reflected_.push_back({node, patch, std::move(part.outline)});
    }
    parts_.clear();
  }

  // False if no cell's ray runs through the outline.
  bool integrate(std::uint32_t node, const ConvexPolygon& outline, int bounce) {
    if (!look_.clip) {
      cells_under(look_.grid, outline, blocks_);
      if (blocks_.empty()) return false;
    }
    if (sums_.bounces.size() <= static_cast<std::size_t>(bounce)) {
      sums_.bounces.emplace_back(look_.wavenumbers.size());
      sums_.hits.push_back(0);
    }
    const Footprint& footprint = beams_.footprint(node);
    std::vector<ScatteringMatrix>& sums = sums_.bounces.back();
    for (std::size_t f = 0; f < sums.size(); ++f) {
      const double k = look_.wavenumbers[f];
      add_far_field(sums[f], footprint, k, look_.clip ? phase_integral(footprint, k, outline) : over_cells(footprint, k));
    }
    return true;
  }

  Complex over_cells(const Footprint& footprint, double k) const {
    Complex sum = 0.0;
    for (const CellBlock& block : blocks_) {
      const LaunchGrid& grid = look_.grid;
      const dvec2 size{(block.column_end - block.column_begin) * grid.du, (block.row_end - block.row_begin) * grid.dv};
      const dvec2 low{grid.u_begin + block.column_begin * grid.du, grid.v_begin + block.row_begin * grid.dv};
      sum += phase_integral(footprint, k, low + 0.5 * size, size.x, size.y);
    }
    return sum;
  }

  const AdaptiveLook& look_;
  BeamTree beams_;
  VisibleSurfaces visible_;
  std::vector<VisiblePart> parts_;
  std::vector<PolygonTube> tubes_, reflected_;
  std::vector<CellBlock> blocks_;
  TubeSums sums_;
};

}  // namespace

TubeSums trace_faces(const AdaptiveLook& look, std::uint32_t begin, std::uint32_t end) { return FaceTrace(look).run(begin, end); }

}  // namespace raytube
