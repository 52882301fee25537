#include "imaging/centre_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"

namespace raytube {

namespace {

constexpr double cells_to_a_side = 2.0, most_cells = 3e7;

class CentreSearch {
 public:
  CentreSearch(const std::vector<PieceCluster>& clusters, double side) : clusters_(clusters), side_(side) {
    find_box();
    make_image();
  }

  // Places of the strongest responses, one after the other.
  std::vector<dvec3> places(std::size_t count) {
    std::vector<dvec3> found;
    for (std::size_t i = 0; i < most_looks_per_centre * count && found.size() < count; ++i) {
      const auto peak = std::ranges::max_element(image_, {}, power);
      first_power_ = std::max(first_power_, power(*peak));
      if (!(power(*peak) > least_power * first_power_)) break;
      const dvec3 at = refined(static_cast<std::size_t>(peak - image_.begin()));
      take_off(at, value_at(at));
      // What is left of one that is larger than the cube lies beside it, and is no other one.
      const bool is_new = std::ranges::none_of(found, [&](const dvec3& other) { return glm::length(at - other) < 0.5 * side_; });
      if (is_new) found.push_back(at);
    }
    return found;
  }

 private:
  static constexpr double least_power = 1e-8;  // 80 dB below the first one
  static constexpr std::size_t most_looks_per_centre = 4;

  void find_box() {
    dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const PieceCluster& each : clusters_) low = glm::min(low, each.at), high = glm::max(high, each.at);
    step_ = side_ / cells_to_a_side;
    middle_ = 0.5 * (low + high);
    double cells = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double count = std::ceil((high[axis] - low[axis]) / step_) + 5.0;
      count_[axis] = count, cells *= count;
    }
    if (!(cells <= most_cells))
      throw InputError(fmt::format("the target has {:.3g} cells of {:g} m, more than {:g}; ask for a coarser --resolution", cells,
                                   step_, most_cells));
    for (std::size_t axis = 0; axis < 3; ++axis) size_[axis] = static_cast<std::size_t>(count_[static_cast<int>(axis)]);
    image_.resize(size_[0] * size_[1] * size_[2]);
  }

  dvec3 place(std::size_t index) const {
    const dvec3 at(static_cast<double>(index / (size_[1] * size_[2])), static_cast<double>(index / size_[2] % size_[1]),
                   static_cast<double>(index % size_[2]));
    return middle_ + (at - 0.5 * (count_ - 1.0)) * step_;
  }

  // Calls visit(cell, response) for the cells that a response at `at` reaches.
  template <class Visit>
  void for_cells_about(const dvec3& at, Visit visit) {
    constexpr double reach = response_reach * cells_to_a_side;
    std::array<std::vector<double>, 3> along;
    std::array<std::size_t, 3> first{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      const double centre = (at[a] - middle_[a]) / step_ + 0.5 * (count_[a] - 1.0);
      const auto begin = static_cast<std::ptrdiff_t>(std::max(0.0, std::ceil(centre - reach)));
      const auto end =
          std::min(static_cast<std::ptrdiff_t>(size_[axis]), static_cast<std::ptrdiff_t>(std::floor(centre + reach)) + 1);
      first[axis] = static_cast<std::size_t>(begin);
      for (std::ptrdiff_t i = begin; i < end; ++i)
        along[axis].push_back(hann_response((static_cast<double>(i) - centre) * step_, side_));
    }
    for (std::size_t a = 0; a < along[0].size(); ++a)
      for (std::size_t b = 0; b < along[1].size(); ++b) {
        ScatteringMatrix* const line = image_.data() + ((first[0] + a) * size_[1] + first[1] + b) * size_[2] + first[2];
        for (std::size_t c = 0; c < along[2].size(); ++c) visit(line[c], along[0][a] * along[1][b] * along[2][c]);
      }
  }

  void add(const dvec3& at, const ScatteringMatrix& s, double sign) {
    for_cells_about(at, [&](ScatteringMatrix& cell, double response) {
      ScatteringMatrix part = s;
      cell += part *= sign * response;
    });
  }

  void make_image() {
    for (const PieceCluster& each : clusters_) add(each.at, each.s, 1.0);
  }

  void take_off(const dvec3& at, const ScatteringMatrix& s) {
    taken_.push_back({at, s});
    add(at, s, -1.0);
  }

  // Of the pieces, less what was taken off.
  ScatteringMatrix value_at(const dvec3& at) const {
    ScatteringMatrix sum;
    const auto add = [&](const dvec3& place, ScatteringMatrix s, double sign) {
      const dvec3 away = place - at;
      if (extent_of(away) < response_reach * side_) sum += s *= sign * hann_response(away, side_);
    };
    for (const PieceCluster& each : clusters_) add(each.at, each.s, 1.0);
    for (const auto& [place, s] : taken_) add(place, s, -1.0);
    return sum;
  }

  // A parabola through the levels of the cell and its neighbours, along each axis.
  dvec3 refined(std::size_t index) const {
    dvec3 at = place(index);
    const std::array<std::size_t, 3> stride{size_[1] * size_[2], size_[2], 1};
    const std::array<std::size_t, 3> cell{index / stride[0], index / stride[1] % size_[1], index % size_[2]};
    const auto level = [&](std::size_t i) { return std::log(power(image_[i]) + std::numeric_limits<double>::min()); };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cell[axis] == 0 || cell[axis] + 1 == size_[axis]) continue;
      const double before = level(index - stride[axis]), after = level(index + stride[axis]),
                   bend = before - 2.0 * level(index) + after;
      if (bend < 0.0) at[static_cast<int>(axis)] += step_ * std::clamp(0.5 * (before - after) / bend, -0.5, 0.5);
    }
    return at;
  }

  const std::vector<PieceCluster>& clusters_;
  double side_;
  dvec3 middle_{0.0}, count_{0.0};
  double step_ = 0.0, first_power_ = 0.0;
  std::array<std::size_t, 3> size_{};
  std::vector<ScatteringMatrix> image_;
  std::vector<std::pair<dvec3, ScatteringMatrix>> taken_;
};

}  // namespace

std::vector<dvec3> centre_places(const std::vector<PieceCluster>& clusters, double side, std::size_t count) {
  return CentreSearch(clusters, side).places(count);
}

}  // namespace raytube
