#include "output/vtk/vtk_file.h"

#include <openssl/evp.h>

#include <bit>
#include <cstring>
#include <numeric>

#include "core/decimal.h"

namespace raytube {

namespace {

constexpr int line_type = 3, triangle_type = 5;  // VTK_LINE, VTK_TRIANGLE

std::string vertex_text(const dvec3& r) { return fmt::format("{} {} {}", number_text(r.x), number_text(r.y), number_text(r.z)); }

void write_line_cells(OutputFile& out, const VtkLines& lines) {
  const VtkElement cells(out, "Lines");
  write_array(out, "Int64", "connectivity", counted(lines.points.size()), [](std::size_t i) { return i; });
  write_array(out, "Int64", "offsets", lines.ends, [](std::size_t end) { return end; });
}

void write_positions(OutputFile& out, const VtkLines& lines) {
  const VtkElement points(out, "Points");
  const auto text = [](const dvec3& r) {
    return fmt::format("{:.9g} {:.9g} {:.9g}", r.x + 0.0, r.y + 0.0, r.z + 0.0);
  };  // no "-0"
  write_array(out, "Float64", "points", lines.points, text, 3);
}

void write_vertices(OutputFile& out, const VtkSurface& surface) {
  const VtkElement points(out, "Points");
  std::vector<dvec3> all(surface.vertices.begin(), surface.vertices.end());
  for (const auto& segment : surface.segments) all.insert(all.end(), segment.begin(), segment.end());
  write_array(out, "Float64", "points", all, vertex_text, 3);
}

void write_surface_cells(OutputFile& out, const VtkSurface& surface) {
  const VtkElement cells(out, "Cells");
  const std::size_t triangles = surface.triangles.size(), count = triangles + surface.segments.size();
  const std::size_t vertices = surface.vertices.size();
  write_array(out, "Int64", "connectivity", counted(count), [&](std::size_t i) {
    if (i < triangles) return fmt::format("{}", fmt::join(surface.triangles[i], " "));
    const std::size_t first = vertices + 2 * (i - triangles);
    return fmt::format("{} {}", first, first + 1);
  });
  write_array(out, "Int64", "offsets", counted(count),
              [&](std::size_t i) { return i < triangles ? 3 * (i + 1) : 2 * (i + 1) + triangles; });
  write_array(out, "UInt8", "types", counted(count), [&](std::size_t i) { return i < triangles ? triangle_type : line_type; });
}

void write_section(OutputFile& out, std::string_view name, const VtkData& data) {
  if (!data) return;
  const VtkElement section(out, name);
  data(out);
}

std::string base64(const std::string& bytes) {
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // with the zero that OpenSSL puts at the end
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), reinterpret_cast<const unsigned char*>(bytes.data()),
                  static_cast<int>(bytes.size()));
  text.pop_back();
  return text;
}

}  // namespace

std::vector<std::size_t> counted(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

void write_binary_array(OutputFile& out, std::string_view name, std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little);
  const std::uint64_t size = values.size_bytes();
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  std::memcpy(bytes.data() + sizeof size, values.data(), size);
  const VtkElement array(out, "DataArray", fmt::format("type=\"Float32\" Name=\"{}\" format=\"binary\"", name));
  out.write(base64(bytes) + '\n');
}

void write_lines_vtp(const std::filesystem::path& file, std::string_view head, const VtkLines& lines, const VtkData& point_data,
                     const VtkData& cell_data) {
  OutputFile out(file);
  out.write(head);
  {
    const VtkElement poly_data(out, "PolyData");
    const VtkElement piece(out, "Piece",
                           fmt::format("NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                                       "NumberOfPolys=\"0\"",
                                       lines.points.size(), lines.ends.size()));
    write_section(out, "PointData", point_data);
    write_section(out, "CellData", cell_data);
    write_positions(out, lines);
    write_line_cells(out, lines);
  }
  out.write("</VTKFile>\n");
  out.commit();
}

void write_surface_vtu(const std::filesystem::path& file, std::string_view head, const VtkSurface& surface,
                       const VtkData& cell_data) {
  OutputFile out(file);
  out.write(head);
  {
    const VtkElement grid(out, "UnstructuredGrid");
    const VtkElement piece(
        out, "Piece",
        fmt::format("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", surface.vertices.size() + 2 * surface.segments.size(),
                    surface.triangles.size() + surface.segments.size()));
    write_vertices(out, surface);
    write_surface_cells(out, surface);
    write_section(out, "CellData", cell_data);
  }
  out.write("</VTKFile>\n");
  out.commit();
}

}  // namespace raytube
