#include "monte_carlo.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/random.h"

namespace raytube::bench {

namespace {

constexpr std::uint64_t block_size = 2048;  // rays traced together

// Across the incident wave, along its V and H: it just holds the target. Recentred coordinates.
struct Rectangle {
  dvec3 corner, along_v, along_h;
  double area() const { return glm::length(along_v) * glm::length(along_h); }
};

Rectangle rectangle_about(const TriangleMesh& mesh, const SphericalBasis& transmit) {
  dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const dvec3& vertex : mesh.vertices) {
    const dvec2 at{glm::dot(vertex, transmit.theta_hat), glm::dot(vertex, transmit.phi_hat)};
    low = glm::min(low, at), high = glm::max(high, at);
  }
  const double before = 1.5 * mesh.radius;  // all of the target
  return {before * transmit.radial + low.x * transmit.theta_hat + low.y * transmit.phi_hat, (high.x - low.x) * transmit.theta_hat,
          (high.y - low.y) * transmit.phi_hat};
}

// One ray on its way.
struct Walk {
  Ray ray;
  double path;                 // from the front of the incident wave through the middle of the mesh [m]
  std::array<dvec3, 2> field;  // unit vectors: what V and H of unit amplitude have become
};

// All rays of one look.
class Walks {
 public:
  Walks(const Tracer& tracer, const Look& look, std::span<const double> frequencies, std::uint64_t samples)
      : tracer_(tracer),
        transmit_(spherical_basis(look.transmit)),
        receive_(spherical_basis(look.receive)),
        rectangle_(rectangle_about(tracer.mesh(), transmit_)),
        area_(rectangle_.area() / static_cast<double>(samples)) {
    for (const double frequency : frequencies) wavenumbers_.push_back(wavenumber(frequency));
    sums_.scattering.resize(frequencies.size());
  }

  void launch(const dvec2& random) {
    const dvec3 from = rectangle_.corner + random.x * rectangle_.along_v + random.y * rectangle_.along_h;
    walks_.push_back({{from, -transmit_.radial}, -glm::dot(transmit_.radial, from), {transmit_.theta_hat, transmit_.phi_hat}});
  }

  /// Follows the rays that were launched to their ends.
  void follow(int max_bounces) {
    for (int bounce = 0; bounce < max_bounces && !walks_.empty(); ++bounce) {
      std::vector<Ray> rays;
      for (const Walk& walk : walks_) rays.push_back(walk.ray);
      std::vector<Hit> hits(rays.size());
      tracer_.closest_hits(rays, hits);
      sums_.rays += rays.size();
      std::size_t alive = 0;
      for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i] && !hits[i].from_inside) walks_[alive++] = reflected(walks_[i], hits[i]);
      walks_.resize(alive);
    }
    walks_.clear();
  }

  const RaySums& sums() const { return sums_; }

 private:
  /// Adds what the current radiates where the ray lands, and sends it on.
  Walk reflected(Walk walk, const Hit& hit) {
    const std::uint32_t patch = tracer_.mesh().triangle_patch[hit.triangle];
    const dvec3 plane = tracer_.mesh().patches[patch].normal, d = walk.ray.direction;
    const dvec3 n = glm::dot(plane, d) < 0.0 ? plane : -plane;
    const dvec3 point = walk.ray.origin + hit.distance * d;
    walk.path += hit.distance;
    add(walk, n, point);
    for (dvec3& field : walk.field) field = 2.0 * glm::dot(n, field) * n - field;
    walk.ray = {point, d - 2.0 * glm::dot(n, d) * n, patch};
    return walk;
  }

  // S = -(jk / 4 pi) p_hat . eta J e^{jk (s . r - path)} times the area of the surface that the ray stands for, of the
  // physical-optics current eta J = 2 n x (s' x E) (Stratton & Chu 1939; Knott, Shaeffer & Tuley 2004, ch. 5). Valid when the
  // surface is a perfect conductor and flat over some wavelengths.
  void add(const Walk& walk, const dvec3& n, const dvec3& point) {
    const dvec3& d = walk.ray.direction;
    const double surface = -area_ / glm::dot(n, d);
    const double path =
        glm::dot(receive_.radial, point) - walk.path + glm::dot(receive_.radial + transmit_.radial, tracer_.mesh().center);
    const std::array<dvec3, 2> axes{receive_.theta_hat, receive_.phi_hat};
    std::array<std::array<double, 2>, 2> weight{};
    for (int q = 0; q < 2; ++q) {
      const dvec3 current = 2.0 * surface * glm::cross(n, glm::cross(d, walk.field[q]));
      for (int p = 0; p < 2; ++p) weight[p][q] = glm::dot(axes[p], current);
    }
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      const double k = wavenumbers_[f];
      const Complex wave = Complex(0.0, -k / (4.0 * pi)) * std::polar(1.0, k * path);
      for (const int channel : {0, 1, 2, 3})
        sums_.scattering[f].at(channel / 2, channel % 2) += weight[channel / 2][channel % 2] * wave;
    }
  }

  const Tracer& tracer_;
  SphericalBasis transmit_, receive_;
  Rectangle rectangle_;
  double area_;  // of the rectangle, for one ray [m^2]
  std::vector<double> wavenumbers_;
  std::vector<Walk> walks_;
  RaySums sums_;
};

}  // namespace

RaySums ray_sums(const Tracer& tracer, const Look& look, std::span<const double> frequencies, int max_bounces,
                 std::uint64_t samples, std::uint64_t seed, std::uint64_t stream) {
  Walks walks(tracer, look, frequencies, samples);
  for (std::uint64_t first = 0; first < samples; first += block_size) {
    for (std::uint64_t i = first; i < std::min(first + block_size, samples); ++i) walks.launch(random_point(seed, stream, i));
    walks.follow(max_bounces);
  }
  return walks.sums();
}

Runs drawn_runs(const Tracer& tracer, const Sweep& sweep, int max_bounces, const Draws& draws) {
  const std::size_t looks = sweep.looks.size(), frequencies = sweep.frequencies.size();
  Runs runs(static_cast<std::size_t>(draws.runs), std::vector<ScatteringMatrix>(sweep.rows()));
  tbb::parallel_for(std::size_t{0}, runs.size() * looks, [&](std::size_t i) {
    const std::size_t run = i / looks, look = i % looks;
    const std::uint64_t stream = std::uint64_t{run} << 32 | look;
    RaySums drawn = ray_sums(tracer, sweep.looks[look], sweep.frequencies, max_bounces, draws.samples, draws.seed, stream);
    for (ScatteringMatrix& s : drawn.scattering)
      if (!sweep.bistatic) s.at(0, 1) = s.at(1, 0) = 0.5 * (s.at(0, 1) + s.at(1, 0));
    std::ranges::copy(drawn.scattering, runs[run].begin() + static_cast<std::ptrdiff_t>(look * frequencies));
  });
  return runs;
}

Spread spread_of(const Runs& runs, std::size_t row, int receive, int transmit) {
  const auto count = static_cast<double>(runs.size());
  Spread spread;
  for (const std::vector<ScatteringMatrix>& run : runs) spread.mean += run[row].at(receive, transmit) / count;
  double squares = 0.0;
  for (const std::vector<ScatteringMatrix>& run : runs) squares += std::norm(run[row].at(receive, transmit) - spread.mean);
  spread.deviation = std::sqrt(squares / (count - 1.0));
  spread.error = spread.deviation / std::sqrt(count);
  return spread;
}

}  // namespace raytube::bench
