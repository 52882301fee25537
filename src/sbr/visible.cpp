#include "sbr/visible.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace raytube {

namespace {

// Up to so many faces are compared each with each; beyond, each one asks the tree who stands in front of it.
constexpr std::size_t few = 32;
// A face with more than this in front of it is halved first.
constexpr std::size_t many = 48;
// Seen closer to its own plane than this, a face has no area.
constexpr double edge_on = 1e-12;

Affine depth_of(const Beam& beam, const Patch& plane) {
  const double scale = 1.0 / glm::dot(plane.normal, beam.direction);
  return {(plane.offset - glm::dot(plane.normal, beam.base)) * scale, -glm::dot(plane.normal, beam.u_hat) * scale,
          -glm::dot(plane.normal, beam.v_hat) * scale};
}

Prism prism_of(const Beam& beam, const Patch* source, const Bounds& box, double farthest) {
  return {beam.base, beam.u_hat, beam.v_hat, beam.direction, box.low, box.high, farthest, source};
}

Range over_box(const Affine& f, const dvec2& low, const dvec2& high) {
  const double across_u = f.u * (high.x - low.x), across_v = f.v * (high.y - low.y), corner = f(low);
  return {corner + std::min(across_u, 0.0) + std::min(across_v, 0.0), corner + std::max(across_u, 0.0) + std::max(across_v, 0.0)};
}

}  // namespace

VisibleSurfaces::VisibleSurfaces(const FaceTree& tree)
    : tree_(tree),
      // Projected coordinates and crossings carry a few roundings of numbers up to the radius. Heights: as for single rays.
      length_rounding_(16.0 * std::numeric_limits<double>::epsilon() * tree.mesh().radius),
      height_rounding_(8.0 * std::numeric_limits<double>::epsilon() * tree.mesh().radius),
      depth_margin_(1e-9 * tree.mesh().radius) {}

void VisibleSurfaces::of_faces(const Beam& incident, std::uint32_t begin, std::uint32_t end, std::vector<VisiblePart>& parts) {
  found_.resize(end - begin);
  std::iota(found_.begin(), found_.end(), begin);
  see({incident, no_index, nullptr, nullptr, {}}, found_, found_.size() == tree_.faces().size(), parts);
}

void VisibleSurfaces::from_surface(const Beam& beam, std::uint32_t source_patch, const ConvexPolygon& region,
                                   std::vector<VisiblePart>& parts) {
  const Patch& source = tree_.mesh().patches[source_patch];
  tree_.collect(prism_of(beam, &source, bounds(region), std::numeric_limits<double>::infinity()), found_);
  see({beam, source_patch, &region, &source, depth_of(beam, source)}, found_, true, parts);
}

// `complete`: no face outside the list can hide one of it.
void VisibleSurfaces::see(const View& view, std::span<const std::uint32_t> faces, bool complete,
                          std::vector<VisiblePart>& parts) {
  gather(view, faces, in_view_);
  const bool all_with_all = complete && in_view_.count <= few;
  Others others;
  const auto refer_to = [&](const Pool& pool) {
    others.clear();
    for (std::size_t i = 0; i < pool.count; ++i) others.push_back(&pool.items[i]);
  };
  if (all_with_all) refer_to(in_view_);
  for (std::size_t i = 0; i < in_view_.count; ++i) {
    const Candidate& c = in_view_.items[i];
    if (!all_with_all) {
      tree_.collect(prism_of(view.beam, view.source, c.box, c.depths.high + depth_margin_), found_in_front_);
      gather(view, found_in_front_, in_front_);
      refer_to(in_front_);
    }
    uncover(c, c.outline, others, parts);
  }
}

void VisibleSurfaces::gather(const View& view, std::span<const std::uint32_t> faces, Pool& pool) {
  pool.count = 0;
  for (const std::uint32_t face : faces)
    if (make_candidate(view, face, pool.next())) ++pool.count;
}

bool VisibleSurfaces::make_candidate(const View& view, std::uint32_t face, Candidate& c) {
  const Face& f = tree_.faces()[face];
  const Patch& plane = tree_.mesh().patches[f.patch];
  const double facing = glm::dot(plane.normal, view.beam.direction);
  c.tilt = std::abs(facing);
  if (f.patch == view.source_patch || c.tilt < edge_on) return false;
  if (facing > 0.0 && tree_.mesh().closed(f.triangle)) return false;
  c.face = face, c.patch = f.patch, c.triangle = f.triangle;
  project(view.beam, face, c.outline);
  if (view.region) clip_to_region(*view.region, c.outline);
  if (c.outline.empty()) return false;
  c.depth = depth_of(view.beam, plane);
  if (view.source) clip_to_front(view, c);
  if (c.outline.empty()) return false;
  c.box = bounds(c.outline);
  c.depths = range(c.outline, c.depth);
  return !is_sliver(c.outline);
}

void VisibleSurfaces::project(const Beam& beam, std::uint32_t face, ConvexPolygon& outline) const {
  outline.clear();
  for (const std::uint32_t corner : tree_.corners(face)) {
    const dvec3 r = tree_.mesh().vertices[corner] - beam.base;
    outline.emplace_back(glm::dot(beam.u_hat, r), glm::dot(beam.v_hat, r));
  }
  if (area(outline) < 0.0) std::ranges::reverse(outline);
}

void VisibleSurfaces::clip_to_region(const ConvexPolygon& region, ConvexPolygon& outline) {
  if (!bounds(region).overlaps(bounds(outline), length_rounding_)) return outline.clear();
  for (std::size_t i = 0; i < region.size() && !outline.empty(); ++i) {
    cut(outline, left_of(region[i], region[(i + 1) % region.size()]), length_rounding_, inside_, outside_);
    if (!outside_.empty()) outline = inside_;
  }
}

// Only what lies ahead of the surface the beam leaves, by more than rounding, is met: see ExactHit::ahead.
void VisibleSurfaces::clip_to_front(const View& view, Candidate& c) {
  const Affine ahead = c.depth - view.source_depth;
  const Range r = range(c.outline, ahead);
  if (r.high * c.tilt <= height_rounding_) return c.outline.clear();
  if (r.low >= 0.0) return;
  cut(c.outline, ahead, 0.0, inside_, outside_);
  c.outline = inside_;
}

// What is left of `outline`, a part of `c`, once the others have hidden theirs.
void VisibleSurfaces::uncover(const Candidate& c, const ConvexPolygon& outline, const Others& others,
                              std::vector<VisiblePart>& parts) {
  const Bounds box = bounds(outline);
  Others hiding;
  for (const Candidate* other : others)
    if (may_hide(*other, c, box)) hiding.push_back(other);
  if (hiding.size() > many && hiding.size() < others.size()) {
    if (std::ranges::any_of(hiding, [&](const Candidate* other) { return hides_all(*other, c, outline); })) return;
    const dvec2 size = box.high - box.low, half = 0.5 * (box.low + box.high);
    ConvexPolygon low, high;
    cut(outline, size.x > size.y ? Affine{-half.x, 1.0, 0.0} : Affine{-half.y, 0.0, 1.0}, length_rounding_, high, low);
    if (!low.empty()) uncover(c, low, hiding, parts);
    if (!high.empty()) uncover(c, high, hiding, parts);
    return;
  }
  pieces_.assign(1, outline);
  for (const Candidate* other : hiding) subtract(*other, c);
  for (const ConvexPolygon& piece : pieces_) emit(c, piece, parts);
}

// How far `c` lies behind `front`, positive where that one is nearer. Two planes that coincide are ordered by their triangles,
// over all their common box alike.
Affine VisibleSurfaces::behind(const Candidate& front, const Candidate& c) const {
  const Affine difference = c.depth - front.depth;
  const Range r = over_box(difference, glm::max(front.box.low, c.box.low), glm::min(front.box.high, c.box.high));
  const double doubt = height_rounding_ / std::min(front.tilt, c.tilt);
  if (r.high > doubt || r.low < -doubt) return difference;
  return {front.triangle < c.triangle ? 1.0 : -1.0, 0.0, 0.0};
}

bool VisibleSurfaces::may_hide(const Candidate& front, const Candidate& c, const Bounds& box) const {
  if (front.patch == c.patch || !front.box.overlaps(box, length_rounding_) || front.depths.low > c.depths.high) return false;
  return over_box(behind(front, c), glm::max(front.box.low, box.low), glm::min(front.box.high, box.high)).high > 0.0;
}

bool VisibleSurfaces::hides_all(const Candidate& front, const Candidate& c, const ConvexPolygon& outline) const {
  if (range(outline, behind(front, c)).low < 0.0) return false;
  for (std::size_t i = 0; i < front.outline.size(); ++i)
    if (range(outline, left_of(front.outline[i], front.outline[(i + 1) % front.outline.size()])).low < -length_rounding_)
      return false;
  return true;
}

void VisibleSurfaces::subtract(const Candidate& front, const Candidate& c) {
  const Affine order = behind(front, c);
  remaining_.clear();
  for (ConvexPolygon& piece : pieces_)
    if (!subtract(front, order, piece)) remaining_.push_back(std::move(piece));
  std::swap(pieces_, remaining_);
}

// Puts what `front` leaves of the piece in `remaining_`; false if it leaves all of it.
bool VisibleSurfaces::subtract(const Candidate& front, const Affine& order, const ConvexPolygon& piece) {
  if (!front.box.overlaps(bounds(piece), length_rounding_) || range(piece, order).high <= 0.0) return false;
  const std::size_t before = remaining_.size();
  const auto leaves_all = [&] {
    remaining_.resize(before);
    return false;
  };
  rest_ = piece;
  for (std::size_t i = 0; i < front.outline.size(); ++i) {
    const Affine edge = left_of(front.outline[i], front.outline[(i + 1) % front.outline.size()]);
    cut(rest_, edge, length_rounding_, inside_, outside_);
    if (inside_.empty()) return leaves_all();
    if (outside_.empty()) continue;
    remaining_.push_back(outside_);
    std::swap(rest_, inside_);
  }
  const Range r = range(rest_, order);
  if (r.high <= 0.0) return leaves_all();
  if (r.low >= 0.0) return true;
  cut(rest_, order, 0.0, inside_, outside_);
  if (is_sliver(inside_)) return leaves_all();
  if (!is_sliver(outside_)) remaining_.push_back(outside_);
  return true;
}

bool VisibleSurfaces::is_sliver(const ConvexPolygon& polygon) const {
  if (polygon.empty()) return true;
  const Bounds box = bounds(polygon);
  return area(polygon) <= length_rounding_ * glm::length(box.high - box.low);
}

void VisibleSurfaces::emit(const Candidate& c, const ConvexPolygon& piece, std::vector<VisiblePart>& parts) {
  if (is_sliver(piece))
    sliver_area_ += std::max(area(piece), 0.0);
  else
    parts.push_back({c.face, piece});
}

}  // namespace raytube
