#include "output/vtk/isar_vti.h"

#include <algorithm>

#include "core/decimal.h"
#include "output/tables/csv.h"
#include "output/vtk/vtk_file.h"

namespace raytube {

namespace {

constexpr double lowest_level = -400.0;  // [dBsm] in the place of -inf, which readers refuse

struct Geometry {
  std::string extent, place;  // attributes
};

// VTK's first axis runs fastest, the image's last one.
Geometry geometry_of(const IsarImage& image) {
  std::array<std::size_t, 3> last{};
  std::array<double, 3> step{1.0, 1.0, 1.0};
  const dvec3 first = image.place(0);
  std::string directions;
  const std::size_t count = image.axes.size();
  std::array<dvec3, 3> axes{};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t axis = count - 1 - i;
    last[i] = image.grid.count[axis] - 1, step[i] = image.grid.step[axis], axes[i] = image.axes[axis].direction;
  }
  if (count == 2) axes[2] = glm::cross(axes[0], axes[1]);
  for (int row = 0; row < 3; ++row)
    for (const dvec3& axis : axes) directions += number_text(axis[row] + 0.0) + ' ';
  return {fmt::format("Extent=\"0 {} 0 {} 0 {}\"", last[0], last[1], last[2]),
          fmt::format("Origin=\"{} {} {}\" Spacing=\"{} {} {}\" Direction=\"{}\"", number_text(first.x), number_text(first.y),
                      number_text(first.z), number_text(step[0]), number_text(step[1]), number_text(step[2]), directions)};
}

void write_values(OutputFile& out, const IsarImage& image, int channel) {
  std::vector<float> values(image.s.size());
  const auto write = [&](const std::string& quantity, auto number) {
    std::ranges::transform(image.s, values.begin(),
                           [&](const ScatteringMatrix& s) { return static_cast<float>(number(s.at(channel / 2, channel % 2))); });
    write_binary_array(out, fmt::format(fmt::runtime(quantity), channel_names[static_cast<std::size_t>(channel)]), values);
  };
  write("sigma_{}_dbsm", [](const Complex& s) { return std::max(sigma_dbsm(s), lowest_level); });
  write("re_{}", [](const Complex& s) { return s.real(); });
  write("im_{}", [](const Complex& s) { return s.imag(); });
}

}  // namespace

void write_isar_vti(const std::filesystem::path& file, const IsarImage& image) {
  OutputFile out(file);
  out.write(fmt::format("<VTKFile type=\"ImageData\" {}><!-- ISAR image of raytube -->\n", vtk_binary));
  const Geometry geometry = geometry_of(image);
  {
    const VtkElement data(out, "ImageData", "Whole" + geometry.extent + ' ' + geometry.place);
    const VtkElement piece(out, "Piece", geometry.extent);
    const VtkElement values(out, "PointData", "Scalars=\"sigma_vv_dbsm\"");
    for (const int channel : {0, 1, 2, 3}) write_values(out, image, channel);
  }
  out.write("</VTKFile>\n");
  out.commit();
}

}  // namespace raytube
