#include "jobs/imaged_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "imaging/isar.h"
#include "imaging/range_profile.h"
#include "output/products/isar_csv.h"
#include "scene/sampling.h"

namespace raytube {

namespace {

constexpr double room_about = 1.2;  // an image is so much wider than the target
constexpr std::size_t most_edges = 4000;

// Half of the difference of the paths to the farthest and the nearest of these points.
double depth(const SweepLook& look, std::span<const dvec3> points) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const dvec3& point : points) {
    const double length = look.phase_length(point);
    least = std::min(least, length), most = std::max(most, length);
  }
  return points.empty() ? 0.0 : 0.5 * (most - least);
}

// Along an axis of the image: how far the target reaches to either side of the origin, and how wide it is.
struct Reach {
  double half, width;
};

Reach reach_along(std::span<const dvec3> points, const dvec3& axis) {
  double low = glm::dot(points.front(), axis), high = low;
  for (const dvec3& point : points) {
    const double at = glm::dot(point, axis);
    low = std::min(low, at), high = std::max(high, at);
  }
  return {std::max(std::abs(low), std::abs(high)), high - low};
}

// The step of the samples behind an axis of the image, and its unit.
std::pair<double, const char*> step_of(const SweepSamples& samples, const AngleGrid& grid, std::size_t axis) {
  if (axis == 0) return {std::abs(samples.frequency.step) * 1e-6, "MHz"};
  const bool azimuth = axis == 1 && grid.phi_deg.count > 1;
  return {std::abs(azimuth ? grid.phi_deg.step : grid.theta_deg.step), "degrees"};
}

void require_width(const SweepSamples& samples, const AngleGrid& grid, std::size_t axis, double unambiguous, double width,
                   const std::string& what) {
  if (width <= unambiguous) return;
  const auto [step, unit] = step_of(samples, grid, axis);
  throw InputError(
      fmt::format("{}: the target is {:.3g} m wide along {}, but steps of {:.6g} {} show {:.3g} m without ambiguity; compute "
                  "steps of {:.3g} {} or less",
                  what, width, axis_name(axis), step, unit, unambiguous, step * unambiguous / width, unit));
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

void require_range(const SweepSamples& samples, std::span<const dvec3> outermost, const std::string& what) {
  require_band(samples, what);
  double deepest = 0.0;
  for (const SweepLook& look : samples.looks) deepest = std::max(deepest, depth(look, outermost));
  const double unambiguous = range_limits(samples.frequency, {}).unambiguous;
  if (deepest > unambiguous)
    throw InputError(
        fmt::format("{}: the target is {:.3g} m deep along the line of sight, but steps of {:.6g} MHz show {:.3g} m without "
                    "ambiguity; compute frequencies in steps of {:.3g} MHz or less",
                    what, deepest, std::abs(samples.frequency.step) * 1e-6, unambiguous, frequency_step_for(deepest) * 1e-6));
}

std::array<double, 3> image_size(const SweepSamples& samples, const AngleGrid& grid, const Window& window,
                                 std::span<const dvec3> outermost, std::span<const double> asked, const std::string& what) {
  require_aperture(samples, grid, what);
  std::array<double, 3> size{};
  const std::vector<ImageAxis> axes = image_axes(samples, grid, window);
  for (std::size_t axis = 0; axis < axes.size() && !outermost.empty(); ++axis) {
    const Reach reach = reach_along(outermost, axes[axis].direction);
    require_width(samples, grid, axis, axes[axis].unambiguous, reach.width, what);
    size[axis] = std::min(2.0 * room_about * reach.half + 4.0 * axes[axis].resolution, axes[axis].unambiguous);
  }
  for (std::size_t axis = 0; axis < std::min(asked.size(), axes.size()); ++axis) size[axis] = asked[axis];
  return size;
}

}  // namespace raytube
