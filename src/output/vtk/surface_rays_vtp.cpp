#include "output/vtk/surface_rays_vtp.h"

#include "output/vtk/vtk_file.h"

namespace raytube {

namespace {

VtkLines lines_of(std::span<const SurfaceRay> rays) {
  VtkLines lines;
  for (const SurfaceRay& ray : rays) {
    for (const SurfaceRayPoint& point : ray.points) lines.points.push_back(point.position);
    lines.end_line();
  }
  return lines;
}

std::vector<SurfaceRayPoint> points_of(std::span<const SurfaceRay> rays) {
  std::vector<SurfaceRayPoint> points;
  for (const SurfaceRay& ray : rays) points.insert(points.end(), ray.points.begin(), ray.points.end());
  return points;
}

// value(point) of all points in their order.
template <class Value>
void write_values(OutputFile& out, std::string_view name, std::span<const SurfaceRay> rays, Value value) {
  write_array(out, "Float32", name, points_of(rays),
              [&](const SurfaceRayPoint& point) { return fmt::format("{:.6g}", value(point) + 0.0); });  // + 0.0: no "-0"
}

}  // namespace

void write_surface_rays_vtp(const std::filesystem::path& file, std::span<const SurfaceRay> rays, double wavelength) {
  const auto point_data = [&](OutputFile& out) {
    write_values(out, "arc_length", rays, [&](const SurfaceRayPoint& p) { return p.arc_length / wavelength; });
    write_values(out, "xi", rays, [](const SurfaceRayPoint& p) { return p.xi; });
    write_values(out, "width", rays, [](const SurfaceRayPoint& p) { return p.width; });
    write_values(out, "hard", rays, [](const SurfaceRayPoint& p) { return p.hard; });
    write_values(out, "soft", rays, [](const SurfaceRayPoint& p) { return p.soft; });
  };
  const auto cell_data = [&](OutputFile& out) {
    write_array(out, "UInt8", "kind", rays, [](const SurfaceRay& ray) { return static_cast<int>(ray.kind); });
    write_array(out, "UInt8", "order", rays, [](const SurfaceRay& ray) { return ray.order; });
  };
  write_lines_vtp(file, surface_rays_head, lines_of(rays), point_data, cell_data);
}

}  // namespace raytube
