#include "output/vtk/read_image_vtu.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "core/error.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

// The arrays of a file by their names.
class VtkArrays {
 public:
  explicit VtkArrays(const std::filesystem::path& file) : name_(file.string()) {
    std::ifstream in(file, std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(in), {});
  }

  std::vector<double> numbers(const std::string& array) const {
    const std::size_t at = text_.find("Name=\"" + array + '"'), begin = at == std::string::npos ? at : text_.find('>', at);
    if (begin == std::string::npos) refuse();
    std::vector<double> values;
    const char* text = text_.c_str() + begin + 1;
    for (char* end = nullptr;; text = end) {
      const double value = std::strtod(text, &end);
      if (end == text) return values;
      values.push_back(value);
    }
  }

  [[noreturn]] void refuse() const {
    throw InputError(fmt::format("{}: is no image of a look as raytube writes it; make it again with raytube run", name_));
  }

 private:
  std::string name_, text_;
};

std::vector<dvec3> points_of(const VtkArrays& arrays) {
  const std::vector<double> numbers = arrays.numbers("points");
  std::vector<dvec3> points;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return points;
}

std::vector<ScatteringMatrix> scattering_of(const VtkArrays& arrays, std::size_t cells) {
  std::vector<ScatteringMatrix> all(cells);
  for (int channel = 0; channel < 4; ++channel) {
    const std::string name = channel_names[static_cast<std::size_t>(channel)];
    const std::vector<double> re = arrays.numbers("re_" + name), im = arrays.numbers("im_" + name);
    if (re.size() != cells || im.size() != cells) arrays.refuse();
    for (std::size_t i = 0; i < cells; ++i) all[i].at(channel / 2, channel % 2) = {re[i], im[i]};
  }
  return all;
}

}  // namespace

ImageMesh read_image_vtu(const std::filesystem::path& file) {
  const VtkArrays arrays(file);
  const std::vector<dvec3> points = points_of(arrays);
  const std::vector<double> corners = arrays.numbers("connectivity"), ends = arrays.numbers("offsets");
  const std::vector<ScatteringMatrix> s = scattering_of(arrays, ends.size());
  for (const double corner : corners)
    if (!(corner >= 0.0 && corner < static_cast<double>(points.size()))) arrays.refuse();
  ImageMesh mesh;
  std::size_t first = 0;
  for (std::size_t cell = 0; cell < ends.size(); ++cell) {
    const auto end = static_cast<std::size_t>(ends[cell]), count = end - first;
    if (end > corners.size() || (count != 2 && count != 3)) arrays.refuse();
    const auto corner = [&](std::size_t i) { return static_cast<std::uint32_t>(corners[first + i]); };
    if (count == 3) {
      mesh.triangles.push_back({corner(0), corner(1), corner(2)});
      mesh.image.triangles.push_back(s[cell]);
    } else {
      mesh.image.edges.push_back({points[corner(0)], points[corner(1)], s[cell]});
    }
    first = end;
  }
  mesh.vertices.assign(points.begin(), points.end() - static_cast<std::ptrdiff_t>(2 * mesh.image.edges.size()));
  return mesh;
}

}  // namespace raytube
