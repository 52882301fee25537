#include "output/tables/wedges_csv.h"

#include <fmt/format.h>

#include "core/decimal.h"
#include "output/files/files.h"

namespace raytube {

namespace {

std::string position_cells(const dvec3& p) {
  return fmt::format("{},{},{}", number_text(p.x), number_text(p.y), number_text(p.z));
}

}  // namespace

void write_wedges_csv(const std::filesystem::path& file, std::span<const WedgeLine> wedges) {
  OutputFile out(file);
  out.write(wedges_csv_head);
  for (std::size_t i = 0; i < wedges.size(); ++i) {
    const WedgeLine& w = wedges[i];
    out.write(fmt::format("{},{},{},{},{},{},{},{},{},{}\n", i, position_cells(w.start), position_cells(w.end),
                          number_text(w.length), number_text(w.interior_angle / degree), number_text(w.n), w.patches[0],
                          w.patches[1], number_text(w.lit_fraction), number_text(w.thickness)));
  }
  out.commit();
}

}  // namespace raytube
