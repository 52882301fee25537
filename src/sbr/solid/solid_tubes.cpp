#include "sbr/solid/solid_tubes.h"

#include <algorithm>
#include <cmath>

#include "sbr/beams/truncated_tubes.h"
#include "sbr/solid/solid_currents.h"
#include "sbr/solid/solid_ray.h"
#include "sbr/solid/tube_piece.h"
#include "scene/frequency_bands.h"

namespace raytube {

namespace {

constexpr double weakest = 1e-5;      // amplitudes that end, of unit incident ones
constexpr double widest = 1.0;        // wavelengths, of pieces that something might stand in the middle of
constexpr double most_bend = 0.1;     // phase by which a wave is off its plane within a piece [rad]
constexpr double most_turn = 0.1;     // of the rays of a piece from one another
constexpr double most_decay = 8.0;    // exponent by which a wave falls off across a piece
constexpr double most_spread = 1.0;   // of the rays of a piece from one another [rad], beyond which they tell nothing about it
constexpr double least_facing = 0.5;  // cosine between a piece on a curved surface and that surface, that counts

enum class Turn : std::uint8_t { reflected, refracted };

using Rays = SolidCurrents::Rays;
using Hits = SolidCurrents::Hits;

// A piece of a wave on its way from the surface where it took the last of these turns.
struct Tube {
  Rays rays;
  double section;           // twice its cross-section as it leaves
  Complex spreading = 1.0;  // what geometrical optics makes of the amplitude since it was launched
  std::vector<Turn> turns{};
};

// Whether the rays of a piece run the same way.
enum class Course : std::uint8_t { none, apart, together };

double across(const dvec3& d, const dvec3& a, const dvec3& b) { return glm::dot(d, glm::cross(a, b)); }

dvec3 mean_direction(const SolidRay& a, const SolidRay& b, const SolidRay& c) {
  return glm::normalize(a.ray.direction + b.ray.direction + c.ray.direction);
}

// Zeros in (0, length) of the cross-section a0 + a1 s + a2 s^2 of a tube.
int caustics(double a0, double a1, double a2, double length) {
  const double half = 0.5 * a1, root = half * half - a0 * a2;
  if (root <= 0.0) return 0;
  const double q = -half - std::copysign(std::sqrt(root), half);
  const auto within = [&](double s) { return s > 0.0 && s < length ? 1 : 0; };
  return within(a0 / q) + (a2 == 0.0 ? 0 : within(q / a2));
}

double twice_area(const dvec3& a, const dvec3& b, const dvec3& c) { return glm::length(glm::cross(b - a, c - a)); }

// |cos| of the angles of arrival, all in all.
double facing(const Hits& hits) {
  double sum = 0.0;
  for (const SolidHit& hit : hits) sum += std::abs(glm::dot(hit.normal, hit.arriving.ray.direction));
  return sum;
}

// Three points next to a caustic line of a curved surface may stand in any plane: what they are turned off the surface is not
// that of the tube.
double section_at(const dvec3& d, const Hits& hits) {
  const dvec3 &a = hits[0].arriving.point, &b = hits[1].arriving.point, &c = hits[2].arriving.point;
  return std::max(std::abs(across(d, b - a, c - a)), least_facing * twice_area(a, b, c) * facing(hits) / 3.0);
}

// sqrt of the ratio of cross-sections, +pi/2 of phase for every line of a caustic (Kouyoumjian & Pathak 1974, eq. 6). A surface
// passes on all of a tube: measured again from rays that are apart, its section would differ, and power come from nowhere at
// every bounce.
Complex spreading_between(const Tube& from, const Hits& to) {
  const Rays& rays = from.rays;
  const dvec3 d = mean_direction(rays[0], rays[1], rays[2]);
  const dvec3 p1 = rays[1].point - rays[0].point, p2 = rays[2].point - rays[0].point;
  const dvec3 d1 = rays[1].ray.direction - rays[0].ray.direction, d2 = rays[2].ray.direction - rays[0].ray.direction;
  const double length = (to[0].length + to[1].length + to[2].length) / 3.0, end = section_at(d, to);
  const int lines = caustics(across(d, p1, p2), across(d, p1, d2) + across(d, d1, p2), across(d, d1, d2), length);
  constexpr std::array<Complex, 3> phase{Complex(1.0, 0.0), Complex(0.0, 1.0), Complex(-1.0, 0.0)};
  return end == 0.0 ? 0.0 : std::sqrt(from.section / end) * phase[static_cast<std::size_t>(lines)];
}

// Behind a turn: a refracted tube is as much narrower as its rays are steeper on the surface.
double section_behind(const Hits& hits, const Rays& leaving) {
  double cosines = 0.0;
  for (std::size_t i = 0; i < 3; ++i) cosines += std::abs(glm::dot(hits[i].normal, leaving[i].ray.direction));
  return section_at(mean_direction(hits[0].arriving, hits[1].arriving, hits[2].arriving), hits) * cosines / facing(hits);
}

// The tubes of some triangles at some frequencies.
class SolidTubes {
 public:
  SolidTubes(const TubeLook& look, const FrequencyGroup& frequencies, TubeSums& sums)
      : look_(look),
        waves_(look, frequencies.begin),
        currents_(look, waves_, frequencies, sums),
        frequencies_(frequencies),
        lowest_(least_wavenumber(of_group(look.wavenumbers()))),
        highest_(sampling_wavenumber(of_group(look.wavenumbers()))),
        narrow_(std::max(look.grid.du, look.grid.dv)),
        sums_(sums) {}

  // The wave that meets a triangle first.
  void trace(std::uint32_t triangle) {
    if (!begins_at(triangle)) return;
    triangle_ = triangle;
    currents_.begin(triangle);
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

  // Nothing that a convex body reflects meets it again: only waves that meet a solid first can enter one.
  bool begins_at(std::uint32_t triangle) const {
    const Patch& plane = mesh().patch_of(triangle);
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
    const Rays rays{waves_.launched(piece.ray(0)), waves_.launched(piece.ray(1)), waves_.launched(piece.ray(2))};
    return {rays, twice_area(rays[0].point, rays[1].point, rays[2].point)};
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
    if (bounce == look_.max_bounces) return truncate(piece, tube, Truncation::bounces);
    const Complex spreading = tube.spreading * spreading_between(tube, hits);
    if (tube.rays[0].entered && tube.rays[0].material == no_index) currents_.add_meeting(piece, hits, spreading, bounce);
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
    if (is_too_wide(piece, tube.rays)) return truncate(piece, tube, Truncation::width);
    if (tube.turns.back() == Turn::refracted && tube.rays[0].material == no_index)
      currents_.add_leaving(piece, tube.rays, hits, tube.spreading, static_cast<int>(tube.turns.size()) - 1);
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
      if (course == Course::together) {
        tube.turns.push_back(turn);
        tube.spreading *= spreading_between(tube, hits);
        course = leave(turn, piece, hits, tube);
      }
      if (course == Course::none) return;
      if (course == Course::apart) return repeat(divided(piece, narrow_), turns);
    }
    turns.empty() ? follow(piece, tube) : go_on(piece, tube, hits);
  }

  Course meet(const TubePiece& piece, const Tube& tube, Hits& met) {
    const std::array<Ray, 3> rays{tube.rays[0].ray, tube.rays[1].ray, tube.rays[2].ray};
    std::array<Hit, 3> hits;
    look_.tracer.closest_hits(rays, hits);
    sums_.rays += 3;
    const auto count = std::ranges::count_if(hits, [](const Hit& hit) { return bool(hit); });
    for (std::size_t i = 0; i < 3; ++i)
      if (!hits[i]) sums_.lose_if_stray(rays[i], mesh());
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
    tube.section = section_behind(hits, tube.rays);
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

  // Whether the rays of a narrow piece diverge too much, at its own corners.
  static bool is_too_wide(const TubePiece& piece, const Rays& rays) {
    for (std::size_t i = 0; i < 3; ++i)
      if (glm::length(rays[(i + 1) % 3].ray.direction - rays[i].ray.direction) > most_spread * piece.probe) return true;
    return false;
  }

  void truncate(const TubePiece& piece, const Tube& tube, Truncation reason) {
    count_truncated(sums_.truncated[reason], piece.area(), amplitude(tube.rays[0], lowest_));
  }

  const TubeLook& look_;
  SolidWaves waves_;
  SolidCurrents currents_;
  FrequencyGroup frequencies_;
  double lowest_, highest_;  // wavenumbers
  double narrow_;
  TubeSums& sums_;
  std::uint32_t triangle_ = no_index;
};

}  // namespace

TubeSums trace_solids(const TubeLook& look, std::uint32_t begin, std::uint32_t end) {
  TubeSums sums;
  for (const FrequencyGroup& frequencies : frequency_groups(look.surfaces)) {
    SolidTubes tubes(look, frequencies, sums);
    for (std::uint32_t triangle = begin; triangle < end; ++triangle) tubes.trace(triangle);
  }
  return sums;
}

}  // namespace raytube
