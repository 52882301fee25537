#include "imaging/direct.h"

#include <cmath>

namespace raytube {

namespace {

// Two-way wavenumbers about the middle.
EvenGrid grid_of_frequencies(const EvenAxis& frequency) {
  EvenGrid grid;
  grid.count[0] = frequency.count, grid.step[0] = 2.0 * wavenumber(frequency.step);
  return grid;
}

SphericalBasis middle_of(const AngleGrid& angles) {
  return spherical_basis({angles.theta_deg.at(middle_index(angles.theta_deg.count)) * degree,
                          angles.phi_deg.at(middle_index(angles.phi_deg.count)) * degree});
}

// How K changes with the angles, in the order of the image's axes behind range.
struct AngleChange {
  dvec3 direction;
  EvenAxis axis;
  double length;  // of the change of the direction to the radar with the angle
};

std::vector<AngleChange> angle_changes(const AngleGrid& angles) {
  const SphericalBasis middle = middle_of(angles);
  std::vector<AngleChange> changes;
  if (angles.phi_deg.count > 1)
    changes.push_back({middle.phi_hat, angles.phi_deg, glm::length(dvec2(middle.radial.x, middle.radial.y))});
  if (angles.theta_deg.count > 1) changes.push_back({middle.theta_hat, angles.theta_deg, 1.0});
  return changes;
}

EvenGrid grid_of(const SweepSamples& sweep, const AngleGrid& angles) {
  EvenGrid grid = grid_of_frequencies(sweep.frequency);
  const double k = sweep.wavenumber_at(middle_index(sweep.frequency.count));
  std::size_t axis = 1;
  for (const AngleChange& change : angle_changes(angles)) {
    grid.count[axis] = change.axis.count;
    grid.step[axis++] = 2.0 * k * change.length * change.axis.step * degree;
  }
  return grid;
}

double offset(const EvenGrid& grid, std::size_t axis, std::size_t i) {
  return (static_cast<double>(i) - static_cast<double>(grid.count[axis] / 2)) * grid.step[axis];
}

}  // namespace

DirectSweep::DirectSweep(const EvenAxis& frequency, const dvec3& direction)
    : frequency_(frequency),
      direction_(direction),
      sums_{GriddedSum(grid_of_frequencies(frequency)), GriddedSum(grid_of_frequencies(frequency))} {}

void DirectSweep::add(const PlacedScatterer& piece) {
  sums_[piece.grows ? 1 : 0].add({-glm::dot(direction_, piece.place), 0.0, 0.0}, piece.s);
}

std::vector<ScatteringMatrix> DirectSweep::scattering() const {
  std::vector<ScatteringMatrix> s = sums_[0].at_points();
  const std::vector<ScatteringMatrix> growing = sums_[1].at_points();
  const double middle = frequency_.at(middle_index(frequency_.count));
  for (std::size_t f = 0; f < s.size(); ++f) {
    ScatteringMatrix grown = growing[f];
    s[f] += grown *= frequency_.at(f) / middle;
  }
  return s;
}

DirectImage::DirectImage(const SweepSamples& sweep, const AngleGrid& grid)
    : sweep_(sweep),
      angles_(grid),
      along_{middle_of(grid).radial},
      grid_(grid_of(sweep, grid)),
      k_(sweep.wavenumber_at(middle_index(sweep.frequency.count))),
      sums_{GriddedSum(grid_), GriddedSum(grid_)} {
  for (const AngleChange& change : angle_changes(grid)) along_.push_back(change.direction);
}

void DirectImage::add(const PlacedScatterer& piece) {
  dvec3 at(0.0);
  for (std::size_t axis = 0; axis < along_.size(); ++axis) at[static_cast<int>(axis)] = -glm::dot(along_[axis], piece.place);
  sums_[piece.grows ? 1 : 0].add(at, piece.s);
}

IsarImage DirectImage::image(const IsarOptions& options, const std::string& what) const {
  const std::vector<ImageAxis> axes = image_axes(sweep_, angles_, options.window);
  const std::vector<ScatteringMatrix> steady = sums_[0].at_points(), growing = sums_[1].at_points();
  std::array<std::vector<double>, 3> weight;
  for (std::size_t axis = 0; axis < 3; ++axis) weight[axis] = weights(options.window, grid_.count[axis]);
  ImageSamples samples;
  for (std::size_t i = 0; i < steady.size(); ++i) {
    const std::size_t c = i % grid_.count[2], b = i / grid_.count[2] % grid_.count[1], a = i / (grid_.count[1] * grid_.count[2]);
    const std::array<std::size_t, 3> at{a, b, c};
    dvec3 wave_vector = 2.0 * k_ * along_[0];
    for (std::size_t axis = 0; axis < along_.size(); ++axis) wave_vector += offset(grid_, axis, at[axis]) * along_[axis];
    ScatteringMatrix s = growing[i];
    s *= 1.0 + 0.5 * offset(grid_, 0, a) / k_;
    dvec3 on_axes(0.0);
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      on_axes[static_cast<int>(axis)] = glm::dot(wave_vector, axes[axis].direction);
    samples.add(on_axes, weight[0][a] * weight[1][b] * weight[2][c], s += steady[i]);
  }
  samples.normalise();
  return isar_image(samples, axes, options, what);
}

}  // namespace raytube
