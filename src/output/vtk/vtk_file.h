// VTK's XML files, which ParaView opens: what all of them are made of.
//
// output/vtk writes results in space: lines (.vtp: paths of tubes, rays over surfaces, wedges) and the target's triangles with
// what belongs to each (.vtu: images, hits). Numbers are text, but for those of images in space; positions are in the mesh's own
// coordinates [m].
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/field.h"
#include "output/files/files.h"

namespace raytube {

/// An element; its closing tag comes at the end of its scope.
class VtkElement {
 public:
  VtkElement(OutputFile& out, std::string_view name, std::string_view attributes = "") : out_(out), name_(name) {
    out_.write(fmt::format("<{}{}{}>\n", name, attributes.empty() ? "" : " ", attributes));
  }
  ~VtkElement() { out_.write(fmt::format("</{}>\n", name_)); }
  VtkElement(const VtkElement&) = delete;

 private:
  OutputFile& out_;
  std::string name_;
};

/// 0 ... count - 1.
std::vector<std::size_t> counted(std::size_t count);

/// An array: text(item) of every item, each on its line.
template <class Items, class Text>
void write_array(OutputFile& out, std::string_view type, std::string_view name, Items&& items, Text text, int components = 1) {
  const VtkElement array(
      out, "DataArray",
      fmt::format("type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\"", type, name, components));
  for (auto&& item : items) out.write(fmt::format("{}\n", text(item)));
}

/// The attributes of a file with arrays in base64.
inline constexpr std::string_view vtk_binary = "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"";

/// An array of Float32 in base64, for many numbers: a third of the size of text, and written in a tenth of the time.
void write_binary_array(OutputFile& out, std::string_view name, std::span<const float> values);

/// Lines one after another.
struct VtkLines {
  std::vector<dvec3> points;      // of all lines
  std::vector<std::size_t> ends;  // the points up to the end of each line

  void end_line() { ends.push_back(points.size()); }
};

/// Writes arrays, one after another; none: there are no data.
using VtkData = std::function<void(OutputFile&)>;

/// Poly data (.vtp) of lines. `head` is the first line; by it a file is known as an earlier result.
void write_lines_vtp(const std::filesystem::path& file, std::string_view head, const VtkLines& lines, const VtkData& point_data,
                     const VtkData& cell_data);

/// What an unstructured grid (.vtu) is made of: cells are the triangles, then the segments.
struct VtkSurface {
  std::span<const dvec3> vertices;
  std::span<const std::array<std::uint32_t, 3>> triangles;
  std::span<const std::array<dvec3, 2>> segments{};
};

void write_surface_vtu(const std::filesystem::path& file, std::string_view head, const VtkSurface& surface,
                       const VtkData& cell_data);

}  // namespace raytube
