#include "program/wedge_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/decimal.h"
#include "output/files/files.h"
#include "program/results.h"
#include "utd/shadow/edge_visibility.h"
#include "utd/wedge/incidence.h"

namespace raytube {

namespace {

// Lit fractions of the wedges for one transmitter; a wedge that is turned away or concave, and so plays no part, has none.
class LitFractions {
 public:
  LitFractions(const TriangleMesh& mesh, std::span<const Wedge> wedges, const Sweep& sweep)
      : wedges_(wedges),
        tracer_(mesh),
        towards_(spherical_basis(sweep.looks.front().transmit).radial),
        visibility_(wedges, tracer_, towards_, wavelength(*std::ranges::max_element(sweep.frequencies))) {}

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

constexpr std::string_view header =
    "wedge,x1_m,y1_m,z1_m,x2_m,y2_m,z2_m,length_m,interior_deg,n,face1_patch,face2_patch,lit_fraction,thickness_m\n";

std::string point_text(const dvec3& p) { return number_text(p.x) + ',' + number_text(p.y) + ',' + number_text(p.z); }

}  // namespace

void check_wedges_file(const std::filesystem::path& file) { folder_of_named_file("--wedges", file, header); }

void write_wedges_csv(const std::filesystem::path& file, const TriangleMesh& mesh, std::span<const Wedge> wedges,
                      const Sweep& sweep) {
  NewResults results(folder_of_named_file("--wedges", file, header));
  OutputFile out(results.folder() / file.filename());
  LitFractions lit(mesh, wedges, sweep);
  out.write(header);
  std::uint32_t row = 0;
  for (std::uint32_t i = 0; i < wedges.size(); ++i) {
    const Wedge& w = wedges[i];
    if (w.replaced_by != no_index) continue;
    out.write(std::to_string(row++) + ',' + point_text(w.start + mesh.center) + ',' + point_text(w.end + mesh.center) + ',' +
              number_text(w.length()) + ',' + number_text(w.interior_angle() / degree) + ',' + number_text(w.n) + ',' +
              std::to_string(w.faces[0].patch) + ',' + std::to_string(w.faces[1].patch) + ',' + number_text(lit.of(i)) + ',' +
              number_text(w.thickness()) + '\n');
  }
  out.commit();
  results.place({file.filename().c_str()});
}

}  // namespace raytube
