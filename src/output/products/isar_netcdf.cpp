#include "output/products/isar_netcdf.h"

#include <array>
#include <string>

#include "output/netcdf/new_netcdf.h"
#include "output/products/amplitude_variables.h"
#include "output/products/isar_csv.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

void write_axis_attributes(NewNetcdf& out, const IsarImage& image, std::size_t axis) {
  const ImageAxis& a = image.axes[axis];
  const std::string name = axis_name(axis);
  out.attribute(name + "_direction", std::array{a.direction.x + 0.0, a.direction.y + 0.0, a.direction.z + 0.0});
  out.attribute(name + "_resolution_m", std::array{a.resolution});
  out.attribute(name + "_unambiguous_m", std::array{a.unambiguous});
}

void write_axis(NewNetcdf& out, const IsarImage& image, std::size_t axis) {
  const std::string name = std::string(axis_name(axis)) + "_m";
  out.dimension(name, image.grid.count[axis]);
  std::vector<double> at;
  for (std::size_t i = 0; i < image.grid.count[axis]; ++i) at.push_back(image.coordinate(axis, i));
  out.put(out.variable(name, {name}, "m", std::array{"range", "cross-range", "height"}[axis]), at);
}

}  // namespace

void write_isar_netcdf(const std::filesystem::path& file, const StoredResult& result, const IsarImage& image,
                       const Window& window, const std::vector<std::array<dvec3, 2>>& outline) {
  NewNetcdf out(file);
  describe_product(out, result, window);
  const auto& [at, amplitude] = image.peak;
  out.attribute("peak_dbsm", std::array{sigma_dbsm(amplitude)});
  out.attribute("peak_place_m", std::array{at.x + 0.0, at.y + 0.0, at.z + 0.0});
  std::vector<std::string> axes;
  for (std::size_t axis = 0; axis < image.axes.size(); ++axis) {
    write_axis_attributes(out, image, axis);
    write_axis(out, image, axis);
    axes.push_back(std::string(axis_name(axis)) + "_m");
  }
  out.polarisations();
  write_amplitudes(out, axes, "ISAR image I", "", image.s);
  if (!outline.empty()) out.labels("xyz", {"x", "y", "z"}, "axis of the mesh's coordinates");
  write_outline(out, outline);
  out.write();
}

}  // namespace raytube
