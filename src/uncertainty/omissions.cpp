#include "uncertainty/omissions.h"

#include <algorithm>
#include <cmath>

#include "uncertainty/constants.h"
#include "uncertainty/facet_error.h"

namespace raytube {

using namespace uncertainty;

namespace {

constexpr const char* falls_with_wavelength = "none; it decreases with the ratio of wavelength to target size";
constexpr std::array<OmissionText, omissions> texts = {{
    {"corners", "waves that start at corners of edges", falls_with_wavelength},
    {"edge_orders", "diffraction at more edges in a row than are followed", falls_with_wavelength},
    {"edges", "edges without currents, or with curved faces", "none; use a full-wave method"},
    {"interaction", "edge-face interaction that is not computed", "none; use a full-wave method"},
    {"cavities", "waves that were reflected more than three times", "none; use a full-wave method for the cavity"},
    {"smooth_surfaces", "creeping and travelling waves, shadow boundaries on curved surfaces",
     "none; it decreases as k times radius grows"},
    {"focusing", "waves inside of solids or shells, which focus where rays say little", "none; use a full-wave method"},
    {"facets", "flat facets in place of curved surfaces",
     "a finer mesh, or tubes.curved = \"always\", slow where curved surfaces face one another"},
    {"cut_tubes", "bounces after tubes.max_bounces, tubes too wide or too many", "a larger tubes.max_bounces"},
    {"small_target", "a target that is not large against the wavelength", "none; use a full-wave method"},
}};

double square(double x) { return x * x; }

ChannelErrors everywhere(double value) { return {{{value, value}, {value, value}}}; }

// What one channel lacks is no less than what the other of its kind has: |S_pq|, or the mean of the two co-polar or cross-polar
// channels if that is larger.
double typical(const ScatteringMatrix& s, int p, int q) {
  return std::max(std::abs(s.at(p, q)), std::sqrt(0.5 * (std::norm(s.at(p, q)) + std::norm(s.at(1 - p, 1 - q)))));
}

// The bounces first ... last - 1, of which edges take a share or put it in the place of them. Where no lobe of the reflected
// waves is seen their edges still are, which scatter evenly.
double reflected(const RowEvidence& row, std::size_t first, std::size_t last, int p, int q) {
  double squares = 0.0;
  for (std::size_t m = first; m < std::min(last, row.bounces.size()); ++m) {
    const double evenly = m < row.met.size() ? row.met[m] / (4.0 * pi) : 0.0;
    squares += std::norm(row.bounces[m].at(p, q)) + evenly;
  }
  return std::sqrt(squares);
}

// Of closed shells of sheets all that meets a surface a second time was inside.
double focused(const RowEvidence& row, int p, int q) {
  double coherent = square(typical(row.inside, p, q)), evenly = row.left_solids;
  if (row.penumbras.shells > 0.0) {
    ScatteringMatrix further;
    double met = 0.0;
    for (std::size_t m = 1; m < row.bounces.size(); ++m) further += row.bounces[m];
    for (std::size_t m = 1; m < row.met.size(); ++m) met += row.met[m];
    coherent += square(row.penumbras.shells * typical(further, p, q));
    evenly += square(row.penumbras.shells) * met;
  }
  return std::hypot(focused_share * std::sqrt(coherent), focused_amplitude * std::sqrt(evenly / (4.0 * pi)));
}

double facets(const RowEvidence& row, int p, int q) {
  if (row.bounces.empty()) return 0.0;
  const double rims = std::min(1.0, chord_error(row.rim_dent, row.wavelength)) * typical(row.edges, p, q);
  return std::hypot(row.facets * std::abs(row.bounces[0].at(p, q)), rims);
}

// Rayleigh's limit: a body of half extent a much below the wavelength has |S| about k^2 a^3, whatever it is like. Too much is as
// wrong as too little: S^2 over that limit makes the level so many decibels uncertain.
double small_target(const RowEvidence& row, int p, int q) {
  const double a = row.half_extent, k = 2.0 * pi / row.wavelength, rayleigh = k * k * a * a * a;
  const double s = std::abs(row.total().at(p, q));
  return rayleigh > 0.0 ? std::exp(-square(k * a)) * (s + rayleigh + s * s / rayleigh) : 0.0;
}

}  // namespace

const OmissionText& text_of(Omission omission) { return texts[static_cast<std::size_t>(omission)]; }

double RowEvidence::reflected_share() const {
  double share = 0.0;
  for (std::size_t m = 1; m < std::min<std::size_t>(met.size(), 3) && met[0] > 0.0; ++m) share += std::min(1.0, met[m] / met[0]);
  return share;
}

ScatteringMatrix RowEvidence::total() const {
  ScatteringMatrix sum = edges + higher + interaction + surface_waves;
  for (const ScatteringMatrix& bounce : bounces) sum += bounce;
  return sum;
}

OmissionErrors estimate_omissions(const LookFeatures& look, const RowEvidence& row) {
  OmissionErrors errors{};
  const auto at = [&](Omission omission) -> ChannelErrors& { return errors[static_cast<std::size_t>(omission)]; };
  // Seen over reflections, on the way there and back, a corner counts again.
  const double of_corner = corner_amplitude * (row.edge_order > 1 ? 1.0 : untruncated_corners) * (1.0 + row.reflected_share());
  at(Omission::corners) = everywhere(of_corner * look.corners);
  at(Omission::edges) = everywhere(edge_amplitude * look.edges);
  at(Omission::cut_tubes) = everywhere(std::sqrt(row.truncated / (4.0 * pi)));
  const double boundary = row.has_surface_waves ? wave_error : boundary_amplitude;
  const double tight = row.has_surface_waves ? tight_wave_error : boundary_amplitude;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) {
      const double higher = typical(row.higher, p, q), first = typical(row.edges, p, q);
      at(Omission::edge_orders)[p][q] = row.edge_order == 1 ? second_order * first : next_term * higher;
      const double further = row.has_interaction ? next_term * typical(row.interaction, p, q)
                                                 : row.penumbras.of_edges * reflected(row, 1, interacting_bounces, p, q);
      at(Omission::interaction)[p][q] = std::hypot(further, row.left_out);
      at(Omission::cavities)[p][q] = row.penumbras.of_edges * reflected(row, interacting_bounces, row.bounces.size(), p, q);
      at(Omission::smooth_surfaces)[p][q] =
          std::hypot(std::hypot(boundary * look.shadow_boundaries[p][q], tight * look.tight_curves, rim_amplitude * look.rims),
                     row.penumbras.of_smooth * reflected(row, 1, row.bounces.size(), p, q));
      at(Omission::focusing)[p][q] = focused(row, p, q);
      at(Omission::facets)[p][q] = facets(row, p, q);
      at(Omission::small_target)[p][q] = small_target(row, p, q);
    }
  return errors;
}

ChannelErrors root_sum_square(std::span<const ChannelErrors> errors) {
  ChannelErrors sum{};
  for (const ChannelErrors& part : errors)
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) sum[p][q] += part[p][q] * part[p][q];
  for (std::array<double, 2>& row : sum)
    for (double& value : row) value = std::sqrt(value);
  return sum;
}

}  // namespace raytube
