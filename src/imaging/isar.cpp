#include "imaging/isar.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "imaging/peak.h"

namespace raytube {

namespace {

// Away from the scan, towards the origin; then along it.
std::vector<dvec3> axis_directions(const AntennaScan& scan, bool plane) {
  dvec3 away = -scan.middle + glm::dot(scan.middle, scan.fast) * scan.fast;
  if (!plane) return {glm::normalize(away), scan.fast};
  away += glm::dot(scan.middle, scan.slow) * scan.slow;
  return {glm::normalize(away), scan.fast, scan.slow};
}

// Orthonormal: away from the radar, along rising azimuth, upwards; two or three of them.
std::vector<dvec3> axis_directions(const AngleGrid& grid) {
  if (grid.scan) return axis_directions(*grid.scan, grid.theta_deg.count > 1);
  const SphericalBasis middle = spherical_basis({grid.theta_deg.middle() * degree, grid.phi_deg.middle() * degree});
  const bool azimuth = grid.phi_deg.count > 1, elevation = grid.theta_deg.count > 1;
  if (azimuth && elevation) return {-middle.radial, middle.phi_hat, -middle.theta_hat};
  if (elevation) return {-middle.radial, -middle.theta_hat};
  return {glm::cross(middle.phi_hat, dvec3(0.0, 0.0, 1.0)) * -1.0, middle.phi_hat};
}

dvec3 along(const std::vector<dvec3>& axes, const dvec3& vector) {
  dvec3 result(0.0);
  for (std::size_t axis = 0; axis < axes.size(); ++axis) result[static_cast<int>(axis)] = glm::dot(vector, axes[axis]);
  return result;
}

ImageSamples weighted_samples(const SweepSamples& samples, const AngleGrid& grid, const Window& window,
                              const std::vector<dvec3>& axes) {
  const std::vector<double> of_frequency = weights(window, samples.frequency.count),
                            of_theta = weights(window, grid.theta_deg.count), of_phi = weights(window, grid.phi_deg.count);
  ImageSamples result;
  for (std::size_t i = 0; i < grid.looks.size(); ++i) {
    const SweepLook& look = samples.looks[grid.looks[i]];
    const std::size_t t = i / grid.phi_deg.count;
    const double sine = grid.scan ? 1.0 : std::sin(grid.theta_deg.at(t) * degree),
                 of_angle = of_theta[t] * of_phi[i % grid.phi_deg.count];
    for (std::size_t f = 0; f < samples.frequency.count; ++f) {
      const double k = samples.wavenumber_at(f);
      // k dk dangle in the plane, k^2 sin theta dk dtheta dphi in space.
      const double volume = axes.size() == 3 ? k * k * sine : k;
      result.add(along(axes, k * (look.transmit + look.receive)), of_frequency[f] * of_angle * volume,
                 samples.s[samples.row(grid.looks[i], f)]);
    }
  }
  result.normalise();
  return result;
}

// How far the wave vectors of the sweep reach along a direction [rad/m].
double extent_along(const SweepSamples& samples, const dvec3& direction) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const SweepLook& look : samples.looks)
    for (const double k : {samples.wavenumber_at(0), samples.wavenumber_at(samples.frequency.count - 1)}) {
      const double along = k * glm::dot(look.transmit + look.receive, direction);
      least = std::min(least, along), most = std::max(most, along);
    }
  return most - least;
}

// From the step of the samples along an axis in the middle of the sweep, so many of them, their weights, and how far they reach.
ImageAxis image_axis(const dvec3& direction, double step, std::size_t count, const Window& window, double extent) {
  const auto samples = static_cast<double>(count);
  const double cell = 2.0 * pi / extent * (samples - 1.0) / samples;
  return {direction, cell, cell * peak_width(weights(window, count)), 2.0 * pi / step};
}

EvenGrid image_grid(const std::vector<ImageAxis>& axes, const IsarOptions& options, const std::string& what) {
  EvenGrid grid;
  double cells = 1.0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double size = options.frame.size[i] > 0.0 ? options.frame.size[i] : axes[i].unambiguous;
    const double count = std::ceil(size * options.pixels / axes[i].cell);
    cells *= count;
    if (!(cells <= static_cast<double>(most_image_cells)))
      throw InputError(fmt::format("{}: an image of {:g} cells, more than {}; ask for a smaller size, or for fewer pixels", what,
                                   cells, most_image_cells));
    grid.count[i] = std::max<std::size_t>(2, static_cast<std::size_t>(count));
    grid.step[i] = axes[i].cell / options.pixels;
  }
  return grid;
}

void focus_far(const ImageSamples& samples, IsarImage& image) {
  const GriddedTransform transform(image.grid, samples.wave_vectors);
  tbb::parallel_for(0, 4, [&](int channel) {
    std::vector<Complex> values;
    values.reserve(samples.s.size());
    for (std::size_t j = 0; j < samples.s.size(); ++j)
      values.push_back(samples.s[j].at(channel / 2, channel % 2) *
                       std::polar(samples.weights[j], -glm::dot(samples.wave_vectors[j], image.middle)));
    values = transform(values);
    for (std::size_t i = 0; i < values.size(); ++i) image.s[i].at(channel / 2, channel % 2) = values[i];
  });
}

// The sum over one look's frequencies for one place: its phases are in even steps.
ScatteringMatrix projected(const SweepSamples& sweep, const ImageSamples& samples, std::size_t first, double length) {
  ScatteringMatrix sum;
  Complex phase = std::polar(1.0, -sweep.wavenumber_at(0) * length);
  const Complex step = std::polar(1.0, -wavenumber(sweep.frequency.step) * length);
  for (std::size_t j = first; j < first + sweep.frequency.count; ++j, phase *= step) {
    ScatteringMatrix sample = samples.s[j];
    sum += sample *= samples.weights[j] * phase;
  }
  return sum;
}

void focus_near(const SweepSamples& sweep, const AngleGrid& grid, const ImageSamples& samples, IsarImage& image) {
  tbb::parallel_for(std::size_t{0}, image.s.size(), [&](std::size_t i) {
    const dvec3 place = image.place(i);
    for (std::size_t look = 0; look < grid.looks.size(); ++look)
      image.s[i] += projected(sweep, samples, look * sweep.frequency.count, sweep.looks[grid.looks[look]].phase_length(place));
  });
}

// |I| of one channel at a place given along the axes.
double far_amplitude(const ImageSamples& samples, int channel, const dvec3& at) {
  Complex sum = 0.0;
  for (std::size_t j = 0; j < samples.s.size(); ++j)
    sum += samples.s[j].at(channel / 2, channel % 2) * std::polar(samples.weights[j], -glm::dot(samples.wave_vectors[j], at));
  return std::abs(sum);
}

double near_amplitude(const SweepSamples& sweep, const AngleGrid& grid, const ImageSamples& samples, int channel,
                      const dvec3& place) {
  Complex sum = 0.0;
  for (std::size_t look = 0; look < grid.looks.size(); ++look)
    sum += projected(sweep, samples, look * sweep.frequency.count, sweep.looks[grid.looks[look]].phase_length(place))
               .at(channel / 2, channel % 2);
  return std::abs(sum);
}

// `amplitude`: of a channel, at a place given along the axes.
void find_peak(IsarImage& image, double pixels, const std::function<double(int, const dvec3&)>& amplitude) {
  dvec3 steps(0.0);
  for (std::size_t axis = 0; axis < image.axes.size(); ++axis) steps[static_cast<int>(axis)] = image.grid.step[axis];
  const GridPeak peak =
      highest_peak(image.s, image.grid.count, steps, pixels, [&](std::size_t sample, int channel, const dvec3& offset) {
        return amplitude(channel, image.coordinates(sample) + offset);
      });
  image.peak = {image.place_of(image.coordinates(peak.sample) + peak.offset), peak.amplitude};
}

IsarImage empty_image(const std::vector<ImageAxis>& axes, const IsarOptions& options, const std::string& what) {
  IsarImage image{.axes = axes};
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    image.middle[static_cast<int>(axis)] = glm::dot(options.frame.middle, axes[axis].direction);
  image.grid = image_grid(image.axes, options, what);
  image.s.resize(image.grid.size());
  return image;
}

// Steps along the scan are those of the middle frequency at the origin.
std::vector<ImageAxis> scan_axes(const SweepSamples& samples, const AngleGrid& grid, const Window& window) {
  const std::vector<dvec3> directions = axis_directions(grid);
  const double k = wavenumber(samples.frequency.middle()), dk = wavenumber(std::abs(samples.frequency.step)),
               range = glm::length(grid.scan->middle);
  const double nearer = std::abs(glm::dot(grid.scan->middle, directions[0])) / range;
  std::vector<ImageAxis> axes{
      image_axis(directions[0], 2.0 * dk * nearer, samples.frequency.count, window, extent_along(samples, directions[0]))};
  for (std::size_t axis = 1; axis < directions.size(); ++axis) {
    const EvenAxis& places = axis == 1 ? grid.phi_deg : grid.theta_deg;
    axes.push_back(image_axis(directions[axis], 2.0 * k * places.step / range, places.count, window,
                              extent_along(samples, directions[axis])));
  }
  return axes;
}

}  // namespace

std::vector<ImageAxis> image_axes(const SweepSamples& samples, const AngleGrid& grid, const Window& window) {
  if (grid.scan) return scan_axes(samples, grid, window);
  const std::vector<dvec3> directions = axis_directions(grid);
  const double k = wavenumber(samples.frequency.middle()), dk = wavenumber(std::abs(samples.frequency.step));
  const dvec3 middle = direction_of(grid.theta_deg.middle(), grid.phi_deg.middle());
  std::vector<ImageAxis> axes{image_axis(directions[0], 2.0 * dk * std::abs(glm::dot(middle, directions[0])),
                                         samples.frequency.count, window, extent_along(samples, directions[0]))};
  const double sine = std::sin(grid.theta_deg.middle() * degree);
  const double azimuth = 2.0 * k * sine * std::abs(grid.phi_deg.step) * degree,
               elevation = 2.0 * k * std::abs(grid.theta_deg.step) * degree;
  if (grid.phi_deg.count > 1)
    axes.push_back(image_axis(directions[1], azimuth, grid.phi_deg.count, window, extent_along(samples, directions[1])));
  if (grid.theta_deg.count > 1)
    axes.push_back(
        image_axis(directions.back(), elevation, grid.theta_deg.count, window, extent_along(samples, directions.back())));
  return axes;
}

dvec3 IsarImage::coordinates(std::size_t index) const {
  dvec3 at(0.0);
  for (std::size_t axis = axes.size(); axis-- > 0; index /= grid.count[axis])
    at[static_cast<int>(axis)] = coordinate(axis, index % grid.count[axis]);
  return at;
}

dvec3 IsarImage::place_of(const dvec3& coordinates) const {
  dvec3 at(0.0);
  for (std::size_t axis = axes.size(); axis-- > 0;) at += coordinates[static_cast<int>(axis)] * axes[axis].direction;
  return at;
}

void require_cells(const std::vector<ImageAxis>& axes, const IsarOptions& options, const std::string& what) {
  image_grid(axes, options, what);
}

void require_several(const SweepSamples& samples, const std::string& what) {
  if (samples.frequency.count > 1 && samples.looks.size() > 1) return;
  throw InputError(
      fmt::format("{} has one {}; an image needs several frequencies and several angles (raytube isar --plan SIZE "
                  "RESOLUTION writes a case)",
                  what, samples.frequency.count < 2 ? "frequency" : "look"));
}

namespace {

// The origin must not lie on the line or in the plane of the scan.
void require_sight(const AntennaScan& scan, const std::string& what) {
  constexpr double least = 1e-2;
  const double along_fast = glm::dot(scan.middle, scan.fast), along_slow = glm::dot(scan.middle, scan.slow);
  const double square = glm::dot(scan.middle, scan.middle), away = square - along_fast * along_fast - along_slow * along_slow;
  if (!(away > least * least * square))
    throw InputError(what + ": the scan runs towards the origin, so that it shows no cross-range; move it past the target");
}

}  // namespace

void require_aperture(const SweepSamples& samples, const AngleGrid& grid, const std::string& what) {
  require_several(samples, what);
  if (grid.scan) return require_sight(*grid.scan, what);
  constexpr double least_sine = 1e-2;
  const double sine = std::sin(grid.theta_deg.middle() * degree);
  if (grid.phi_deg.count > 1 && sine < least_sine)
    throw InputError(
        fmt::format("{}: at theta {:g} degrees azimuth does not turn the target to the radar; sweep theta at one phi, or take "
                    "a theta away from 0 and 180",
                    what, grid.theta_deg.middle()));
}

void ImageSamples::add(const dvec3& wave_vector, double weight, const ScatteringMatrix& value) {
  wave_vectors.push_back(wave_vector);
  weights.push_back(weight);
  s.push_back(value);
}

void ImageSamples::normalise() {
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& each : weights) each /= all;
}

IsarImage isar_image(const ImageSamples& samples, const std::vector<ImageAxis>& axes, const IsarOptions& options,
                     const std::string& what) {
  IsarImage image = empty_image(axes, options, what);
  focus_far(samples, image);
  find_peak(image, options.pixels, [&](int channel, const dvec3& at) { return far_amplitude(samples, channel, at); });
  return image;
}

IsarImage isar_image(const SweepSamples& sweep, const AngleGrid& grid, const IsarOptions& options, const std::string& what) {
  const std::vector<ImageAxis> axes = image_axes(sweep, grid, options.window);
  const ImageSamples samples = weighted_samples(sweep, grid, options.window, axis_directions(grid));
  if (sweep.looks.front().far()) return isar_image(samples, axes, options, what);
  IsarImage image = empty_image(axes, options, what);
  focus_near(sweep, grid, samples, image);
  find_peak(image, options.pixels,
            [&](int channel, const dvec3& at) { return near_amplitude(sweep, grid, samples, channel, image.place_of(at)); });
  return image;
}

}  // namespace raytube
