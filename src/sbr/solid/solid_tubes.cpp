#include "sbr/solid/solid_tubes.h"

#include <algorithm>
#include <cmath>

#include "sbr/beams/current_map.h"
#include "sbr/beams/truncated_tubes.h"
#include "sbr/solid/phase_mean.h"
#include "sbr/solid/solid_ray.h"
#include "sbr/solid/tube_piece.h"

namespace raytube {

namespace {

constexpr double weakest = 1e-5;    // amplitudes that end, of unit incident ones
constexpr double widest = 1.0;      // wavelengths, of pieces that something might stand in the middle of
constexpr double most_bend = 0.1;   // phase by which a wave is off its plane within a piece [rad]
constexpr double most_turn = 0.1;   // of the rays of a piece from one another
constexpr double most_decay = 8.0;  // exponent by which a wave falls off across a piece

enum class Turn : std::uint8_t { reflected, refracted };

using Rays = std::array<SolidRay, 3>;
using Hits = std::array<SolidHit, 3>;

// A piece of a wave on its way from the surface where it took the last of these turns.
struct Tube {
  Rays rays;
  Complex spreading = 1.0;  // what geometrical optics makes of the amplitude since it was launched
  std::vector<Turn> turns{};
};

// Whether the rays of a piece run the same way.
enum class Course : std::uint8_t { none, apart, together };

double across(const dvec3& d, const dvec3& a, const dvec3& b) { return glm::dot(d, glm::cross(a, b)); }

dvec3 mean_direction(const Rays& rays) {
  return glm::normalize(rays[0].ray.direction + rays[1].ray.direction + rays[2].ray.direction);
}

// Zeros in (0, length) of the cross-section a0 + a1 s + a2 s^2 of a tube.
int caustics(double a0, double a1, double a2, double length) {
  const double half = 0.5 * a1, root = half * half - a0 * a2;
  if (root <= 0.0) return 0;
  const double q = -half - std::copysign(std::sqrt(root), half);
  const auto within = [&](double s) { return s > 0.0 && s < length ? 1 : 0; };
  return within(a0 / q) + (a2 == 0.0 ? 0 : within(q / a2));
}

// sqrt of the ratio of cross-sections, +pi/2 of phase for every line of a caustic (Kouyoumjian & Pathak 1974, eq. 6).
Complex spreading_between(const Rays& from, const Hits& to) {
  const dvec3 d = mean_direction(from);
  const dvec3 p1 = from[1].point - from[0].point, p2 = from[2].point - from[0].point;
  const dvec3 d1 = from[1].ray.direction - from[0].ray.direction, d2 = from[2].ray.direction - from[0].ray.direction;
  const double begin = across(d, p1, p2), length = (to[0].length + to[1].length + to[2].length) / 3.0;
  const double end = across(d, to[1].arriving.point - to[0].arriving.point, to[2].arriving.point - to[0].arriving.point);
  const int lines = caustics(begin, across(d, p1, d2) + across(d, d1, p2), across(d, d1, d2), length);
  constexpr std::array<Complex, 3> phase{Complex(1.0, 0.0), Complex(0.0, 1.0), Complex(-1.0, 0.0)};
  return end == 0.0 ? 0.0 : std::sqrt(std::abs(begin / end)) * phase[static_cast<std::size_t>(lines)];
}

ChannelWeights operator+(ChannelWeights a, const ChannelWeights& b) {
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) a[p][q] += b[p][q];
  return a;
}

// The frequencies [begin, end) of a look at which all materials are the same.
struct Alike {
  std::size_t begin, end;
};

bool same(const Medium& a, const Medium& b) { return a.permittivity == b.permittivity && a.permeability == b.permeability; }

bool same(const Material& material, std::size_t a, std::size_t b) {
  if (material.kind == MaterialKind::coated || material.roughness > 0.0) return false;
  return material.layers.empty() || same(material.layers[a].front().medium, material.layers[b].front().medium);
}

std::vector<Alike> alike(const SpectralSurfaces& surfaces) {
  std::vector<Alike> groups;
  const std::size_t first = surfaces.first_frequency_index;
  for (std::size_t f = 0; f < surfaces.wavenumbers.size(); ++f) {
    const auto as_before = [&](const Material& material) { return same(material, first + f - 1, first + f); };
    if (f > 0 && std::ranges::all_of(surfaces.materials, as_before))
      ++groups.back().end;
    else
      groups.push_back({f, f + 1});
  }
  return groups;
}

// The tubes of some triangles at some frequencies.
class SolidTubes {
 public:
  SolidTubes(const TubeLook& look, const Alike& frequencies, TubeSums& sums)
      : look_(look),
        waves_(look, frequencies.begin),
        frequencies_(frequencies),
        lowest_(std::ranges::min(of_group(look.wavenumbers()))),
        highest_(std::ranges::max(of_group(look.wavenumbers()))),
        narrow_(std::max(look.grid.du, look.grid.dv)),
        sums_(sums) {}

  // The wave that meets a triangle first.
  void trace(std::uint32_t triangle) {
    if (!begins_at(triangle)) return;
    triangle_ = triangle;
    std::array<dvec2, 3> corners;
    for (int c = 0; c < 3; ++c) {
      const dvec3& vertex = mesh().vertices[mesh().triangles[triangle][static_cast<std::size_t>(c)]];
      corners[static_cast<std::size_t>(c)] = {glm::dot(look_.grid.u_hat, vertex), glm::dot(look_.grid.v_hat, vertex)};
    }
    ++sums_.tubes;
    launch(whole_piece(corners));
  }

 private:
  const TriangleMesh& mesh() const { return look_.tracer.mesh(); }

  std::span<const double> of_group(std::span<const double> wavenumbers) const {
    return wavenumbers.subspan(frequencies_.begin, frequencies_.end - frequencies_.begin);
  }

  // Of a convex body only what meets a solid first can enter one.
  bool begins_at(std::uint32_t triangle) const {
    const Patch& plane = mesh().patches[mesh().triangle_patch[triangle]];
    if (mesh().closed(triangle) && glm::dot(plane.normal, look_.grid.direction) >= 0.0) return false;
    return is_solid(look_.surfaces.materials, plane.material) || !alone();
  }

  // One convex body: rays that leave it meet nothing, and nothing stands in it.
  bool alone() const { return look_.convexity.no_reflection && mesh().components.size() == 1; }

  void launch(const TubePiece& piece) {
    if (!alone() && piece.longest_side() > widest * 2.0 * pi / highest_) return launch_all(divided(piece, 0.0));
    follow(piece, launched(piece));
  }

  void launch_all(const std::vector<TubePiece>& pieces) {
    for (const TubePiece& piece : pieces) launch(piece);
  }

  Tube launched(const TubePiece& piece) const {
    return {{waves_.launched(piece.ray(0)), waves_.launched(piece.ray(1)), waves_.launched(piece.ray(2))}};
  }

  // A tube that is launched or has just taken a turn goes on to the next surface and all that it does there.
  void follow(const TubePiece& piece, const Tube& tube) {
    if (alone() && !tube.turns.empty() && tube.rays[0].material == no_index) return;
    const int bounce = static_cast<int>(tube.turns.size());
    Hits hits;
    switch (meet(piece, tube, hits)) {
      case Course::none:
        return;
      case Course::apart:
        return repeat(divided(piece, narrow_), tube.turns);
      case Course::together:
        break;
    }
    if (bounce == look_.max_bounces) return truncate(piece, tube);
    const Complex spreading = tube.spreading * spreading_between(tube.rays, hits);
    if (tube.rays[0].entered && tube.rays[0].material == no_index) add_currents(piece, hits, spreading, bounce);
    for (const Turn turn : {Turn::reflected, Turn::refracted}) turn_to(turn, piece, tube, hits, spreading);
  }

  void turn_to(Turn turn, const TubePiece& piece, const Tube& tube, const Hits& hits, const Complex& spreading) {
    Tube next = tube;
    next.turns.push_back(turn), next.spreading = spreading;
    switch (leave(turn, piece, hits, next)) {
      case Course::none:
        return;
      case Course::apart:
        return repeat(divided(piece, narrow_), next.turns);
      case Course::together:
        return go_on(piece, next, hits);
    }
  }

  // From where the tube has just taken its last turn.
  void go_on(const TubePiece& piece, const Tube& tube, const Hits& hits) {
    if (amplitude(tube.rays[0], lowest_) * std::abs(tube.spreading) < weakest) return;
    if (tube.turns.back() == Turn::refracted && tube.rays[0].material == no_index) add_leaving(piece, tube, hits);
    follow(piece, tube);
  }

  // Parts of a piece take its turns one after the other: what they do before the last has been added up.
  void repeat(const std::vector<TubePiece>& pieces, const std::vector<Turn>& turns) {
    for (const TubePiece& piece : pieces) repeat(piece, turns);
  }

  void repeat(const TubePiece& piece, const std::vector<Turn>& turns) {
    Tube tube = launched(piece);
    Hits hits;
    for (const Turn turn : turns) {
      Course course = meet(piece, tube, hits);
      const Rays before = tube.rays;
      if (course == Course::together) {
        tube.turns.push_back(turn);
        course = leave(turn, piece, hits, tube);
      }
      if (course == Course::none) return;
      if (course == Course::apart) return repeat(divided(piece, narrow_), turns);
      tube.spreading *= spreading_between(before, hits);
    }
    turns.empty() ? follow(piece, tube) : go_on(piece, tube, hits);
  }

  Course meet(const TubePiece& piece, const Tube& tube, Hits& met) {
    const std::array<Ray, 3> rays{tube.rays[0].ray, tube.rays[1].ray, tube.rays[2].ray};
    std::array<Hit, 3> hits;
    look_.tracer.closest_hits(rays, hits);
    sums_.rays += 3;
    const auto count = std::ranges::count_if(hits, [](const Hit& hit) { return bool(hit); });
    if (count == 0) return Course::none;
    if (count < 3) return Course::apart;
    if (const Course course = course_to(piece, tube, hits); course != Course::together) return course;
    for (std::size_t i = 0; i < 3; ++i) met[i] = waves_.meet(tube.rays[i], hits[i]);
    return Course::together;
  }

  // A piece begins on its own triangle: what else its rays meet has pieces of its own.
  Course course_to(const TubePiece& piece, const Tube& tube, const std::array<Hit, 3>& hits) const {
    if (!tube.turns.empty()) {
      const std::uint64_t surface = waves_.surface(hits[0].triangle);
      return waves_.surface(hits[1].triangle) == surface && waves_.surface(hits[2].triangle) == surface ? Course::together
                                                                                                        : Course::apart;
    }
    const auto own = std::ranges::count_if(hits, [&](const Hit& hit) { return hit.triangle == triangle_; });
    if (own == 3) return Course::together;
    return own == 0 && piece.longest_side() <= 4.0 * narrow_ ? Course::none : Course::apart;
  }

  Course leave(Turn turn, const TubePiece& piece, const Hits& hits, Tube& tube) {
    int count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<SolidRay> ray = turn == Turn::reflected ? waves_.reflected(hits[i]) : waves_.refracted(hits[i]);
      if (ray) tube.rays[i] = *ray, ++count;
    }
    if (count == 0) return Course::none;
    return count < 3 || (!piece.narrow() && piece.longest_side() > narrow_ && bends(tube.rays)) ? Course::apart
                                                                                                : Course::together;
  }

  // Whether the wave is no plane one as it leaves: along a side of the piece its phase is off by an eighth of the change of its
  // gradient times the side.
  bool bends(const Rays& rays) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const SolidRay &a = rays[i], &b = rays[(i + 1) % 3];
      const dvec3 turned = b.index * b.ray.direction - a.index * a.ray.direction;
      if (glm::length(b.ray.direction - a.ray.direction) > most_turn) return true;
      if (highest_ * std::abs(glm::dot(turned, b.point - a.point)) > 8.0 * most_bend) return true;
      if (highest_ * std::abs(b.loss - a.loss) > most_decay) return true;
    }
    return false;
  }

  void truncate(const TubePiece& piece, const Tube& tube) {
    count_truncated(sums_.truncated[Truncation::bounces], piece.area(), amplitude(tube.rays[0], lowest_));
  }

  // What leaves a solid, as currents on its outside (Love's principle, scene/material.h).
  void add_leaving(const TubePiece& piece, const Tube& tube, const Hits& hits) {
    std::array<ChannelWeights, 3> weights;
    for (std::size_t i = 0; i < 3; ++i)
      weights[i] = radiated(-hits[i].normal, tube.rays[i].ray.direction, tube.rays[i].field, look_.receive);
    add(piece, hits, weights, tube.spreading, static_cast<int>(tube.turns.size()) - 1);
  }

  // Of the wave that meets a surface from outside, and of what that reflects.
  void add_currents(const TubePiece& piece, const Hits& hits, const Complex& spreading, int bounce) {
    std::array<ChannelWeights, 3> weights;
    for (std::size_t i = 0; i < 3; ++i) {
      const SolidHit& hit = hits[i];
      weights[i] = radiated(hit.normal, hit.arriving.ray.direction, hit.arriving.field, look_.receive);
      if (const std::optional<SolidRay> ray = waves_.reflected(hit))
        weights[i] = weights[i] + radiated(hit.normal, ray->ray.direction, ray->field, look_.receive);
    }
    add(piece, hits, weights, spreading, bounce);
  }

  void add(const TubePiece& piece, const Hits& hits, const std::array<ChannelWeights, 3>& weights, const Complex& spreading,
           int bounce) {
    const ChannelWeights sum = weights[0] + weights[1] + weights[2];
    const dvec3 side = hits[1].arriving.point - hits[0].arriving.point, other = hits[2].arriving.point - hits[0].arriving.point;
    const double area = 0.5 * glm::length(glm::cross(side, other)) / (piece.probe * piece.probe);
    std::vector<ScatteringMatrix>& sums = sums_.at(bounce, look_.wavenumbers().size());
    for (std::size_t f = frequencies_.begin; f < frequencies_.end; ++f) {
      const double k = look_.wavenumbers()[f];
      const Complex factor = Complex(0.0, -k / (4.0 * pi)) * spreading * (area / 3.0) * mean(piece, hits, k);
      ScatteringMatrix s;
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) s.at(p, q) = factor * sum[p][q];
      sums[f] += s;
      count_error(piece, f, s);
      if (look_.map && look_.map->frequency_index() == f) add_to_map(piece, s, bounce);
    }
    ++sums_.hits[static_cast<std::size_t>(bounce)];
    sums_.meet(bounce, piece.area(), amplitude(hits[0].arriving, lowest_));
  }

  // As if the wave were the plane one of its rays all over the piece.
  Complex mean(const TubePiece& piece, const Hits& hits, double k) const {
    std::array<Complex, 3> x;
    for (std::size_t i = 0; i < 3; ++i)
      x[i] = k * Complex(glm::dot(look_.receive.radial, hits[i].arriving.point) - hits[i].arriving.path, hits[i].arriving.loss);
    const Complex middle = (x[0] + x[1] + x[2]) / 3.0;
    for (Complex& corner : x) corner = middle + (corner - middle) / piece.probe;
    return triangle_phase_mean(x);
  }

  // An edge may run anywhere through a narrow piece.
  void count_error(const TubePiece& piece, std::size_t f, const ScatteringMatrix& s) {
    if (!piece.narrow()) return;
    sums_.pieces.resize(look_.wavenumbers().size());
    ScatteringMatrix error = s;
    sums_.pieces[f].add(error *= 0.5);
  }

  void add_to_map(const TubePiece& piece, const ScatteringMatrix& s, int bounce) const {
    look_.map->set_bounce(bounce);
    look_.map->add(piece.middle(), triangle_, s);
  }

  const TubeLook& look_;
  SolidWaves waves_;
  Alike frequencies_;
  double lowest_, highest_;  // wavenumbers
  double narrow_;
  TubeSums& sums_;
  std::uint32_t triangle_ = no_index;
};

}  // namespace

TubeSums trace_solids(const TubeLook& look, std::uint32_t begin, std::uint32_t end) {
  TubeSums sums;
  for (const Alike& frequencies : alike(look.surfaces)) {
    SolidTubes tubes(look, frequencies, sums);
    for (std::uint32_t triangle = begin; triangle < end; ++triangle) tubes.trace(triangle);
  }
  return sums;
}

}  // namespace raytube
