// A dihedral of two strips in two dimensions: geometrical-optics currents of all bounces, the illumination of each plate by the
// outer edge of the other one, fringe currents of the outer edges. All from the library's kernels; the sums over a plate are
// Gauss rules.
#pragma once

#include <vector>

#include "math/erfc_ray.h"
#include "math/gauss.h"
#include "strip_2d.h"
#include "utd/wedge/edge_wave.h"

namespace raytube::testing {

inline double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }
inline dvec2 direction_at(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// How the fringe current of an outer edge ends: not at all; at the inner edge; its inner half mirrored there; that half closed
/// at its own edge, by a factor or by the next strips.
enum class FringeEnd { untruncated, cut, mirrored, closed, linked };

/// Whose boundaries count in the illumination of the other plate.
enum class Boundaries { both, reflected };

/// Lengths in wavelengths, u is E along the inner edge (soft) or H along it (hard). Plates lie at the angles 0 and `opening` and
/// are w wide.
class Dihedral2d {
 public:
  /// One plate; the normal looks into the sector.
  struct Plate {
    dvec2 along, normal;
  };
  /// A plane wave u = amplitude e^{-jk direction.r} that lights the outer edge of a plate.
  struct EdgeLight {
    int plate;
    dvec2 direction;
    double amplitude;
  };

  Dihedral2d(double opening, double w, bool hard) : w_(w), hard_(hard) {
    const dvec2 second = direction_at(opening);
    plates_ = {Plate{{1, 0}, {0, 1}}, Plate{second, {second.y, -second.x}}};
    // Sums on one set of points: the jumps of beams and edge waves cancel there, so 3 panels of 8 points a wavelength are enough.
    const int panels = static_cast<int>(std::ceil(3 * w));
    for (int panel = 0; panel < panels; ++panel)
      for (const GaussPoint& point : gauss_rule(8))
        points_.push_back({w * (panel + point.node) / panels, w * point.weight / panels});
  }

  /// Physical optics of every bounce: a beam that leaves one plate lights a part of the other.
  Complex all_bounces(double from, double to) const {
    Complex sum = 0.0;
    for (const int start : {0, 1}) {
      Beam beam{-direction_at(from), 1.0, start, 0.0, w_};
      for (int bounce = 0; bounce < 8 && is_lit(beam); ++bounce) {
        sum += radiated(beam, to);
        beam = reflected(beam);
      }
    }
    return sum;
  }

  /// Waves that reach the outer edges: the incident one (reflections = 0), or what the other plate mirrors (1).
  std::vector<EdgeLight> edge_lights(double from, int reflections) const {
    std::vector<EdgeLight> result;
    const dvec2 incident = -direction_at(from);
    for (const int plate : {0, 1}) {
      if (reflections == 0)
        result.push_back({plate, incident, 1.0});
      else if (reaches_edge(plate, mirrored(incident, 1 - plate)))
        result.push_back({plate, mirrored(incident, 1 - plate), hard_ ? 1.0 : -1.0});
    }
    return result;
  }

  /// What the other plate radiates in the wave of a lit edge. Soft: H of the ray, or of the exact slope of the wave.
  Complex illuminated(const EdgeLight& light, double to, bool exact_slope) const {
    Complex sum = 0.0;
    const Plate& target = plates_[1 - light.plate];
    for (const GaussPoint& point : points_) {
      const dvec2 position = point.node * target.along;
      sum += point.weight * edge_current(light, position, target.normal, exact_slope, Boundaries::both) *
             phase(direction_at(to), position);
    }
    return light.amplitude * radiation(1 - light.plate, to) * sum;
  }

  /// What the edge's own plate radiates in that wave after its reflection by the other plate; with H of the ray.
  Complex illuminated_back(const EdgeLight& light, double to) const {
    const Plate &mirror = plates_[1 - light.plate], &target = plates_[light.plate];
    const dvec2 edge = w_ * target.along;
    const double height = glm::dot(edge, mirror.normal);
    Complex sum = 0.0;
    for (const GaussPoint& point : points_) {
      const dvec2 position = point.node * target.along, image = mirrored(position, 1 - light.plate), way = image - edge;
      const double reflection = glm::dot(edge - height / glm::dot(way, mirror.normal) * way, mirror.along);
      const dvec2 ray = mirrored(glm::normalize(way), 1 - light.plate);
      if (reflection <= 0.0 || reflection >= w_ || glm::dot(ray, target.normal) >= 0.0) continue;
      const Complex wave = (hard_ ? 1.0 : -1.0) * edge_wave(light, image, Boundaries::both);
      sum += point.weight * current_of(ray, target.normal) * wave * phase(direction_at(to), position);
    }
    return light.amplitude * radiation(light.plate, to) * sum;
  }

  /// Each plate in the whole field of the other one's half plane: its waves with both their boundaries, or the reflected one's
  /// alone. With a right angle the former is the same as all bounces and the illumination by both edges; else beams that return
  /// are missing, and so is what the plate beyond the inner edge, which is not there, would have to be rid of.
  Complex total_illumination(double from, double to, Boundaries boundaries) const {
    Complex sum = 0.0;
    for (const EdgeLight& light : edge_lights(from, 0)) {
      const int target = 1 - light.plate;
      for (const GaussPoint& point : points_) {
        const dvec2 position = point.node * plates_[target].along;
        const Complex current = edge_current(light, position, plates_[target].normal, true, boundaries) +
                                half_plane_optics(light, position, plates_[target].normal, boundaries);
        sum += radiation(target, to) * point.weight * current * phase(direction_at(to), position);
      }
    }
    return sum;
  }

  /// Fringe currents of a lit outer edge.
  Complex fringe(const EdgeLight& light, double to, FringeEnd end) const {
    const Plate& plate = plates_[light.plate];
    const dvec2 observer = direction_at(to), edge = w_ * plate.along;
    const double source = angle_at_edge(plate, -light.direction), mu = -glm::dot(observer, plate.along);
    const double infinity = std::numeric_limits<double>::infinity();
    Complex sum = both_sides(source, hard_, mu, end == FringeEnd::untruncated ? infinity : k * w_).radiated;
    if (end >= FringeEnd::mirrored) sum += mirrored_part(source, mu, end);
    return light.amplitude * phase(observer - light.direction, edge) * radiation(light.plate, to) * Complex(0, 2 / k) * sum;
  }

 private:
  /// A beam on its way to the part of a plate between two positions.
  struct Beam {
    dvec2 direction;
    double amplitude;
    int plate;
    double from, to;
  };

  static constexpr double k = 2 * pi;
  static Complex phase(const dvec2& direction, const dvec2& position) {
    return std::polar(1.0, k * glm::dot(direction, position));
  }

  dvec2 mirrored(const dvec2& direction, int plate) const {
    return direction - 2 * glm::dot(direction, plates_[plate].normal) * plates_[plate].normal;
  }
  bool is_lit(const Beam& beam) const {
    return beam.from < beam.to && glm::dot(beam.direction, plates_[beam.plate].normal) < -1e-12;
  }

  // A ray from t on this plate lands at t * scale on the other one.
  Beam reflected(const Beam& beam) const {
    const Plate &here = plates_[beam.plate], &there = plates_[1 - beam.plate];
    const dvec2 direction = mirrored(beam.direction, beam.plate);
    const double width = cross(direction, there.along), scale = cross(direction, here.along) / width;
    const double way = cross(here.along, there.along) / -width;
    if (!(scale > 0.0 && way > 0.0)) return {direction, 0.0, 1 - beam.plate, 0.0, 0.0};
    return {direction, hard_ ? beam.amplitude : -beam.amplitude, 1 - beam.plate, beam.from * scale,
            std::min(beam.to * scale, w_)};
  }

  Complex radiated(const Beam& beam, double to) const {
    const Plate& plate = plates_[beam.plate];
    Complex sum = 0.0;
    for (const GaussPoint& point : points_)
      if (point.node >= beam.from && point.node <= beam.to)
        sum += point.weight * phase(direction_at(to) - beam.direction, point.node * plate.along);
    return beam.amplitude * radiation(beam.plate, to) * current_of(beam.direction, plate.normal) * sum;
  }

  /// Of a plane wave u on a plate: 2u (hard); eta J of 2 n x H (soft).
  double current_of(const dvec2& direction, const dvec2& normal) const { return hard_ ? 2.0 : -2 * glm::dot(normal, direction); }
  /// Far-field amplitude of a unit of that current.
  double radiation(int plate, double to) const {
    return k / 4 * (hard_ ? glm::dot(plates_[plate].normal, direction_at(to)) : -1.0);
  }

  bool reaches_edge(int plate, const dvec2& direction) const {
    const Plate& mirror = plates_[1 - plate];
    const dvec2 edge = w_ * plates_[plate].along;
    const double way = glm::dot(edge, mirror.normal) / glm::dot(direction, mirror.normal);
    const double start = glm::dot(edge - way * direction, mirror.along);
    return glm::dot(direction, plates_[plate].normal) < 0.0 && way > 0.0 && start > 0.0 && start < w_;
  }

  /// From the plate through its sector's side.
  static double angle_at_edge(const Plate& plate, const dvec2& direction) {
    const double angle = std::atan2(glm::dot(direction, plate.normal), -glm::dot(direction, plate.along));
    return angle < 0.0 ? angle + 2 * pi : angle;
  }

  /// The edge's wave at a point, without the light's amplitude.
  Complex edge_wave(const EdgeLight& light, const dvec2& position, Boundaries boundaries) const {
    const Plate& plate = plates_[light.plate];
    const dvec2 edge = w_ * plate.along, ray = position - edge;
    const EdgeWaveTerms terms = edge_wave_terms(2.0, angle_at_edge(plate, -light.direction), angle_at_edge(plate, ray));
    const double distance = k * glm::length(ray);
    const auto wave = [&](const EdgeWaveTerm& term) { return term.strength * scaled_erfc(term.rate * std::sqrt(distance)); };
    const Complex incident = boundaries == Boundaries::both ? wave(terms.incident[0]) : 0.0, back = wave(terms.reflected[0]);
    return (incident + (hard_ ? back : -back)) * std::polar(1.0, -distance) * phase(-light.direction, edge);
  }

  /// Its current on a plate with this normal: 2 n x H (times eta if soft).
  Complex edge_current(const EdgeLight& light, const dvec2& position, const dvec2& normal, bool exact_slope,
                       Boundaries boundaries) const {
    if (hard_ || !exact_slope) {
      const dvec2 ray = glm::normalize(position - w_ * plates_[light.plate].along);
      return current_of(ray, normal) * edge_wave(light, position, boundaries);
    }
    constexpr double step = 1e-5;  // rounding of the difference 1e-11, its own error 1e-9
    const dvec2 aside = step * normal;
    const Complex rise = edge_wave(light, position + aside, boundaries) - edge_wave(light, position - aside, boundaries);
    return rise / (step * Complex(0, k));
  }

  /// The incident and the reflected wave of a half plane, each on its side of its boundary.
  Complex half_plane_optics(const EdgeLight& light, const dvec2& position, const dvec2& normal, Boundaries boundaries) const {
    const Plate& plate = plates_[light.plate];
    const double source = angle_at_edge(plate, -light.direction);
    const double observer = angle_at_edge(plate, position - w_ * plate.along);
    const dvec2 back = mirrored(light.direction, light.plate);
    Complex sum = 0.0;
    if (boundaries == Boundaries::reflected || std::cos((observer - source) / 2) > 0.0)
      sum += current_of(light.direction, normal) * phase(-light.direction, position);
    if (std::cos((observer + source) / 2) > 0.0) sum += (hard_ ? 1.0 : -1.0) * current_of(back, normal) * phase(-back, position);
    return sum;
  }

  /// What the mirrored current of the inner side adds to a kernel: it runs back from the inner edge along the same face, mu the
  /// other way.
  Complex mirrored_part(double source, double mu, FringeEnd end) const {
    const double turning = k * w_;
    const Strip inner(2.0, incidence_at(source), half_cosine_of(-mu));
    const Complex turn = std::polar(1.0, 2 * turning * mu);
    if (end == FringeEnd::closed) return closed_part(inner, turning, mu);
    const StripKernels part = piece_of(inner, turning, 2 * turning);
    if (!hard_) return -turn * part.current.soft;
    Complex sum = turn * part.current.hard;
    if (end == FringeEnd::linked) sum += turn * part.end * both_sides(0.0, true, mu, turning).radiated;
    return sum;
  }

  /// The mirrored current times the answer of its own edge to a wave that grazes it.
  Complex closed_part(const Strip& inner, double width, double mu) const {
    Complex sum = 0.0;
    for (const GaussPoint& point : gauss_rule(48)) {  // in the root of the distance, 1e-12 at 5 wavelengths
      const double distance = width * point.node * point.node, root = std::sqrt(2 * distance);
      const Complex closing = 1.0 - std::polar(1.0, -root * root) * scaled_erfc(root);
      const Complex current = 2.0 * kernels_at(inner, 2 * width - distance).end * std::polar(1.0, mu * (2 * width - distance));
      sum += point.weight * 2 * width * point.node * closing * current * std::polar(1.0, mu * distance);
    }
    return sum / Complex(0, 2);
  }

  double w_;
  bool hard_;
  std::array<Plate, 2> plates_;
  std::vector<GaussPoint> points_;
};

}  // namespace raytube::testing
