#include "output/vtk/image_vtu.h"

#include <algorithm>

#include "core/decimal.h"
#include "output/tables/csv.h"
#include "output/vtk/vtk_file.h"

namespace raytube {

namespace {

constexpr double least_level = -400.0;  // [dBsm] in the place of -inf, which readers refuse
constexpr std::string_view image_head =
    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\"><!-- image of raytube -->\n";

// What one cell of the file returns.
struct ImageCell {
  const ScatteringMatrix& s;
  bool edge;
};

std::vector<ImageCell> cells_of(const LookImage& image) {
  std::vector<ImageCell> cells;
  for (const ScatteringMatrix& s : image.triangles) cells.push_back({s, false});
  for (const ImageEdge& piece : image.edges) cells.push_back({piece.s, true});
  return cells;
}

void write_channel(OutputFile& out, const std::vector<ImageCell>& cells, int channel) {
  const auto s_of = [channel](const ImageCell& cell) { return cell.s.at(channel / 2, channel % 2); };
  const std::string name = channel_names[channel];
  write_array(out, "Float32", "sigma_" + name + "_dbsm", cells,
              [&](const ImageCell& cell) { return fmt::format("{:.3f}", std::max(sigma_dbsm(s_of(cell)), least_level)); });
  write_array(out, "Float64", "re_" + name, cells, [&](const ImageCell& cell) { return number_text(s_of(cell).real()); });
  write_array(out, "Float64", "im_" + name, cells, [&](const ImageCell& cell) { return number_text(s_of(cell).imag()); });
}

}  // namespace

void write_image_vtu(const std::filesystem::path& file, std::span<const dvec3> vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles, const LookImage& image) {
  std::vector<std::array<dvec3, 2>> segments;
  for (const ImageEdge& piece : image.edges) segments.push_back({piece.begin, piece.end});
  write_surface_vtu(file, image_head, {vertices, triangles, segments}, [&](OutputFile& out) {
    const std::vector<ImageCell> cells = cells_of(image);
    for (int channel = 0; channel < 4; ++channel) write_channel(out, cells, channel);
    write_array(out, "UInt8", "edge", cells, [](const ImageCell& cell) { return cell.edge ? 1 : 0; });
  });
}

}  // namespace raytube
