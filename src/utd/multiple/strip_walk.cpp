#include "utd/multiple/strip_walk.h"

#include <algorithm>
#include <cmath>

#include "utd/surface/strip_width.h"

namespace raytube {

namespace {

constexpr double root_step = 0.1;         // of the root of the wavelength, between points of a strip
constexpr double longest_step = 0.25;     // of the wavelength
constexpr double curvature_step = 0.125;  // of the wavelength, between points where the surface is asked for its curvature
constexpr double last_bend = 12.0;        // xi beyond which nothing is left
constexpr double widest = 30.0;           // of a strip's width at its edge

class StripWalk {
 public:
  StripWalk(const StripScene& scene, StripPath& path)
      : scene_(scene),
        mesh_(scene.curved->target().tracer.mesh()),
        path_(path),
        wavelength_(scene.shortest),
        lowest_(std::cbrt(2 * pi / scene.longest)) {}

  /// Fills in the strip's points; the wedge at its end.
  WedgeSide walk() {
    const CurvedFaces& faces = *scene_.curved;
    const CurvedTarget& target = faces.target();
    const WedgeFace& face = scene_.wedges[path_.wave.wedge].faces[path_.wave.face];
    const auto start = faces.at(path_.wave.wedge, path_.wave.face, path_.start);
    if (!start) return {};
    side_ = face.back ? -1.0 : 1.0;
    Geodesic geodesic(mesh_, target.surfaces, target.curvatures, target.edges, *start, path_.wave.direction);
    GeodesicPiece piece;
    while (geodesic.next(piece))
      if (!follow(target, piece)) return {};
    if (path_.nodes.empty()) return {};
    if (path_.length > path_.nodes.back().root * path_.nodes.back().root) {
      move(target, last_, last_.to);
      if (!goes_on()) return {};
      put(target, last_, last_.to);
    }
    const int corner = geodesic.ended_at();
    return corner < 0 ? WedgeSide{} : faces.at(last_.from.triangle, corner, face.back);
  }

  const dvec3& direction() const { return direction_; }

 private:
  // Points of the strip stand in steps of its own, not at the sides of facets, which may be many; nor is the surface asked for
  // its curvature at each of them.
  bool follow(const CurvedTarget& target, const GeodesicPiece& piece) {
    const Triangle& t = mesh_.triangles[piece.from.triangle];
    const dvec2 way = piece.to - piece.from.l;
    const dvec3 &x = mesh_.vertices[t[0]], &y = mesh_.vertices[t[1]], &z = mesh_.vertices[t[2]];
    const double chord = glm::length(way.x * (y - x) + way.y * (z - x));
    if (chord <= 0.0) return true;
    if (path_.nodes.empty()) {
      move(target, piece, piece.from.l);
      put(target, piece, piece.from.l);
    }
    const double turn = curvature_ * chord, length = chord * (1.0 + turn * turn / 24.0), before = path_.length;
    const double step =
        std::min(root_step * std::sqrt(wavelength_), 0.5 * longest_step * wavelength_ / std::sqrt(before + length));
    for (double root = path_.nodes.back().root + step; root * root < before + length; root += step) {
      path_.length = std::max(root * root, path_.length);
      const dvec2 l = piece.from.l + ((path_.length - before) / length) * way;
      move(target, piece, l);
      if (!goes_on()) return false;
      put(target, piece, l);
    }
    path_.length = before + length;
    if (path_.length - known_ > curvature_step * wavelength_) move(target, piece, piece.to);
    last_ = piece;
    return goes_on();
  }

  bool goes_on() const { return std::abs(width_.width) < widest && lowest_ * bend_ < last_bend; }

  void move(const CurvedTarget& target, const GeodesicPiece& piece, const dvec2& l) {
    const SurfaceFrame frame = target.curvatures.at(piece.from.triangle, l);
    const double step = path_.length - known_;
    normal_ = side_ * frame.normal;
    direction_ = glm::normalize(piece.direction - glm::dot(piece.direction, normal_) * normal_);
    curvature_ = side_ * frame.curvature(direction_);
    if (step > 0.0) width_.step(frame.gaussian(), step);
    if (curvature_ > 0.0) bend_ += step * std::cbrt(0.5 * curvature_ * curvature_);
    known_ = path_.length;
  }

  void put(const CurvedTarget& target, const GeodesicPiece& piece, const dvec2& l) {
    const dvec3 aside = glm::cross(direction_, normal_);
    path_.end = target.surfaces.facet(piece.from.triangle).point(l);
    const double sine = path_.wave.incidence.sin_cone, cosine = path_.wave.incidence.cos_cone;
    StripNode node{path_.end,
                   std::sqrt(path_.length),
                   glm::dot(scene_.look.scattered, path_.end - path_.start) - path_.length,
                   bend_,
                   std::sqrt(std::abs(width_.width)),
                   width_.caustics,
                   {},
                   {}};
    const dvec3 across = sine * direction_ - cosine * aside, along = cosine * direction_ + sine * aside;
    for (int p = 0; p < 2; ++p) {
      node.across[p] = path_.wave.sign * glm::dot(scene_.look.receive[p], across) / (2 * pi * sine);
      node.along[p] = path_.wave.sign * glm::dot(scene_.look.receive[p], along) / (2 * pi * sine * sine);
    }
    path_.nodes.push_back(node);
  }

  const StripScene& scene_;
  const TriangleMesh& mesh_;
  StripPath& path_;
  double wavelength_;   // the shortest
  double lowest_;       // cube root of the lowest wavenumber
  double known_ = 0.0;  // how far the surface is
  double side_ = 1.0, curvature_ = 0.0, bend_ = 0.0;
  StripWidth width_{1.0};
  dvec3 direction_{0.0}, normal_{0.0};
  GeodesicPiece last_{};
};

}  // namespace

StripArrival walk_strip(const StripScene& scene, StripPath& path) {
  StripWalk walk(scene, path);
  const WedgeSide at = walk.walk();
  return {at, walk.direction()};
}

}  // namespace raytube
