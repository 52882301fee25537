#include "utd/interaction/azimuth_cuts.h"

#include <algorithm>
#include <cmath>

#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

// Cuts closer than this are one [rad]: those of a ray along which a cone is tangent to a plane are up to 5e-7 apart.
constexpr double same_azimuth = 1e-6;

class CutFinder {
 public:
  CutFinder(const TriangleMesh& mesh, std::span<const dvec3> corners, const LitEdgePiece& source,
            std::span<const AzimuthRange> wanted)
      : mesh_(mesh), corners_(corners), source_(source), end_(source.edge->wedge->n * pi), cuts_{0.0, end_} {
    if (wanted.empty()) return;
    first_ = std::ranges::min(wanted, {}, &AzimuthRange::from).from;
    last_ = std::ranges::max(wanted, {}, &AzimuthRange::to).to;
    keep(first_);
    keep(last_);
  }

  std::vector<double> find() {
    add_boundaries();
    add_corners();
    std::ranges::sort(cuts_);
    std::vector<double> kept{0.0};
    for (const double cut : cuts_)
      if (cut - kept.back() > same_azimuth && end_ - cut > same_azimuth) subdivide(kept, cut);
    subdivide(kept, end_);
    return kept;
  }

 private:
  // Panels are no wider than 0.4 rad, so that a Gauss rule sees whatever waves do between cuts.
  static void subdivide(std::vector<double>& cuts, double to) {
    const double from = cuts.back();
    const int parts = static_cast<int>(std::ceil((to - from) / 0.4));
    for (int i = 1; i < parts; ++i) cuts.push_back(from + (to - from) * i / parts);
    cuts.push_back(to);
  }

  void keep(double azimuth) {
    if (azimuth >= first_ && azimuth <= last_) cuts_.push_back(azimuth);
  }

  // Shadow and reflection boundaries: the diffracted waves jump there.
  void add_boundaries() {
    for (const double azimuth : wave_boundaries(source_.edge->wedge->n, source_.incidence.source_angle))
      if (azimuth > 0.0 && azimuth < end_) keep(azimuth);
  }

  void add_corners() {
    for (const dvec3& corner : corners_) add(corner);
    if (std::max(corners_.size(), mesh_.patches.size()) * mesh_.patches.size() > most_cuts) return;
    for (const Patch& plane : mesh_.patches) {
      add_grazing(plane.normal);
      for (const Patch& mirror : mesh_.patches)
        add_grazing(plane.normal - 2 * glm::dot(plane.normal, mirror.normal) * mirror.normal);
    }
    for (const Patch& plane : mesh_.patches)
      for (const dvec3& corner : corners_) add(corner - 2 * (glm::dot(plane.normal, corner) - plane.offset) * plane.normal);
  }

  // Where rays run along a plane: A cos(azimuth - a) = B of the components of its normal.
  void add_grazing(const dvec3& normal) {
    const WedgeFace& face = source_.edge->wedge->faces[0];
    const double x = glm::dot(normal, face.into_face), y = glm::dot(normal, face.normal);
    const double along = -glm::dot(normal, source_.edge->tangent) * source_.incidence.cos_cone;
    const double across = source_.incidence.sin_cone * std::hypot(x, y);
    // A cone that misses a plane by a share of 1e-13 of its width is tangent to it, along one ray.
    if (across < rounding_guard || std::abs(along) > across * (1.0 + 1e-13))
      return;  // at none, or at every azimuth: an upright plane
    const double middle = std::atan2(y, x), aside = std::acos(std::clamp(along / across, -1.0, 1.0));
    for (double azimuth : {middle - aside, middle + aside}) {
      azimuth -= 2 * pi * std::floor(azimuth / (2 * pi));
      if (azimuth < end_) keep(azimuth);
    }
  }

  void add(const dvec3& point) {
    const WedgeFace& face = source_.edge->wedge->faces[0];
    const dvec3 from_edge = point - source_.edge->origin;
    const double x = glm::dot(from_edge, face.into_face), y = glm::dot(from_edge, face.normal);
    if (std::hypot(x, y) < flat_fraction * mesh_.radius) return;
    const double azimuth = std::atan2(y, x);
    keep(std::clamp(azimuth < 0.0 ? azimuth + 2 * pi : azimuth, 0.0, end_));
  }

  const TriangleMesh& mesh_;
  std::span<const dvec3> corners_;
  const LitEdgePiece& source_;
  double end_, first_ = 0.0, last_ = 2 * pi;
  std::vector<double> cuts_;
};

}  // namespace

std::vector<double> azimuth_cuts(const TriangleMesh& mesh, std::span<const dvec3> corners, const LitEdgePiece& source,
                                 std::span<const AzimuthRange> wanted) {
  return CutFinder(mesh, corners, source, wanted).find();
}

}  // namespace raytube
