#include "output/tables/surface_rays_vtp.h"

#include "output/tables/vtk_array.h"

namespace raytube {

namespace {

std::size_t points_of(std::span<const SurfaceRay> rays) {
  std::size_t count = 0;
  for (const SurfaceRay& ray : rays) count += ray.points.size();
  return count;
}

// value(point) of all points in their order.
template <class Value>
void write_values(OutputFile& out, const char* name, std::span<const SurfaceRay> rays, Value value) {
  DataArray data(out, "Float32", name);
  for (const SurfaceRay& ray : rays)
    for (const SurfaceRayPoint& point : ray.points) data.line(fmt::format("{:.6g}", value(point) + 0.0));  // + 0.0: no "-0"
}

void write_point_data(OutputFile& out, std::span<const SurfaceRay> rays, double wavelength) {
  out.write("<PointData>\n");
  write_values(out, "arc_length", rays, [&](const SurfaceRayPoint& p) { return p.arc_length / wavelength; });
  write_values(out, "xi", rays, [](const SurfaceRayPoint& p) { return p.xi; });
  write_values(out, "width", rays, [](const SurfaceRayPoint& p) { return p.width; });
  write_values(out, "hard", rays, [](const SurfaceRayPoint& p) { return p.hard; });
  write_values(out, "soft", rays, [](const SurfaceRayPoint& p) { return p.soft; });
  out.write("</PointData>\n");
}

void write_kinds(OutputFile& out, std::span<const SurfaceRay> rays) {
  out.write("<CellData>\n");
  {
    DataArray kinds(out, "UInt8", "kind");
    for (const SurfaceRay& ray : rays) kinds.line(fmt::format("{}", static_cast<int>(ray.kind)));
  }
  {
    DataArray orders(out, "UInt8", "order");
    for (const SurfaceRay& ray : rays) orders.line(fmt::format("{}", ray.order));
  }
  out.write("</CellData>\n");
}

void write_positions(OutputFile& out, std::span<const SurfaceRay> rays) {
  out.write("<Points>\n");
  {
    DataArray points(out, "Float64", "points", 3);
    for (const SurfaceRay& ray : rays)
      for (const SurfaceRayPoint& p : ray.points)
        points.line(fmt::format("{:.9g} {:.9g} {:.9g}", p.position.x, p.position.y, p.position.z));
  }
  out.write("</Points>\n");
}

void write_lines(OutputFile& out, std::span<const SurfaceRay> rays) {
  out.write("<Lines>\n");
  {
    DataArray points(out, "Int64", "connectivity");
    for (std::size_t i = 0, count = points_of(rays); i < count; ++i) points.line(fmt::format("{}", i));
  }
  {
    DataArray ends(out, "Int64", "offsets");
    std::size_t end = 0;
    for (const SurfaceRay& ray : rays) ends.line(fmt::format("{}", end += ray.points.size()));
  }
  out.write("</Lines>\n");
}

}  // namespace

void write_surface_rays_vtp(const std::filesystem::path& file, std::span<const SurfaceRay> rays, double wavelength) {
  OutputFile out(file);
  out.write(surface_rays_head);
  out.write(
      fmt::format("<PolyData><Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                  "NumberOfPolys=\"0\">\n",
                  points_of(rays), rays.size()));
  write_point_data(out, rays, wavelength);
  write_kinds(out, rays);
  write_positions(out, rays);
  write_lines(out, rays);
  out.write("</Piece></PolyData>\n</VTKFile>\n");
  out.commit();
}

}  // namespace raytube
