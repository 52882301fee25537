#include "output/image_compare/pixel_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace raytube {

namespace {

constexpr double same_place = 1e-4;  // of a pixel: tables round

// The straight line from pixels of the reference to those of the result.
AxisMap line_of(const EvenAxis& result, const EvenAxis& reference) {
  const double step = result.count > 1 ? result.step : reference.step;
  if (step == 0.0) return {0, 1, 1.0, 0.0};
  AxisMap map{0, 0, reference.count > 1 ? reference.step / step : 1.0, (reference.first - result.first) / step};
  if (std::abs(map.scale - 1.0) * static_cast<double>(reference.count) < same_place) map.scale = 1.0;
  if (std::abs(map.offset - std::round(map.offset)) < same_place) map.offset = std::round(map.offset);
  return map;
}

// Pixels i with 0 <= scale i + offset <= count - 1.
void limit(AxisMap& map, std::size_t of_result, std::size_t of_reference) {
  constexpr double slack = 1e-9;
  const double begin = -map.offset / map.scale, end = (static_cast<double>(of_result - 1) - map.offset) / map.scale;
  const double first = std::max(0.0, std::ceil(std::min(begin, end) - slack)),
               last = std::min(static_cast<double>(of_reference - 1), std::floor(std::max(begin, end) + slack));
  map.first = static_cast<std::size_t>(first);
  map.count = last < first ? 0 : static_cast<std::size_t>(last - first) + 1;
}

std::string size_text(const PixelImage& image) { return fmt::format("{} x {}", image.across.count, image.up.count); }

// Four neighbours of a place and their weights; of a whole number itself alone.
struct Neighbours {
  std::array<std::size_t, 4> at{};
  std::array<double, 4> weight{};
  int count = 1;
  double place = 0.0;

  double behind(int i) const { return place - static_cast<double>(at[i]); }
};

// Keys 1981, eq. 15: cubic pieces, exact for parabolas.
std::array<double, 4> cubic_weights(double t) {
  return {((-0.5 * t + 1.0) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1.0, ((-1.5 * t + 2.0) * t + 0.5) * t,
          (0.5 * t - 0.5) * t * t};
}

Neighbours neighbours(double place, std::size_t size) {
  const double below = std::floor(place), t = place - below;
  const auto inside = [size](double i) { return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(size - 1))); };
  if (t < 1e-9 || t > 1.0 - 1e-9) return {{inside(std::round(place))}, {1.0}, 1, std::round(place)};
  return {{inside(below - 1.0), inside(below), inside(below + 1.0), inside(below + 2.0)}, cubic_weights(t), 4, place};
}

// How far phases run on from one pixel to that `stride` behind it.
double mean_advance(const std::vector<Complex>& values, std::size_t stride) {
  Complex sum = 0.0;
  for (std::size_t i = stride; i < values.size(); ++i) sum += values[i] * std::conj(values[i - stride]);
  return std::arg(sum);
}

class Interpolation {
 public:
  Interpolation(const std::vector<Complex>& values, std::size_t columns)
      : values_(values), columns_(columns), advance_(mean_advance(values, 1), mean_advance(values, columns)) {}

  Complex at(const Neighbours& row, const Neighbours& column) const {
    if (row.count == 1 && column.count == 1) return values_[row.at[0] * columns_ + column.at[0]];
    double magnitude = 0.0;
    Complex phase = 0.0;
    for (int j = 0; j < row.count; ++j)
      for (int i = 0; i < column.count; ++i) {
        const Complex value = values_[row.at[j] * columns_ + column.at[i]];
        const double weight = row.weight[j] * column.weight[i];
        magnitude += weight * std::abs(value);
        phase += weight * value * std::polar(1.0, advance_.x * column.behind(i) + advance_.y * row.behind(j));
      }
    return std::polar(std::max(magnitude, 0.0), std::arg(phase));  // cubics overshoot
  }

 private:
  const std::vector<Complex>& values_;
  std::size_t columns_;
  dvec2 advance_;
};

std::vector<Neighbours> neighbours_along(const AxisMap& map, std::size_t size) {
  std::vector<Neighbours> all;
  for (std::size_t i = 0; i < map.count; ++i) all.push_back(neighbours(map.at(i), size));
  return all;
}

}  // namespace

PixelMap map_pixels(const PixelImage& result, const PixelImage& reference, const dvec2& shift) {
  const bool placed = result.placed && reference.placed;
  if (!placed && (result.across.count != reference.across.count || result.up.count != reference.up.count))
    throw InputError(fmt::format(
        "{} has {} pixels, {} {}, and not both say where they are; give columns u_m and v_m in metres, or images of one size",
        result.file.string(), size_text(result), reference.file.string(), size_text(reference)));
  const AxisMap same{0, 0, 1.0, 0.0};
  PixelMap map{placed ? line_of(result.across, reference.across) : same, placed ? line_of(result.up, reference.up) : same};
  map.across.offset += map.across.scale * shift.x, map.up.offset += map.up.scale * shift.y;
  limit(map.across, result.across.count, reference.across.count);
  limit(map.up, result.up.count, reference.up.count);
  if (map.pixels() == 0)
    throw InputError(
        fmt::format("{} and {} do not overlap: u from {:g} m, v from {:g} m against {:g} m, {:g} m; compare images "
                    "of the same place",
                    result.file.string(), reference.file.string(), result.across.first, result.up.first, reference.across.first,
                    reference.up.first));
  return map;
}

std::vector<Complex> sampled(const PixelImage& image, const std::vector<Complex>& values, const PixelMap& map) {
  const Interpolation between(values, image.across.count);
  const std::vector<Neighbours> across = neighbours_along(map.across, image.across.count),
                                up = neighbours_along(map.up, image.up.count);
  std::vector<Complex> found;
  found.reserve(map.pixels());
  for (const Neighbours& row : up)
    for (const Neighbours& column : across) found.push_back(between.at(row, column));
  return found;
}

std::vector<Complex> cropped(const PixelImage& image, const std::vector<Complex>& values, const PixelMap& map) {
  std::vector<Complex> found;
  found.reserve(map.pixels());
  for (std::size_t row = 0; row < map.up.count; ++row) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>((map.up.first + row) * image.across.count + map.across.first);
    found.insert(found.end(), begin, begin + static_cast<std::ptrdiff_t>(map.across.count));
  }
  return found;
}

}  // namespace raytube
