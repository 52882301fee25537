#include "output/tables/vtu.h"

#include <algorithm>

#include "core/decimal.h"
#include "output/tables/csv.h"
#include "output/tables/vtk_array.h"

namespace raytube {

namespace {

constexpr int line_type = 3, triangle_type = 5;  // VTK_LINE, VTK_TRIANGLE
constexpr double least_level = -400.0;           // [dBsm] in the place of -inf, which readers refuse

// value(s, is_edge) of all cells in their order.
template <class Value>
void write_cells(OutputFile& out, const char* type, const std::string& name, const LookImage& image, Value value) {
  DataArray data(out, type, name);
  for (const ScatteringMatrix& s : image.triangles) data.line(value(s, false));
  for (const ImageEdge& piece : image.edges) data.line(value(piece.s, true));
}

std::string point_text(const dvec3& r) { return fmt::format("{} {} {}", number_text(r.x), number_text(r.y), number_text(r.z)); }

void write_points(OutputFile& out, std::span<const dvec3> vertices, const LookImage& image) {
  out.write("<Points>\n");
  {
    DataArray points(out, "Float64", "points", 3);
    for (const dvec3& vertex : vertices) points.line(point_text(vertex));
    for (const ImageEdge& piece : image.edges) points.line(point_text(piece.begin) + ' ' + point_text(piece.end));
  }
  out.write("</Points>\n");
}

void write_connections(OutputFile& out, std::size_t vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
                       std::size_t edges) {
  DataArray corners(out, "Int64", "connectivity");
  for (const auto& [a, b, c] : triangles) corners.line(fmt::format("{} {} {}", a, b, c));
  for (std::size_t i = 0; i < edges; ++i) corners.line(fmt::format("{} {}", vertices + 2 * i, vertices + 2 * i + 1));
}

void write_offsets(OutputFile& out, std::size_t triangles, std::size_t edges) {
  DataArray ends(out, "Int64", "offsets");
  for (std::size_t i = 1; i <= triangles; ++i) ends.line(fmt::format("{}", 3 * i));
  for (std::size_t i = 1; i <= edges; ++i) ends.line(fmt::format("{}", 3 * triangles + 2 * i));
}

void write_cell_data(OutputFile& out, const LookImage& image) {
  out.write("<CellData>\n");
  for (int channel = 0; channel < 4; ++channel) {
    const auto s_of = [channel](const ScatteringMatrix& s) { return s.at(channel / 2, channel % 2); };
    const std::string name = channel_names[channel];
    write_cells(out, "Float32", "sigma_" + name + "_dbsm", image, [&](const ScatteringMatrix& s, bool) {
      return fmt::format("{:.3f}", std::max(sigma_dbsm(s_of(s)), least_level));
    });
    write_cells(out, "Float64", "re_" + name, image,
                [&](const ScatteringMatrix& s, bool) { return number_text(s_of(s).real()); });
    write_cells(out, "Float64", "im_" + name, image,
                [&](const ScatteringMatrix& s, bool) { return number_text(s_of(s).imag()); });
  }
  write_cells(out, "UInt8", "edge", image, [](const ScatteringMatrix&, bool edge) { return std::string(edge ? "1" : "0"); });
  out.write("</CellData>\n");
}

}  // namespace

void write_image_vtu(const std::filesystem::path& file, std::span<const dvec3> vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles, const LookImage& image) {
  OutputFile out(file);
  out.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n");
  out.write(fmt::format("<UnstructuredGrid><Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                        vertices.size() + 2 * image.edges.size(), triangles.size() + image.edges.size()));
  write_points(out, vertices, image);
  out.write("<Cells>\n");
  write_connections(out, vertices.size(), triangles, image.edges.size());
  write_offsets(out, triangles.size(), image.edges.size());
  write_cells(out, "UInt8", "types", image,
              [](const ScatteringMatrix&, bool edge) { return fmt::format("{}", edge ? line_type : triangle_type); });
  out.write("</Cells>\n");
  write_cell_data(out, image);
  out.write("</Piece></UnstructuredGrid>\n</VTKFile>\n");
  out.commit();
}

}  // namespace raytube
