// Wedges of every angle, from a half plane to a slit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"
#include "stress/stability.h"
#include "utd/multiple/strip_kernels.h"
#include "utd/wedge/edge_currents.h"

namespace raytube::testing {
namespace {

double or_infinite(double x) { return std::isfinite(x) ? x : std::numeric_limits<double>::infinity(); }

/// Interior angles in degrees between two bounds, closer together towards both.
std::vector<double> angles(double low, double high) {
  std::vector<double> all;
  const int count = size_of_run(40, 2000);
  for (int i = 0; i <= count; ++i) all.push_back(low + (high - low) * 0.5 * (1 - std::cos(pi * i / count)));
  return all;
}

/// Edge along z, face 0 in the half plane phi = 0, faces far wider than anything.
Wedge wedge_along_z(double n) {
  const double a = n * pi;
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {-0.5 * z,
          0.5 * z,
          n,
          {WedgeFace{0, x, y, 1e30}, WedgeFace{1, std::cos(a) * x + std::sin(a) * y, std::sin(a) * x - std::cos(a) * y, 1e30}}};
}

ScatteringMatrix amplitude(double n, const Look& look) {
  const LookVectors vectors = look_vectors(look);
  const Wedge wedge = wedge_along_z(n);
  bool windowed = false;
  return amplitude_at(edge_amplitude(wedge, incidence_on(wedge, vectors.incident), vectors), 2 * pi, windowed);
}

/// Directions in front of face 0 and clear of the planes of both faces for every n of 1 to 2.
std::vector<Look> looks_at_wedge() {
  std::vector<Look> looks;
  for (const double phi : {0.3, 1.0, 1.8, 2.6})
    for (const double theta : {0.5, 1.3, 2.0}) {
      looks.push_back({{theta, phi}, {theta, phi}});
      looks.push_back({{theta, phi}, {2.2 - 0.5 * theta, phi + 0.35}});
    }
  return looks;
}

TEST(WedgeAngles, FringeAmplitudes) {
  // Away from the faces' planes the amplitude is smooth in n: its slope, some units per unit of n, times the step. At n = 1 there
  // is no edge; at n = 2 the half plane.
  double jump = 0.0, flat = 0.0, sheet = 0.0;
  for (const Look& look : looks_at_wedge()) {
    for (const double angle : angles(0.1, 179.9)) {
      const double n = 2 - angle / 180;
      if (n * pi < std::max(look.transmit.phi, look.receive.phi) + 0.05) continue;
      const ScatteringMatrix here = amplitude(n, look);
      for (const double step : {1e-12, 1e-9, 1e-6}) {
        const double change = largest_amplitude(amplitude(n - step, look) - here);
        jump = std::max(jump, or_infinite((change - 100 * step) / (1 + largest_amplitude(here))));
      }
    }
    for (const double step : {1e-12, 1e-9, 1e-6, 1e-3}) {
      flat = std::max(flat, or_infinite(largest_amplitude(amplitude(1 + step, look)) - 100 * step));
      sheet = std::max(sheet, or_infinite(largest_amplitude(amplitude(2 - step, look) - amplitude(2.0, look)) - 100 * step));
    }
  }
  expect_stable({"interior angles 0.1 ... 179.9 degrees and 1e-12 ... 1e-6 beside: change beyond slope times step",
                 "fringe amplitude of an edge", jump, 1e-10, "smooth in n; 1e-15 at cotangents of some 1e3"});
  expect_stable({"angle to 180 degrees: amplitude beyond slope times step", "the same", flat, 1e-10, "no edge, no current"});
  expect_stable({"angle to 0: change from the half plane beyond slope times step", "the same", sheet, 1e-10, "smooth in n"});
}

TEST(WedgeAngles, StripsOfEveryLength) {
  // A half plane has no local part, a wedge has: as the angle vanishes so does it.
  double worst = 0.0;
  std::vector<double> lengths;
  for (double power = -12; power <= 6; power += size_of_run(1.0, 0.1)) lengths.push_back(std::pow(10.0, power));
  lengths.push_back(std::numeric_limits<double>::infinity());
  const auto kernels = [&](double n, double source, double half_cosine) {
    FaceIncidence incidence;
    incidence.sin_cone = 1.0;
    incidence.source_angle = source;
    incidence.lit = source < pi;
    KernelBatch batch;
    Strip(n, incidence, half_cosine).at(lengths, batch);
    std::vector<StripKernels> all;
    for (std::size_t i = 0; i < lengths.size(); ++i) all.push_back(batch[i]);
    return all;
  };
  for (const double source : {0.0, 1e-5, 0.4, 1.5, 3.0})
    for (const double h : {1e-3, 0.3, 0.9, 1.0, 1.1, 20.0})
      for (const double n : {2.0, 1.9, 1.5, 1.1, 1.001}) {
        const auto here = kernels(n, source, h);
        for (const double step : {1e-12, 1e-9, 1e-6}) {
          const auto beside = kernels(n - step, source, h);
          for (std::size_t i = 0; i < here.size(); ++i) {
            const double size =
                1 + std::abs(here[i].current.hard) + std::abs(here[i].current.soft) + std::abs(here[i].current.axial);
            const double change = std::abs(here[i].current.hard - beside[i].current.hard) +
                                  std::abs(here[i].current.soft - beside[i].current.soft) + std::abs(here[i].end - beside[i].end);
            worst = worse(worst, or_infinite(change / size - 1e3 * step));
          }
        }
      }
  expect_stable({"n = 1.001 ... 2 and 1e-12 ... 1e-6 beside: change beyond slope times step", "strips of 1e-12 ... semi-infinite",
                 worst, 1e-9, "smooth in n"});
}

/// A prism 3 wavelengths long whose cross section has this interior angle at the origin, its faces there 2 wavelengths wide.
PolygonSoup prism_with_wedge(double angle, double wavelength) {
  std::vector<dvec2> outline{{0.0, 0.0}};
  const double half = angle / 2, w = 2 * wavelength;
  outline.push_back(w * dvec2(-std::cos(half), -std::sin(half)));
  if (angle > 0.9 * pi) outline.push_back(w * dvec2(-2.0, -1.2 - std::max(-std::sin(half + 0.2), 0.0)));
  if (angle > 0.9 * pi) outline.push_back(w * dvec2(-2.0, 1.2 + std::max(-std::sin(half + 0.2), 0.0)));
  outline.push_back(w * dvec2(-std::cos(half), std::sin(half)));
  return shapes::prism(outline, -1.5 * wavelength, 1.5 * wavelength);
}

struct Change {
  double infinite = 0.0, jump = 0.0;  // amplitudes that are no numbers; largest change over the peak
};

Change change_of_prism(double angle, bool thin_plates) {
  const double frequency = 10e9;
  SolveOptions o = options(EdgeMethod::fringe);
  o.tubes.mode = TubeMode::adaptive;
  o.edges.interaction = false;
  const auto solved = [&](double degrees) {
    const PolygonSoup soup = prism_with_wedge(degrees * degree, wavelength(frequency));
    return solve_soup(soup, monostatic({{1.3, 0.2}, {1.1, 1.0}, {1.5, 2.3}, {0.6, -0.4}}, frequency), o,
                      {.thin_plates = thin_plates})
        .total;
  };
  const std::vector<ScatteringMatrix> here = solved(angle), beside = solved(angle * (1 + 1e-10));
  double peak = 0.0;
  for (const ScatteringMatrix& row : here) peak = std::max(peak, largest_amplitude(row));
  Change change;
  for (std::size_t i = 0; i < here.size(); ++i) {
    change.infinite += std::isfinite(largest_amplitude(here[i])) ? 0 : 1;
    change.jump = std::max(change.jump, or_infinite(largest_amplitude(here[i] - beside[i]) / peak));
  }
  return change;
}

TEST(WedgeAngles, Bodies) {
  // The angle changes by up to 6e-10 rad, places by 2 wavelengths of that, phases by 3e-8; edges that lie nearly along a look
  // answer some times as strongly. Where the sharp edge is a thin sheet's, its strips end so close to corners that their panels
  // are laid out anew with a rounding: what their quadrature leaves shows.
  // Where the back face is a detail that the wave does not resolve strips start a hair outside of the face they run over.
  double infinite = 0.0, sharp = 0.0, thin = 0.0, unresolved = 0.0;
  for (const double angle : angles(0.1, 359.9)) {
    const Change without = change_of_prism(angle, false), with = change_of_prism(angle, true);
    infinite += without.infinite + with.infinite;
    double& kind = 4 * std::abs(std::sin(angle * degree / 2)) < 1.0 / 50 ? unresolved : sharp;
    kind = std::max(kind, without.jump);
    thin = std::max(thin, with.jump);
  }
  expect_stable({"a prism's edge of 0.1 ... 359.9 degrees: amplitudes that are no numbers", "prism, edges of order 3", infinite,
                 0.0, "counts"});
  expect_stable({"the same: change with the angle by 1e-10 of itself, over the peak", "prism, edges of order 3", sharp, 3e-7,
                 "phases 3e-8, ten times that at edges along the look"});
  expect_stable({"the same, edges so sharp that the back is narrower than wavelength / 50", "prism, edges of order 3", unresolved,
                 1e-2, "strips of unresolved edges end at other corners: 0.1 dB"});
  expect_stable({"the same, thin plates counted as such", "prism, edges of order 3", thin, 1e-3,
                 "panels of strips that end at corners of a thin-plate edge are laid out anew: 0.01 dB"});
}

}  // namespace
}  // namespace raytube::testing
