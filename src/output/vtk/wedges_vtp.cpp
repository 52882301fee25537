#include "output/vtk/wedges_vtp.h"

#include "core/decimal.h"
#include "output/vtk/vtk_file.h"

namespace raytube {

namespace {

VtkLines lines_of(std::span<const WedgeLine> wedges) {
  VtkLines lines;
  for (const WedgeLine& wedge : wedges) {
    lines.points.insert(lines.points.end(), {wedge.start, wedge.end});
    lines.end_line();
  }
  return lines;
}

void write_wedge_data(OutputFile& out, std::span<const WedgeLine> wedges) {
  const auto write_numbers = [&](std::string_view name, auto value) {
    write_array(out, "Float64", name, wedges, [&](const WedgeLine& w) { return number_text(value(w)); });
  };
  write_array(out, "Int64", "wedge", counted(wedges.size()), [](std::size_t i) { return i; });
  write_numbers("length_m", [](const WedgeLine& w) { return w.length; });
  write_numbers("interior_deg", [](const WedgeLine& w) { return w.interior_angle / degree; });
  write_numbers("n", [](const WedgeLine& w) { return w.n; });
  write_array(out, "Int64", "face1_patch", wedges, [](const WedgeLine& w) { return w.patches[0]; });
  write_array(out, "Int64", "face2_patch", wedges, [](const WedgeLine& w) { return w.patches[1]; });
  write_numbers("lit_fraction", [](const WedgeLine& w) { return w.lit_fraction; });
  write_numbers("thickness_m", [](const WedgeLine& w) { return w.thickness; });
}

}  // namespace

void write_wedges_vtp(const std::filesystem::path& file, std::span<const WedgeLine> wedges) {
  write_lines_vtp(file, wedges_vtp_head, lines_of(wedges), {}, [&](OutputFile& out) { write_wedge_data(out, wedges); });
}

}  // namespace raytube
