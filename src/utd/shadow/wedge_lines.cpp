#include "utd/shadow/wedge_lines.h"

#include "utd/shadow/edge_visibility.h"
#include "utd/wedge/incidence.h"

namespace raytube {

namespace {

class LitFractions {
 public:
  LitFractions(const TriangleMesh& mesh, std::span<const Wedge> wedges, const Look& look, double wavelength)
      : wedges_(wedges),
        tracer_(mesh),
        towards_(spherical_basis(look.transmit).radial),
        visibility_(wedges, tracer_, towards_, wavelength) {}

  double of(std::uint32_t index) {
    const Wedge& wedge = wedges_[index];
    if (!wedge.convex()) return 0.0;
    const WedgeIncidence incidence = incidence_on(wedge, -towards_);
    if (incidence.weight == 0.0) return 0.0;
    visibility_.find(index, incidence.free_side, lit_);
    double sum = 0.0;
    for (const LitInterval& part : lit_) sum += part.end - part.begin;
    return sum;
  }

 private:
  std::span<const Wedge> wedges_;
  Tracer tracer_;
  dvec3 towards_;
  EdgeVisibility visibility_;
  std::vector<LitInterval> lit_;
};

}  // namespace

std::vector<WedgeLine> wedge_lines(const TriangleMesh& mesh, std::span<const Wedge> wedges, const Look& look, double wavelength) {
  LitFractions lit(mesh, wedges, look, wavelength);
  std::vector<WedgeLine> lines;
  for (std::uint32_t i = 0; i < wedges.size(); ++i) {
    const Wedge& w = wedges[i];
    if (w.replaced_by != no_index) continue;
    lines.push_back({w.start + mesh.center,
                     w.end + mesh.center,
                     w.length(),
                     w.interior_angle(),
                     w.n,
                     {w.faces[0].patch, w.faces[1].patch},
                     lit.of(i),
                     w.thickness()});
  }
  return lines;
}

}  // namespace raytube
