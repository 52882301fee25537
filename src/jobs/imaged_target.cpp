#include "jobs/imaged_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "imaging/range_profile.h"
#include "output/products/isar_csv.h"
#include "scene/sampling.h"

namespace raytube {

namespace {

constexpr double room_about = 1.2;  // an image is so much wider than the target
constexpr std::size_t most_edges = 4000;
constexpr double printed = 1e-3;  // lengths are printed rounded by less than this share

struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
  double width() const { return high - low; }
  double middle() const { return 0.5 * (low + high); }
};

// The step of the samples behind an axis of the image, and its unit.
std::pair<double, const char*> step_of(const SweepSamples& samples, const AngleGrid& grid, std::size_t axis) {
  if (axis == 0) return {std::abs(samples.frequency.step) * 1e-6, "MHz"};
  const bool azimuth = axis == 1 && grid.phi_deg.count > 1;
  if (grid.scan) return {azimuth ? grid.phi_deg.step : grid.theta_deg.step, "m"};
  return {std::abs(azimuth ? grid.phi_deg.step : grid.theta_deg.step), "degrees"};
}

// To three digits, so that a step which is taken as it is printed will do.
double rounded_down(double number) {
  const double digit = std::pow(10.0, std::floor(std::log10(number)) - 2.0);
  return std::floor(number / digit * (1.0 + 1e-9)) * digit;
}

// `subject`: what is so wide.
void require_width(const SweepSamples& samples, const AngleGrid& grid, std::size_t axis, double unambiguous, double width,
                   const std::string& subject) {
  if (width <= unambiguous) return;
  const auto [step, unit] = step_of(samples, grid, axis);
  throw InputError(
      fmt::format("{} is {:.3g} m wide along {}, but steps of {:.6g} {} show {:.3g} m without ambiguity; compute steps of {:.3g} "
                  "{} or less",
                  subject, width, axis_name(axis), step, unit, unambiguous, rounded_down(step * unambiguous / width), unit));
}

}  // namespace

std::vector<dvec3> outermost_of(const Target& target) {
  std::vector<dvec3> points = outermost_points(target.mesh.vertices);
  for (dvec3& point : points) point += target.mesh.center;
  return points;
}

std::vector<std::array<dvec3, 2>> lines_of(const Target& target) {
  std::vector<Wedge> wedges = target.wedges;
  std::ranges::stable_sort(wedges, std::ranges::greater{}, &Wedge::length);
  std::vector<std::array<dvec3, 2>> lines;
  for (std::size_t i = 0; i < std::min(wedges.size(), most_edges); ++i)
    lines.push_back({wedges[i].start + target.mesh.center, wedges[i].end + target.mesh.center});
  return lines;
}

double middle_range(const SweepSamples& samples, std::span<const dvec3> outermost, const std::string& what) {
  require_band(samples, what);
  if (outermost.empty()) return 0.0;
  Span all;
  for (const SweepLook& look : samples.looks)
    for (const dvec3& point : outermost) all.add(-0.5 * look.phase_length(point));
  const double unambiguous = range_limits(samples.frequency, {}).unambiguous;
  if (all.width() > unambiguous)
    throw InputError(
        fmt::format("{}: the target lies within {:.3g} m of range, over all looks, but steps of {:.6g} MHz show {:.3g} m without "
                    "ambiguity; compute frequencies in steps of {:.3g} MHz or less",
                    what, all.width(), std::abs(samples.frequency.step) * 1e-6, unambiguous,
                    rounded_down(frequency_step_for(all.width()) * 1e-6)));
  return all.middle();
}

ImageFrame image_frame(const SweepSamples& samples, const AngleGrid& grid, const Window& window, std::span<const dvec3> outermost,
                       std::span<const double> asked, const std::string& what) {
  require_aperture(samples, grid, what);
  ImageFrame frame;
  const std::vector<ImageAxis> axes = image_axes(samples, grid, window);
  for (std::size_t axis = 0; axis < axes.size() && !outermost.empty(); ++axis) {
    Span span;
    for (const dvec3& point : outermost) span.add(glm::dot(point, axes[axis].direction));
    require_width(samples, grid, axis, axes[axis].unambiguous, span.width(), what + ": the target");
    frame.middle += span.middle() * axes[axis].direction;
    frame.size[axis] = std::min(room_about * span.width() + 4.0 * axes[axis].resolution, axes[axis].unambiguous);
  }
  for (std::size_t axis = 0; axis < std::min(asked.size(), axes.size()); ++axis) {
    if (asked[axis] > (1.0 + printed) * axes[axis].unambiguous)
      require_width(samples, grid, axis, axes[axis].unambiguous, asked[axis], what + ": the image asked for");
    frame.size[axis] = asked[axis];
  }
  return frame;
}

}  // namespace raytube
