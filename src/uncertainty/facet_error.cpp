#include "uncertainty/facet_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/field.h"

namespace raytube {

namespace {

// Turns that may be tessellation, over those that are.
constexpr double doubtful = 2.0;
// 9.2 s / wavelength, s = 3/2 of the mean depth of a parabola's chord.
constexpr double per_depth = 13.8;
constexpr double most_error = 2.0;
constexpr double bent_share = 1.2;
// Facets count by this power of the cosine of their turn away from the mirror's normal.
constexpr int mirror_power = 8;

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

double to_power(double x, int power) {
  double product = 1.0;
  for (int i = 0; i < power; ++i) product *= x;
  return product;
}

}  // namespace

FacetDents::FacetDents(const TriangleMesh& mesh, const SmoothSurfaces* taken, double min_wedge_angle) {
  const SmoothSurfaces meant(mesh, doubtful * min_wedge_angle);
  if (!meant.any()) return;
  constexpr double mean_height = 1.0 / 12.0;  // of the product of two barycentric coordinates
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const dvec3 area = 0.5 * area_vector(mesh.vertices, mesh.triangles[t]);
    Dent dent{mesh.patches[mesh.triangle_patch[t]].normal, glm::length(area), 0.0, 0.0};
    dvec3 depth(0.0);
    if (meant.region(t) != no_index) depth = bend_sum(meant, t);
    if (taken && taken->region(t) != no_index) {
      depth -= bend_sum(*taken, t);
      dent.bent = mean_height * glm::length(bend_sum(*taken, t)) * bent_share * std::pow(turning(mesh, *taken, t), 1.5);
    }
    dent.depth = mean_height * glm::length(depth);
    dents_.push_back(dent);
  }
}

double FacetDents::relative_error(const Look& look, double frequency) const {
  const dvec3 middle = spherical_basis(look.transmit).radial + spherical_basis(look.receive).radial;
  const double size = glm::length(middle);
  if (dents_.empty() || size < 1e-6) return 0.0;
  const double per_metre = per_depth / wavelength(frequency) * 0.5 * size;
  double sum = 0.0, weights = 0.0;
  for (const Dent& dent : dents_) {
    const double cosine = glm::dot(dent.normal, middle) / size;
    if (cosine <= 0.0) continue;
    const double weight = dent.area * to_power(cosine, mirror_power);
    sum += weight * std::min(most_error, per_metre * (dent.depth + dent.bent));
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
    if (turn < doubtful * min_wedge_angle) dents += length * length * turn / 8.0;
  }
  return all > 0.0 ? dents / all : 0.0;
}

}  // namespace raytube
