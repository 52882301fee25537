#include "case/materials/media.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/error.h"

namespace raytube {

namespace {

constexpr double rounded_vacuum_permittivity = 8.8541878128e-12;  // [F/m], CODATA 2018

using Permittivity = std::function<Complex(double ghz)>;

struct PublishedMedium {
  std::string_view name;
  double lowest_ghz, highest_ghz;  // both included
  Permittivity permittivity;
};

Complex of_conductivity(double siemens_per_metre, double ghz) {
  return Complex(0.0, -siemens_per_metre / (2e9 * pi * ghz * rounded_vacuum_permittivity));
}

Permittivity metal(double resistivity) {
  return [=](double ghz) { return 1.0 + of_conductivity(1.0 / resistivity, ghz); };
}

// Recommendation ITU-R P.2040, section 3: eps' = a f^b and sigma = c f^d [S/m], f in GHz. Of all media here b = 0.
Permittivity itu(double a, double c, double d) {
  return [=](double ghz) { return a + of_conductivity(c * std::pow(ghz, d), ghz); };
}

struct ColeCole {
  double step, time, alpha;  // delta eps, tau [s], spread of tau
};

// Gabriel, Lau & Gabriel 1996:
// eps = eps_inf + sum of steps / (1 + (j omega tau)^(1 - alpha)) + sigma / (j omega eps_0).
Permittivity cole_cole(double infinite, std::vector<ColeCole> terms, double conductivity) {
  return [=](double ghz) {
    const auto add = [&](Complex sum, const ColeCole& term) {
      return sum + term.step / (1.0 + std::pow(Complex(0.0, 2e9 * pi * ghz * term.time), 1.0 - term.alpha));
    };
    return std::accumulate(terms.begin(), terms.end(), infinite + of_conductivity(conductivity, ghz), add);
  };
}

// Meissner & Wentz 2004, two Debye relaxations with the coefficients of their table 3, for pure water at 20 degrees Celsius.
Complex water(double ghz) {
  constexpr double t = 20.0, fixed = (3.70886e4 - 8.2168e1 * t) / (4.21854e2 + t),
                   middle = 5.7230 + 2.2379e-2 * t - 7.1237e-4 * t * t,
                   slow = (45.0 + t) / (5.0478 - 7.0315e-2 * t + 6.0059e-4 * t * t), infinite = 3.6143 + 2.8841e-2 * t,
                   fast = (45.0 + t) / (1.3652e-1 + 1.4825e-3 * t + 2.4166e-4 * t * t);  // slow and fast in GHz
  return (fixed - middle) / Complex(1.0, ghz / slow) + (middle - infinite) / Complex(1.0, ghz / fast) + infinite;
}

const std::vector<PublishedMedium>& published_media() {
  static const std::vector<PublishedMedium> all = {
      // Resistivities at 293 K: Desai, James & Ho 1984; Matula 1979; for AISI 304, which is not magnetic, ASM data sheet. Up to
      // where omega tau of good conductors is small (Drude; Ordal et al. 1983).
      {"aluminium", 0.0, 100.0, metal(2.650e-8)},
      {"copper", 0.0, 100.0, metal(1.678e-8)},
      {"stainless_steel", 0.0, 100.0, metal(7.2e-7)},
      // Recommendation ITU-R P.2040-4 (2025), table 3; of several ranges the lowest.
      {"acrylic", 110.0, 330.0, itu(2.58, 0.0001, 1.6524)},
      {"asphalt", 1.0, 40.0, itu(4.83, 0.0108, 1.3969)},
      {"brick", 1.0, 40.0, itu(3.91, 0.0238, 0.16)},
      {"ceiling_board", 1.0, 100.0, itu(1.48, 0.0011, 1.0750)},
      {"chipboard", 1.0, 100.0, itu(2.58, 0.0217, 0.7800)},
      {"concrete", 1.0, 100.0, itu(5.24, 0.0462, 0.7822)},
      {"floorboard", 50.0, 100.0, itu(3.66, 0.0044, 1.3515)},
      {"glass", 0.1, 100.0, itu(6.31, 0.0036, 1.3394)},
      {"marble", 1.0, 60.0, itu(7.074, 0.0055, 0.9262)},
      {"plasterboard", 1.0, 100.0, itu(2.73, 0.0085, 0.9395)},
      {"plywood", 1.0, 40.0, itu(2.71, 0.33, 0.0)},
      {"wood", 0.001, 100.0, itu(1.99, 0.0047, 1.0718)},
      // Gabriel, Lau & Gabriel 1996, table 1: dry skin. Its third and fourth dispersions have no step.
      {"skin", 1e-8, 100.0, cole_cole(4.0, {{32.0, 7.234e-12, 0.0}, {1100.0, 32.481e-9, 0.2}}, 0.0002)},
      {"water", 0.0, 500.0, water}};
  return all;
}

}  // namespace

std::vector<std::string> library_names() {
  std::vector<std::string> names;
  for (const PublishedMedium& entry : published_media()) names.emplace_back(entry.name);
  return names;
}

std::optional<Medium> library_medium(std::string_view name, double frequency_hz) {
  const auto found = std::ranges::find(published_media(), name, &PublishedMedium::name);
  if (found == published_media().end()) return std::nullopt;
  if (!(frequency_hz >= found->lowest_ghz * 1e9 && frequency_hz <= found->highest_ghz * 1e9))
    throw InputError(fmt::format("\"{}\" is known from {:g} to {:g} GHz, not at {:g} GHz; give the permittivity in its place",
                                 name, found->lowest_ghz, found->highest_ghz, frequency_hz * 1e-9));
  return Medium{found->permittivity(frequency_hz * 1e-9), 1.0};
}

}  // namespace raytube
