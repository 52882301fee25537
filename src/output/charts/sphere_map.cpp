#include "output/charts/sphere_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/tables/sliding_sector.h"

namespace raytube {

namespace {

constexpr double least_polar_span = 60.0;  // [degrees]
constexpr std::size_t sphere_dots_across = 600;
constexpr double graticule_step = 30.0, line_step = 2.0;  // [degrees]
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct Band {
  double low, high;  // of theta [degrees]
};

// Half a step more than the rows, up to the poles.
Band band_of(const SweepMap& map) {
  const std::vector<double>& y = map.y;
  return {std::max(0.0, y[0] - 0.5 * (y[1] - y[0])), std::min(180.0, y.back() + 0.5 * (y.back() - y[y.size() - 2]))};
}

double turned(double phi_deg) { return std::remainder(phi_deg, 360.0); }

std::vector<double> steps(double low, double high, double step) {
  std::vector<double> values = {low};
  for (double value = step * (std::floor(low / step) + 1.0); value < high; value += step) values.push_back(value);
  values.push_back(high);
  return values;
}

std::size_t nearest_polar(const std::vector<double>& y, double theta) {
  return static_cast<std::size_t>(std::ranges::min_element(y, {}, [&](double v) { return std::abs(v - theta); }) - y.begin());
}

// Azimuths ascend over no more than a turn: the neighbours of the value as it lies among them, and the two ends.
std::size_t nearest_azimuth(const std::vector<double>& x, double phi) {
  const double within = phi + 360.0 * std::ceil((x.front() - phi) / 360.0);
  const auto above = std::ranges::lower_bound(x, within);
  std::size_t best = 0;
  for (const auto candidate : {above == x.begin() ? above : above - 1, above == x.end() ? x.begin() : above, x.end() - 1}) {
    const auto i = static_cast<std::size_t>(candidate - x.begin());
    if (std::abs(turned(x[i] - phi)) < std::abs(turned(x[best] - phi))) best = i;
  }
  return best;
}

void bound(SphereMap& sphere, const Band& band) {
  sphere.low = dvec2(std::numeric_limits<double>::infinity());
  sphere.high = -sphere.low;
  for (const double theta : steps(band.low, band.high, line_step))
    for (const double phi : {-180.0, 0.0, 180.0}) {
      sphere.low = glm::min(sphere.low, hammer(theta, phi));
      sphere.high = glm::max(sphere.high, hammer(theta, phi));
    }
}

dvec2 step_of(const SphereMap& sphere) {
  return (sphere.high - sphere.low) / dvec2(static_cast<double>(sphere.across), static_cast<double>(sphere.up));
}

void fill_with_nearest(SphereMap& sphere, const SweepMap& map, const std::vector<double>& levels, const Band& band) {
  const dvec2 step = step_of(sphere);
  for (std::size_t j = 0; j < sphere.up; ++j)
    for (std::size_t i = 0; i < sphere.across; ++i) {
      const dvec2 middle(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5);
      const auto direction = from_hammer(sphere.low + middle * step);
      if (!direction || direction->x < band.low || direction->x > band.high) continue;
      sphere.dots[j * sphere.across + i] =
          levels[nearest_polar(map.y, direction->x) * map.x.size() + nearest_azimuth(map.x, direction->y)];
    }
}

void raise_to_strongest(SphereMap& sphere, const SweepMap& map, const std::vector<double>& levels) {
  for (std::size_t place = 0; place < levels.size(); ++place) {
    const dvec2 point = hammer(map.y[place / map.x.size()], turned(map.x[place % map.x.size()]));
    const dvec2 at = (point - sphere.low) / step_of(sphere);
    const auto i = static_cast<std::size_t>(std::clamp(at.x, 0.0, static_cast<double>(sphere.across - 1)));
    const auto j = static_cast<std::size_t>(std::clamp(at.y, 0.0, static_cast<double>(sphere.up - 1)));
    double& dot = sphere.dots[j * sphere.across + i];
    dot = std::fmax(dot, levels[place]);
  }
}

std::string line_point(double theta, double phi) {
  const dvec2 p = hammer(theta, phi);
  return fmt::format("{:.5f} {:.5f}\n", p.x, p.y);
}

std::string meridian(const Band& band, double phi) {
  std::string text;
  for (const double theta : steps(band.low, band.high, line_step)) text += line_point(theta, phi);
  return text + '\n';
}

std::string parallel(double theta) {
  std::string text;
  for (const double phi : steps(-180.0, 180.0, line_step)) text += line_point(theta, phi);
  return text + '\n';
}

}  // namespace

dvec2 hammer(double theta_deg, double phi_deg) {
  const double latitude = (90.0 - theta_deg) * degree, half = 0.5 * phi_deg * degree;
  const double d = std::sqrt(1.0 + std::cos(latitude) * std::cos(half));
  return {2.0 * std::sqrt(2.0) * std::cos(latitude) * std::sin(half) / d, std::sqrt(2.0) * std::sin(latitude) / d};
}

std::optional<dvec2> from_hammer(const dvec2& point) {
  const double u = point.x / 4.0, v = point.y / 2.0;
  if (u * u / 0.5 + v * v / 0.5 > 1.0) return {};
  const double z = std::sqrt(1.0 - u * u - v * v);
  const double phi = 2.0 * std::atan2(z * point.x, 2.0 * (2.0 * z * z - 1.0));
  return dvec2(90.0 - std::asin(std::clamp(z * point.y, -1.0, 1.0)) / degree, phi / degree);
}

bool covers_sphere(const SweepMap& map) {
  const bool azimuth = map.across == RowCoordinates::phi || map.across == RowCoordinates::rx_phi;
  const bool polar = map.up == RowCoordinates::theta || map.up == RowCoordinates::rx_theta;
  return azimuth && polar && goes_round(map.x) && map.y.back() - map.y.front() >= least_polar_span && map.y.front() >= 0.0 &&
         map.y.back() <= 180.0;
}

SphereMap sphere_frame(const SweepMap& map) {
  SphereMap sphere{{}, {}, sphere_dots_across, 0, {}};
  bound(sphere, band_of(map));
  sphere.up = static_cast<std::size_t>(static_cast<double>(sphere.across) / sphere.aspect());
  return sphere;
}

SphereMap sphere_map(const SweepMap& map, const std::vector<double>& levels) {
  SphereMap sphere = sphere_frame(map);
  sphere.dots.assign(sphere.across * sphere.up, unknown);
  fill_with_nearest(sphere, map, levels, band_of(map));
  raise_to_strongest(sphere, map, levels);
  return sphere;
}

std::string graticule(const SweepMap& map) {
  const Band band = band_of(map);
  std::string text;
  for (double phi = -180.0; phi <= 180.0; phi += graticule_step) text += meridian(band, phi);
  for (const double theta : steps(band.low, band.high, graticule_step)) text += parallel(theta);
  return text;
}

std::string outline(const SweepMap& map) {
  const Band band = band_of(map);
  return meridian(band, -180.0) + meridian(band, 180.0) + parallel(band.low) + parallel(band.high);
}

std::string graticule_labels(const SweepMap& map) {
  const Band band = band_of(map);
  std::string text;
  for (const double theta : steps(band.low, band.high, graticule_step)) {
    if (std::fmod(theta, graticule_step) != 0.0) continue;
    const dvec2 p = hammer(theta, -180.0);
    text += fmt::format("set label 'θ = {}°' at {:.5f},{:.5f} right offset -0.6,{} front\n", theta, p.x, p.y,
                        theta == 0.0     ? 0.5
                        : theta == 180.0 ? -0.5
                                         : 0.0);
  }
  const double along = std::clamp(120.0, band.low, band.high);  // the equator matters more
  for (double phi = -120.0; phi <= 120.0; phi += 2.0 * graticule_step) {
    const dvec2 p = hammer(along, phi);
    text += fmt::format("set label '{}{}°' at {:.5f},{:.5f} center offset 0,-0.6 front boxed font ',9'\n",
                        phi == 0.0 ? "φ = " : "", phi, p.x, p.y);
  }
  return text;
}

}  // namespace raytube
