#include "utd/surface/geodesic_march.h"

namespace raytube {

namespace {

constexpr double widest_march = 30.0;  // of a strip's width at its start

}  // namespace

GeodesicMarch::GeodesicMarch(const CurvedTarget& target, const FacetPoint& start, const dvec3& direction, double side,
                             double sampling, const StripWidth& begin, bool at_tip)
    : target_(target),
      side_(side),
      sampling_(sampling),
      geodesic_(target.curvatures, start, direction),
      piece_{start, start.l, target.surfaces.facet(start.triangle).point(start.l), direction},
      at_(start.l),
      widest_(widest_march * begin.width),
      at_tip_(at_tip),
      width_(begin) {
  stand_at(start.l, 0.0);
}

dvec3 GeodesicMarch::position() const { return target_.surfaces.facet(piece_.from.triangle).point(at_); }

// No number is lost, too: widths at a sliver may overflow.
bool GeodesicMarch::lost() const { return !(std::abs(width_.width) < widest_); }

bool GeodesicMarch::march_to(double distance) {
  if (distance <= known_) return !lost();
  while (piece_end_ < distance) {
    if (piece_end_ - known_ > sampling_) stand_at(piece_.to, piece_end_);
    if (lost()) return false;
    if (next_piece()) continue;
    stand_at(piece_.to, piece_end_);
    return false;
  }
  const double share = (distance - piece_start_) / (piece_end_ - piece_start_);
  stand_at(glm::mix(piece_.from.l, piece_.to, share), distance);
  return !lost();
}

bool GeodesicMarch::next_piece() {
  for (dvec3 from = piece_.end; geodesic_.next(piece_); from = piece_.end) {
    const double chord = glm::distance(from, piece_.end);
    if (chord <= 0.0) continue;
    piece_start_ = piece_end_;
    piece_end_ += arc_over(chord, curvature_);
    return true;
  }
  return false;
}

void GeodesicMarch::stand_at(const dvec2& l, double distance) {
  const SurfaceFrame frame = target_.curvatures.at(piece_.from.triangle, l);
  const double step = distance - known_;
  normal_ = side_ * frame.normal;
  direction_ = glm::normalize(piece_.direction - glm::dot(piece_.direction, normal_) * normal_);
  const double curvature = side_ * frame.curvature(direction_), gaussian = frame.gaussian();
  const double last = at_tip_ ? 0.0 : 0.5;
  const double mean = glm::mix(curvature, curvature_, last), mean_gaussian = glm::mix(gaussian, gaussian_, last);
  if (step > 0.0) width_.step(mean_gaussian, step), way_.step(mean, mean_gaussian, step);
  curvature_ = curvature, gaussian_ = gaussian;
  at_tip_ = at_tip_ && step <= 0.0;
  at_ = l;
  known_ = distance;
}

}  // namespace raytube
