#include "utd/rounded/nose_table.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "math/special/elementary.h"
#include "utd/surface/noses.h"

namespace raytube {

namespace {

constexpr int radii = 12, flattenings = 25, flanks_of_arcs = 7;
constexpr double ratio = 1.6, flattening_step = 0.05, flank_step = 4 * degree;
constexpr double farthest_apex = 5.0;  // k t of arcs' tangent points: the time that modes take grows as its third power

NoseNode with_modes(const ConicSection& section) {
  const double alpha = section.interior_angle(), distance = section.tangent_distance();
  return {section, RoundedWedge(alpha, section_modes(section_of(section, 1.0), alpha, distance))};
}

double node_radius(int i) { return edge_radius * std::pow(ratio, -i); }

NoseNode conic(int i, int j) {
  const double radius = node_radius(i), flattening = least_flattening + flattening_step * j;
  const double square = (1.0 - std::pow(radius / edge_radius, 2.0 / 3)) / flattening,
               limit = std::pow(std::sin(steepest_flank), 2);
  return with_modes({radius, flattening, std::asin(std::sqrt(std::min(square, limit)))});
}

NoseNode arc(int i, int j) {
  const double radius = node_radius(i), flanks = steepest_flank - flank_step * (flanks_of_arcs - 1 - j);
  return with_modes({radius, 0.0, std::min(flanks, arc_tangent(farthest_apex / radius))});
}

// Made once for all, whoever asks first.
class Nodes {
 public:
  Nodes(NoseNode (*made)(int, int)) : made_(made) {}

  const NoseNode* at(int i, int j) {
    if (i == 0) return nullptr;
    Entry& entry = entries_[i][j];
    std::call_once(entry.once, [&] { entry.node = std::make_unique<NoseNode>(made_(i, j)); });
    return entry.node.get();
  }

 private:
  struct Entry {
    std::once_flag once;
    std::unique_ptr<NoseNode> node;
  };
  NoseNode (*made_)(int, int);
  std::array<std::array<Entry, flattenings>, radii> entries_;
};

struct Between {
  int first;
  double share;  // of the next
  Between(double place, int count) {
    const double inside = std::clamp(place, 0.0, count - 1.0);
    first = std::min(static_cast<int>(inside), count - 2);
    share = inside - first;
  }
};

std::array<NosePlace, 4> places_around(Nodes& nodes, double wavenumber_radius, const Between& shape) {
  const Between radius(std::log(edge_radius / wavenumber_radius) / std::log(ratio), radii);
  std::array<NosePlace, 4> places{};
  for (int n = 0; n < 4; ++n) {
    const int i = n / 2, j = n % 2;
    const double share = (i == 0 ? 1 - radius.share : radius.share) * (j == 0 ? 1 - shape.share : shape.share);
    places[n] = {share > 0.0 ? nodes.at(radius.first + i, shape.first + j) : nullptr, share};
  }
  return places;
}

}  // namespace

std::array<NosePlace, 4> nose_places(double wavenumber_radius, double flattening) {
  static Nodes nodes(conic);
  return places_around(nodes, wavenumber_radius, {(flattening - least_flattening) / flattening_step, flattenings});
}

std::array<NosePlace, 4> arc_places(double wavenumber_radius, double flanks) {
  static Nodes nodes(arc);
  return places_around(nodes, wavenumber_radius, {flanks_of_arcs - 1 - (steepest_flank - flanks) / flank_step, flanks_of_arcs});
}

}  // namespace raytube
