#include "imaging/sweep_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"

namespace raytube {

namespace {

// Of a step: decimal numbers of tables are rounded to a millionth of a degree, frequencies to a hertz.
constexpr double even_tolerance = 1e-3;

std::vector<double> without_repetitions(std::vector<double> values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// Azimuths go on over 360 degrees where the gap between two of them is wider than the one there.
std::vector<double> unwound(std::vector<double> azimuths) {
  std::size_t begin = 0;
  double widest = azimuths.front() + 360.0 - azimuths.back();
  for (std::size_t i = 1; i < azimuths.size(); ++i)
    if (const double gap = azimuths[i] - azimuths[i - 1]; gap > widest * (1.0 + even_tolerance)) widest = gap, begin = i;
  for (std::size_t i = 0; i < begin; ++i) azimuths[i] += 360.0;
  std::rotate(azimuths.begin(), azimuths.begin() + static_cast<std::ptrdiff_t>(begin), azimuths.end());
  return azimuths;
}

double median_step(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(values[i] - values[i - 1]);
  std::ranges::nth_element(steps, steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2));
  return steps[steps.size() / 2];
}

}  // namespace

EvenAxis even_axis(const std::vector<double>& values, const std::string& what, const std::string& unit) {
  EvenAxis axis{values.front(), 0.0, values.size()};
  if (values.size() < 2) return axis;
  axis.step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  const double usual = median_step(values);
  for (std::size_t i = 1; i < values.size(); ++i)
    if (const double step = values[i] - values[i - 1]; !(std::abs(step - usual) <= even_tolerance * std::abs(usual)))
      throw InputError(
          fmt::format("{} are not in even steps: from {:.9g} to {:.9g} {} it is {:.6g}, elsewhere {:.6g}; compute {:.9g} to "
                      "{:.9g} {} in even ones",
                      what, values[i - 1], values[i], unit, step, usual, values.front(), values.back(), unit));
  return axis;
}

dvec3 direction_of(double theta_deg, double phi_deg) { return spherical_basis({theta_deg * degree, phi_deg * degree}).radial; }

bool SweepLook::far() const { return std::isinf(transmit_range); }

double SweepLook::phase_length(const dvec3& r) const {
  if (far()) return glm::dot(transmit + receive, r);
  const auto nearer = [&](const dvec3& direction, double range) { return range - glm::length(range * direction - r); };
  return nearer(transmit, transmit_range) + nearer(receive, receive_range);
}

std::optional<AngleGrid> scan_grid(const std::vector<dvec3>& places) {
  if (places.size() < 3) return {};
  const dvec3 step = places[1] - places[0];
  const double near = even_tolerance * glm::length(step);
  std::size_t count = 2;
  while (count < places.size() && glm::distance(places[count] - places[count - 1], step) <= near) ++count;
  const std::size_t lines = places.size() / count;
  const dvec3 next = lines > 1 ? places[count] - places[0] : dvec3(0.0);
  if (lines * count != places.size() || std::abs(glm::dot(next, step)) > near * glm::length(next)) return {};
  AngleGrid grid{{0.0, glm::length(next), lines}, {0.0, glm::length(step), count}, {}, AntennaScan{}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const dvec3 even = static_cast<double>(i / count) * next + static_cast<double>(i % count) * step;
    if (glm::distance(places[i], places[0] + even) > near) return {};
    grid.looks.push_back(i);
  }
  grid.scan->middle = 0.5 * (places.front() + places.back());
  grid.scan->fast = glm::normalize(step);
  if (lines > 1) grid.scan->slow = glm::normalize(next);
  return grid;
}

AngleGrid angle_grid(const std::vector<std::array<double, 2>>& theta_phi_deg, const std::string& what) {
  std::map<std::array<double, 2>, std::size_t> known;
  std::vector<double> theta, phi;
  for (std::size_t i = 0; i < theta_phi_deg.size(); ++i) {
    if (!known.try_emplace(theta_phi_deg[i], i).second)
      throw InputError(fmt::format("{} is there twice: theta {:g}, phi {:g} degrees; keep one of them", what, theta_phi_deg[i][0],
                                   theta_phi_deg[i][1]));
    theta.push_back(theta_phi_deg[i][0]), phi.push_back(theta_phi_deg[i][1]);
  }
  theta = without_repetitions(std::move(theta)), phi = without_repetitions(std::move(phi));
  if (phi.size() > 1 && phi.back() - phi.front() >= 360.0)
    throw InputError(
        fmt::format("{}s in phi go round to where they began, {:g} degrees; end the sweep one step before", what, phi.back()));
  phi = unwound(std::move(phi));
  AngleGrid grid{even_axis(theta, what + "s in theta", "degrees"), even_axis(phi, what + "s in phi", "degrees"), {}, {}};
  for (const double t : theta)
    for (const double p : phi) {
      const auto found = known.find({t, known.contains({t, p}) ? p : p - 360.0});
      if (found == known.end())
        throw InputError(
            fmt::format("{} is missing: theta {:g}, phi {:g} degrees; an image needs every theta at every phi", what, t, p));
      grid.looks.push_back(found->second);
    }
  return grid;
}

}  // namespace raytube
