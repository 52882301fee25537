#include "jobs/path_samples.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace raytube {

namespace {

// Of the wavelength: by so much places are sampled beyond a box, as amplitudes change with the direction of the path.
constexpr double beyond_box = 0.25;

// Numbers from 0 to 1 that fill a cube evenly as i goes on: multiples of the roots of primes without their integers (Weyl 1916,
// Math. Annalen 77, 313), one after the other.
class Draws {
 public:
  explicit Draws(std::size_t i) : i_(static_cast<double>(i + 1)) {}

  double next() {
    constexpr std::array primes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71};
    const double multiple = i_ * std::sqrt(primes.at(taken_++));
    return multiple - std::floor(multiple);
  }

 private:
  double i_;
  std::size_t taken_ = 0;
};

// More of them near the sides of the box, whose paths are the shortest and the longest.
dvec3 place(const Box& box, Draws& draws, double k) {
  const double beyond = beyond_box * 2.0 * pi / k;
  dvec3 at;
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = std::lerp(box.low[axis] - beyond, box.high[axis] + beyond, 0.5 - 0.5 * std::cos(pi * draws.next()));
  return at;
}

}  // namespace

PathSamples::PathSamples(const Case& c, const MovingTarget& target) : c_(c), parts_(target.rigid_parts()) {
  for (std::size_t pulse = 0; pulse < c.times(); ++pulse) {
    std::vector<dvec3> middles;
    for (const MovingTarget::RigidPart& part : parts_) {
      const Pose pose = target.pose_of_part(part, c.sweep.times[pulse * looks()]);
      Box box;
      for (const dvec3& corner : corners_of(part.box)) box.add(pose(corner));
      poses_.push_back(pose), boxes_.push_back(box), middles.push_back(pose(part.box.middle()));
    }
    for (std::size_t of = 0; of < looks(); ++of) {
      const Look& look = c.sweep.looks[pulse * looks() + of];
      ends_.push_back({Ways(look), spherical_basis(look.transmit), spherical_basis(look.receive)});
      double sum = 0.0;
      for (const dvec3& middle : middles) sum += ends_.back().ways.over(middle);
      mean_paths_.push_back(sum / static_cast<double>(parts_.size()));
    }
  }
  find_ways();
}

Complex PathSamples::mean_phasor(std::size_t pulse, std::size_t look, double k) const {
  const std::size_t at = pulse * looks() + look;
  return std::polar(1.0, k * (ends_[at].ways.over(dvec3(0.0)) - mean_paths_[at]));
}

std::vector<Complex> PathSamples::columns(std::size_t begin, std::size_t end, std::size_t first, std::size_t count) const {
  const std::size_t pulses = end - begin;
  std::vector<Complex> values(pulses * count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const Sample sample = drawn(first + i);
    const std::span<Complex> column = std::span(values).subspan(i * pulses, pulses);
    double squares = 0.0;
    for (std::size_t pulse = begin; pulse < end; ++pulse) {
      const double phase = sample.k * (mean_paths_[pulse * looks() + sample.look] - path(sample, pulse));
      column[pulse - begin] = std::polar(1.0, phase) * polarisation(sample, pulse);
      squares += std::norm(column[pulse - begin]);
    }
    if (squares > 0.0)
      for (Complex& value : column) value *= std::sqrt(static_cast<double>(pulses) / squares);
  });
  return values;
}

// Over one part, from one to another, and back; from one place to another of one part where that is not as over a place
// between: by way of a ground, and where transmitter and receiver are apart.
void PathSamples::find_ways() {
  for (std::size_t a = 0; a < parts_.size(); ++a) {
    ways_.push_back({a});
    if (c_.ground || c_.sweep.bistatic) ways_.push_back({a, a});
    for (std::size_t b = a + 1; b < parts_.size(); ++b) {
      ways_.push_back({a, b});
      if (c_.sweep.bistatic) ways_.push_back({b, a});
      if (c_.tubes.max_bounces > 2 && ever_near(a, b)) ways_.insert(ways_.end(), {{a, b, a}, {b, a, b}});
    }
  }
}

// Whether at any time they are within the distance to which the smaller one, flat and of the diagonal D, sends a beam no wider
// than itself, D^2 / wavelength: else little gets from one to the other and back.
bool PathSamples::ever_near(std::size_t a, std::size_t b) const {
  const double narrow = std::min(parts_[a].box.diagonal(), parts_[b].box.diagonal()),
               reach = narrow * narrow / wavelength(std::ranges::max(c_.sweep.frequencies));
  for (std::size_t first = 0; first < boxes_.size(); first += parts_.size()) {
    const Box &at_a = boxes_[first + a], &at_b = boxes_[first + b];
    if (glm::length(glm::max(dvec3(0.0), glm::max(at_a.low - at_b.high, at_b.low - at_a.high))) < reach) return true;
  }
  return false;
}

PathSamples::Sample PathSamples::drawn(std::size_t i) const {
  const auto [lowest, highest] = std::ranges::minmax(c_.sweep.frequencies);
  Draws draws(i / kinds());
  const auto by_ground = [&] { return c_.ground && draws.next() < 0.5; };
  const auto direction = [&] {
    const double z = 2.0 * draws.next() - 1.0, azimuth = 2.0 * pi * draws.next(), across = std::sqrt(1.0 - z * z);
    return dvec3(across * std::cos(azimuth), across * std::sin(azimuth), z);
  };
  Sample sample{.look = i / ways_.size() % looks(),
                .k = wavenumber(std::lerp(lowest, highest, draws.next())),
                .stops = {},
                .leaves_by_ground = by_ground(),
                .channel = {pi * draws.next(), pi * draws.next()},
                .on_the_body = {direction(), direction()}};
  for (const std::size_t part : ways_[i % ways_.size()]) {
    const bool mirrored = by_ground();
    sample.stops.push_back({part, place(parts_[part].box, draws, sample.k), mirrored});
  }
  return sample;
}

double PathSamples::path(const Sample& sample, std::size_t pulse) const {
  const Ways& ways = ends_[pulse * looks() + sample.look].ways;
  const auto mirrored = [&](const dvec3& r, bool by_ground) {
    return by_ground ? dvec3(r.x, r.y, 2.0 * c_.ground->height - r.z) : r;
  };
  double way = 0.0;
  dvec3 at{0.0};
  for (const Stop& stop : sample.stops) {
    const dvec3 next = poses_[pulse * parts_.size() + stop.part](stop.at_rest), seen = mirrored(next, stop.by_ground);
    way += &stop == &sample.stops.front() ? ways.to(seen) : glm::distance(at, seen);
    at = next;
  }
  return way + ways.from(mirrored(at, sample.leaves_by_ground));
}

// Amplitudes are linear in the fields of transmitter and receiver as the body sees them, which turn with it.
double PathSamples::polarisation(const Sample& sample, std::size_t pulse) const {
  const Ends& ends = ends_[pulse * looks() + sample.look];
  const auto turned = [&](const Stop& stop, const SphericalBasis& basis, std::size_t end) {
    const double angle = sample.channel[end];
    return glm::dot(std::cos(angle) * basis.theta_hat + std::sin(angle) * basis.phi_hat,
                    poses_[pulse * parts_.size() + stop.part].turn * sample.on_the_body[end]);
  };
  return turned(sample.stops.front(), ends.transmit, 0) * turned(sample.stops.back(), ends.receive, 1);
}

}  // namespace raytube
