#include "uncertainty/facet_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/field.h"
#include "uncertainty/constants.h"

namespace raytube {

using namespace uncertainty;

namespace {

// Of the mean depth of a parabola's chord: its largest.
constexpr double dent_over_depth = 1.5;

dvec3 bend_sum(const SmoothSurfaces& surfaces, std::uint32_t triangle) {
  return surfaces.bend(triangle, 0) + surfaces.bend(triangle, 1) + surfaces.bend(triangle, 2);
}

// The largest turning over a side [rad].
double turning(const TriangleMesh& mesh, const SmoothSurfaces& surfaces, std::uint32_t triangle) {
  double most = 0.0;
  for (int c = 0; c < 3; ++c) {
    const Triangle& t = mesh.triangles[triangle];
    const double length = glm::distance(mesh.vertices[t[c]], mesh.vertices[t[(c + 1) % 3]]);
    most = std::max(most, 2.0 * glm::length(surfaces.bend(triangle, c)) / length);
  }
  return most;
}

// Facets count by the eighth power of the cosine of their turn away from the mirror's normal.
double mirror_weight(double cosine) {
  const double square = cosine * cosine;
  return square * square * square * square;
}

}  // namespace

double chord_error(double dent, double wavelength) { return 4.0 * pi * std::sqrt(8.0 / 15.0) * dent / wavelength; }

double doubtful_crease(double min_wedge_angle) { return doubtful_turn * min_wedge_angle; }

FacetDents::FacetDents(const TriangleMesh& mesh, const SmoothSurfaces* taken, const SmoothSurfaces& meant)
    : mesh_(mesh), dents_(meant.any() ? mesh.patches.size() : 0) {
  if (dents_.empty()) return;
  constexpr double mean_height = 1.0 / 12.0;  // of the product of two barycentric coordinates
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const double area = 0.5 * mesh.twice_area(t);
    dvec3 missing(0.0);
    double depth = 0.0;
    if (meant.region(t) != no_index) missing = bend_sum(meant, t);
    if (taken && taken->region(t) != no_index) {
      missing -= bend_sum(*taken, t);
      depth = glm::length(bend_sum(*taken, t)) * bent_share * std::pow(turning(mesh, *taken, t), 1.5);
    }
    Dent& dent = dents_[mesh.triangle_patch[t]];
    dent.depth = (dent.area * dent.depth + area * mean_height * (glm::length(missing) + depth)) / (dent.area + area);
    dent.area += area;
  }
}

double FacetDents::relative_error(const Look& look, double frequency) const {
  const dvec3 middle = spherical_basis(look.transmit).radial + spherical_basis(look.receive).radial;
  const double size = glm::length(middle);
  if (dents_.empty() || size < 1e-6) return 0.0;
  const double per_metre = chord_error(dent_over_depth, wavelength(frequency)) * 0.5 * size;
  double sum = 0.0, weights = 0.0;
  for (std::size_t patch = 0; patch < dents_.size(); ++patch) {
    const Dent& dent = dents_[patch];
    const double cosine = glm::dot(mesh_.patches[patch].normal, middle) / size;
    if (cosine <= 0.0) continue;
    const double weight = dent.area * mirror_weight(cosine);
    sum += weight * std::min(most_facet_error, per_metre * dent.depth);
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

double rim_dent(std::span<const Wedge> wedges, double min_wedge_angle) {
  struct End {
    dvec3 away;
    double length;
  };
  std::map<std::tuple<double, double, double>, std::vector<End>> points;
  double all = 0.0, dents = 0.0;
  for (const Wedge& wedge : wedges) {
    const dvec3 along = glm::normalize(wedge.end - wedge.start);
    points[{wedge.start.x, wedge.start.y, wedge.start.z}].push_back({along, wedge.length()});
    points[{wedge.end.x, wedge.end.y, wedge.end.z}].push_back({-along, wedge.length()});
    all += wedge.length();
  }
  for (const auto& [point, ends] : points) {
    if (ends.size() != 2) continue;
    const double turn = 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(ends[0].away + ends[1].away)));
    const double length = 0.5 * (ends[0].length + ends[1].length);
    if (turn < doubtful_turn * min_wedge_angle) dents += length * length * turn / 8.0;
  }
  return all > 0.0 ? dents / all : 0.0;
}

}  // namespace raytube
