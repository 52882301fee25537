#include "output/products/isar_csv.h"

#include <fmt/format.h>

#include <array>

#include "core/decimal.h"
#include "output/files/files.h"
#include "output/products/amplitude_columns.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

std::string head(const IsarImage& image, const Window& window) {
  std::string text = fmt::format(
      "# ISAR image: I(x) = sum of w S exp(-j k (s + s') . x) / sum of w over frequencies and angles, windows: {}. A point of "
      "sigma "
      "that\n# all looks see alike reads sigma. Coordinates from the origin of the mesh's own, in metres.\n",
      name_of(window));
  for (std::size_t axis = 0; axis < image.axes.size(); ++axis)
    text += fmt::format("# {}_m along {}: peaks {:.6g} m wide 3 dB below their top, unambiguous {:.6g} m.\n", axis_name(axis),
                        vector_text(image.axes[axis].direction), image.axes[axis].resolution, image.axes[axis].unambiguous);
  for (std::size_t axis = 0; axis < image.axes.size(); ++axis) text += fmt::format("{}_m,", axis_name(axis));
  return text + "x_m,y_m,z_m" + amplitude_columns() + '\n';
}

std::string cell_text(const IsarImage& image, std::size_t index) {
  const dvec3 at = image.coordinates(index), place = image.place_of(at);
  std::string text;
  for (std::size_t axis = 0; axis < image.axes.size(); ++axis) text += fmt::format("{:.9g},", at[static_cast<int>(axis)]);
  text += fmt::format("{:.9g},{:.9g},{:.9g}", place.x + 0.0, place.y + 0.0, place.z + 0.0);
  return text + amplitudes_text(image.s[index], 9) + '\n';
}

}  // namespace

const char* axis_name(std::size_t axis) { return std::array{"range", "cross_range", "height"}[axis]; }

void write_isar_csv(const std::filesystem::path& file, const IsarImage& image, const Window& window) {
  OutputFile out(file);
  out.write(head(image, window));
  for (std::size_t i = 0; i < image.s.size(); ++i) out.write(cell_text(image, i));
  out.commit();
}

}  // namespace raytube
