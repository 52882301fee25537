#include "utd/rounded/nose_table.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "utd/surface/noses.h"

namespace raytube {

namespace {

// Nodes of the table: k rho from edge_radius down, each by this ratio, and e from least_flattening on in such steps.
constexpr int radii = 12, flattenings = 25;
constexpr double ratio = 1.6, flattening_step = 0.05;

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

// Made once for all, whoever asks first.
class Nodes {
 public:
  const NoseNode* at(int i, int j) {
    if (i == 0) return nullptr;
    Entry& entry = entries_[i][j];
    std::call_once(entry.once, [&] { entry.node = std::make_unique<NoseNode>(conic(i, j)); });
    return entry.node.get();
  }

 private:
  struct Entry {
    std::once_flag once;
    std::unique_ptr<NoseNode> node;
  };
  std::array<std::array<Entry, flattenings>, radii> entries_;
};

struct Between {
  int first;
  double weight;  // what the node after `first` counts
  Between(double place, int count) {
    const double inside = std::clamp(place, 0.0, count - 1.0);
    first = std::min(static_cast<int>(inside), count - 2);
    weight = inside - first;
  }
};

}  // namespace

std::array<NosePlace, 4> nose_places(double wavenumber_radius, double flattening) {
  static Nodes nodes;
  const Between radius(std::log(edge_radius / wavenumber_radius) / std::log(ratio), radii);
  const Between shape((flattening - least_flattening) / flattening_step, flattenings);
  std::array<NosePlace, 4> places{};
  for (int n = 0; n < 4; ++n) {
    const int i = n / 2, j = n % 2;
    const double weight = (i == 0 ? 1 - radius.weight : radius.weight) * (j == 0 ? 1 - shape.weight : shape.weight);
    places[n] = {weight > 0.0 ? nodes.at(radius.first + i, shape.first + j) : nullptr, weight};
  }
  return places;
}

}  // namespace raytube
