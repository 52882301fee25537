#include "output/vtk/tube_paths_vtp.h"

#include <algorithm>

#include "core/decimal.h"
#include "output/vtk/vtk_file.h"

namespace raytube {

namespace {

std::vector<TubePathPoint> points_of(const TubePaths& tubes) {
  std::vector<TubePathPoint> points;
  for (const TubePath& path : tubes.paths) points.insert(points.end(), path.points.begin(), path.points.end());
  return points;
}

VtkLines lines_of(const TubePaths& tubes) {
  VtkLines lines;
  for (const TubePath& path : tubes.paths) {
    for (const TubePathPoint& point : path.points) lines.points.push_back(point.position);
    lines.end_line();
  }
  return lines;
}

std::string short_text(double value) { return fmt::format("{:.9g}", value); }

void write_point_data(OutputFile& out, const TubePaths& tubes) {
  write_array(out, "Int32", "bounce", points_of(tubes), [](const TubePathPoint& p) { return p.bounce; });
  write_array(out, "Float64", "path_length_m", points_of(tubes),
              [](const TubePathPoint& p) { return short_text(p.path_length); });
  write_array(out, "Float64", "power", points_of(tubes), [](const TubePathPoint& p) { return short_text(p.power); });
  write_array(out, "Int64", "triangle", points_of(tubes), [](const TubePathPoint& p) { return p.triangle; });
}

void write_cell_data(OutputFile& out, const TubePaths& tubes) {
  write_array(out, "Int64", "column", tubes.paths, [](const TubePath& path) { return path.column; });
  write_array(out, "Int64", "row", tubes.paths, [](const TubePath& path) { return path.row; });
  write_array(out, "Int32", "bounces", tubes.paths, [](const TubePath& path) { return path.bounces(); });
  write_array(out, "Float64", "area_m2", tubes.paths, [](const TubePath& path) { return number_text(path.area); });
  write_array(out, "Float64", "power_w", tubes.paths, [](const TubePath& path) { return short_text(path.power()); });
  write_array(out, "Float64", "length_m", tubes.paths, [](const TubePath& path) { return short_text(path.length()); });
  write_array(out, "UInt8", "end", tubes.paths, [](const TubePath& path) { return static_cast<int>(path.end); });
  write_array(out, "UInt8", "truncated", tubes.paths,
              [](const TubePath& path) { return path.end == TubeEnd::truncated ? 1 : 0; });
  if (std::ranges::any_of(tubes.paths, &TubePath::lit_by_ground))
    write_array(out, "UInt8", "lit_by_ground", tubes.paths, [](const TubePath& path) { return path.lit_by_ground ? 1 : 0; });
}

}  // namespace

void write_tube_paths_vtp(const std::filesystem::path& file, const TubePaths& tubes) {
  write_lines_vtp(
      file, tube_paths_head, lines_of(tubes), [&](OutputFile& out) { write_point_data(out, tubes); },
      [&](OutputFile& out) { write_cell_data(out, tubes); });
}

}  // namespace raytube
