#include "sbr/visible.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace raytube {

namespace {

// Up to so many faces are compared each with each; beyond, groups of neighbours ask the tree who stands in front of them.
constexpr std::size_t few = 32, group = 16;
// Times the area of its members' boxes, from which on a group's box is mostly empty.
constexpr double scattered = 2.0;
// A face with more than this in front of it is halved first.
constexpr std::size_t many = 48;
// Seen closer to its own plane than this, a face has no area.
constexpr double edge_on = 1e-12;

Affine depth_of(const Beam& beam, const Patch& plane) {
  const double scale = 1.0 / glm::dot(plane.normal, beam.direction);
  const dvec2 slope = -scale * dvec2(glm::dot(plane.normal, beam.u_hat), glm::dot(plane.normal, beam.v_hat));
  return {(plane.offset - glm::dot(plane.normal, beam.base)) * scale - glm::dot(slope, beam.anchor), slope.x, slope.y};
}

Prism prism_of(const Beam& beam, const Patch* source, const Bounds& box, double farthest) {
  return {beam.base, beam.u_hat, beam.v_hat, beam.direction, box.low - beam.anchor, box.high - beam.anchor, farthest, source};
}

Range over_box(const Affine& f, const dvec2& low, const dvec2& high) {
  const double across_u = f.u * (high.x - low.x), across_v = f.v * (high.y - low.y), corner = f(low);
  return {corner + std::min(across_u, 0.0) + std::min(across_v, 0.0), corner + std::max(across_u, 0.0) + std::max(across_v, 0.0)};
}

}  // namespace

VisibleSurfaces::VisibleSurfaces(const FaceTree& tree, const Tracer& tracer)
    : tree_(tree),
      tracer_(tracer),
      // Projected coordinates and crossings carry a few roundings of numbers up to the radius, heights of one plane over
      // another some tens.
      length_rounding_(16.0 * std::numeric_limits<double>::epsilon() * tree.mesh().radius),
      height_rounding_(64.0 * std::numeric_limits<double>::epsilon() * tree.mesh().radius),
      depth_margin_(1e-9 * tree.mesh().radius) {}

void VisibleSurfaces::of_faces(const Beam& incident, std::uint32_t begin, std::uint32_t end, std::vector<VisiblePart>& parts) {
  found_.resize(end - begin);
  std::iota(found_.begin(), found_.end(), begin);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const View view{incident, no_index, nullptr, nullptr, {}, 1.0, {dvec2(-infinity), dvec2(infinity)}};
  gather(view, found_, in_view_);
  if (found_.size() == tree_.faces().size() && in_view_.count <= few) return uncover(in_view_, in_view_, parts);
  waiting_.clear();
  for (const Candidate& c : in_view_.used()) waiting_.push_back(&c);
  drop_hidden(view);
  see_in_groups(view, parts);
}

// Most hidden faces lie behind a single one, and a ray through their middle finds it.
void VisibleSurfaces::drop_hidden(const View& view) {
  rays_.clear();
  for (const Candidate* c : waiting_) rays_.push_back(middle_ray(view.beam, view.source_patch, c->outline));
  hits_.resize(rays_.size());
  tracer_.closest_hits(rays_, hits_);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const Candidate& c = *waiting_[i];
    const std::uint32_t first = hits_[i] ? tree_.face_of(hits_[i].triangle) : c.face;
    if (first == c.face || !make_candidate(view, first, first_) || !hides_all(first_, c, c.outline)) waiting_[kept++] = &c;
  }
  waiting_.resize(kept);
}

Ray VisibleSurfaces::middle_ray(const Beam& beam, std::uint32_t source_patch, const ConvexPolygon& region) {
  const dvec2 step = middle(region) - beam.anchor;
  return {beam.base + step.x * beam.along_u + step.y * beam.along_v, beam.direction, source_patch};
}

void VisibleSurfaces::from_surface(const Beam& beam, std::uint32_t source_patch, const ConvexPolygon& region,
                                   const Hit& in_middle, std::vector<VisiblePart>& parts) {
  const Patch& source = tree_.mesh().patches[source_patch];
  const double tilt = std::abs(glm::dot(source.normal, beam.direction));
  const View view{beam, source_patch, &region, &source, depth_of(beam, source), tilt, bounds(region)};
  double farthest = std::numeric_limits<double>::infinity();
  if (in_middle && make_candidate(view, tree_.face_of(in_middle.triangle), first_) && fills(first_, region))
    farthest = first_.depths.high + depth_margin_;
  tree_.collect(prism_of(beam, &source, view.box, farthest), found_);
  if (found_.empty()) return;
  gather_nearest_first(view, farthest);
  if (in_view_.count <= few) return uncover(in_view_, in_view_, parts);
  waiting_.clear();
  for (const Candidate& c : in_view_.used()) waiting_.push_back(&c);
  see_in_groups(view, parts);
}

// Candidates among `found_`, in the order in which their planes begin within the region. One that fills the region ends the
// search at its own depth.
void VisibleSurfaces::gather_nearest_first(const View& view, double farthest) {
  by_depth_.clear();
  for (const std::uint32_t face : found_) {
    if (!faces_beam(view, face)) continue;
    const Patch& plane = tree_.mesh().patches[tree_.faces()[face].patch];
    by_depth_.emplace_back(over_box(depth_of(view.beam, plane), view.box.low, view.box.high).low, face);
  }
  std::ranges::sort(by_depth_);
  const double filled = (1.0 - 1e-9) * area(*view.region);
  in_view_.count = 0;
  for (const auto& [nearest, face] : by_depth_) {
    if (nearest > farthest) return;
    if (!make_candidate(view, face, in_view_.next())) continue;
    const Candidate& c = in_view_.items[in_view_.count++];
    if (c.depths.high + depth_margin_ < farthest && area(c.outline) >= filled && fills(c, *view.region))
      farthest = c.depths.high + depth_margin_;
  }
}

// Not one corner of the region is left out.
bool VisibleSurfaces::fills(const Candidate& c, const ConvexPolygon& region) const {
  return std::ranges::all_of(c.edges, [&](const Affine& edge) { return range(region, edge).low >= -length_rounding_; });
}

void VisibleSurfaces::see_in_groups(const View& view, std::vector<VisiblePart>& parts) {
  const std::span<const Candidate* const> all = waiting_;
  for (std::size_t first = 0; first < all.size(); first += group)
    see(view, all.subspan(first, std::min(group, all.size() - first)), parts);
}

// Asks the tree who stands in front of these faces. Neighbours ask together unless they lie too scattered for that.
void VisibleSurfaces::see(const View& view, std::span<const Candidate* const> faces, std::vector<VisiblePart>& parts) {
  Bounds box = faces[0]->box;
  double farthest = faces[0]->depths.high, sum_of_areas = 0.0;
  for (const Candidate* c : faces) {
    box = {glm::min(box.low, c->box.low), glm::max(box.high, c->box.high)};
    farthest = std::max(farthest, c->depths.high);
    sum_of_areas += area(c->box);
  }
  if (faces.size() > 1 && area(box) > scattered * sum_of_areas) {
    see(view, faces.first(faces.size() / 2), parts);
    return see(view, faces.subspan(faces.size() / 2), parts);
  }
  tree_.collect(prism_of(view.beam, view.source, box, farthest + depth_margin_), found_in_front_);
  View narrowed = view;
  narrowed.box = box;
  gather(narrowed, found_in_front_, in_front_);
  others_.clear();
  for (const Candidate& other : in_front_.used()) others_.push_back(&other);
  const std::size_t all = others_.size();
  for (const Candidate* c : faces) uncover(*c, c->outline, 0, all, parts);
}

void VisibleSurfaces::uncover(const Pool& candidates, const Pool& others, std::vector<VisiblePart>& parts) {
  others_.clear();
  for (const Candidate& other : others.used()) others_.push_back(&other);
  const std::size_t all = others_.size();
  for (const Candidate& c : candidates.used()) uncover(c, c.outline, 0, all, parts);
}

void VisibleSurfaces::gather(const View& view, std::span<const std::uint32_t> faces, Pool& pool) {
  pool.count = 0;
  for (const std::uint32_t face : faces)
    if (make_candidate(view, face, pool.next())) ++pool.count;
}

bool VisibleSurfaces::faces_beam(const View& view, std::uint32_t face) const {
  const Face& f = tree_.faces()[face];
  const double facing = glm::dot(tree_.mesh().patches[f.patch].normal, view.beam.direction);
  if (f.patch == view.source_patch || std::abs(facing) < edge_on) return false;
  return facing < 0.0 || !tree_.mesh().closed(f.triangle);
}

bool VisibleSurfaces::make_candidate(const View& view, std::uint32_t face, Candidate& c) {
  if (!faces_beam(view, face)) return false;
  const Face& f = tree_.faces()[face];
  const Patch& plane = tree_.mesh().patches[f.patch];
  c.tilt = std::abs(glm::dot(plane.normal, view.beam.direction));
  c.face = face, c.patch = f.patch, c.triangle = f.triangle;
  if (!project(view, face, c) || (view.region && !clip_to_region(*view.region, c.outline))) return false;
  c.depth = depth_of(view.beam, plane);
  if (view.source) clip_to_front(view, c);
  if (c.outline.empty()) return false;
  c.box = bounds(c.outline);
  c.depths = range(c.outline, c.depth);
  return !is_sliver(c.outline);
}

// False if the face lies beside the part of the view in question.
bool VisibleSurfaces::project(const View& view, std::uint32_t face, Candidate& c) {
  const Beam& beam = view.beam;
  corners_.clear();
  Bounds box{dvec2(std::numeric_limits<double>::infinity()), dvec2(-std::numeric_limits<double>::infinity())};
  for (const std::uint32_t corner : tree_.corners(face)) {
    const dvec3 r = tree_.mesh().vertices[corner] - beam.base;
    const dvec2 at = beam.anchor + dvec2(glm::dot(beam.u_hat, r), glm::dot(beam.v_hat, r));
    corners_.push_back(at);
    box = {glm::min(box.low, at), glm::max(box.high, at)};
  }
  if (!box.overlaps(view.box, length_rounding_)) return false;
  set_corners(c.outline, corners_);
  c.edges.clear();
  for (const Corner& corner : c.outline) c.edges.push_back(corner.edge);
  return true;
}

bool VisibleSurfaces::clip_to_region(const ConvexPolygon& region, ConvexPolygon& outline) {
  if (separates(region, outline)) return false;
  for (const Corner& corner : region) {
    if (range(outline, corner.edge).low >= -length_rounding_) continue;
    cut(outline, corner.edge, length_rounding_, inside_, outside_);
    std::swap(outline, inside_);
    if (outline.empty()) return false;
  }
  return true;
}

// One of the polygon's edges has the other one on its far side.
bool VisibleSurfaces::separates(const ConvexPolygon& polygon, const ConvexPolygon& other) const {
  return std::ranges::any_of(polygon, [&](const Corner& corner) { return range(other, corner.edge).high <= length_rounding_; });
}

// Only what lies ahead of the surface the beam leaves, by more than rounding, is met: see ExactHit::ahead.
void VisibleSurfaces::clip_to_front(const View& view, Candidate& c) {
  const Affine ahead = c.depth - view.source_depth;
  const Range r = range(c.outline, ahead);
  if (r.high * std::min(c.tilt, view.source_tilt) <= height_rounding_) return c.outline.clear();
  if (r.low >= 0.0) return;
  cut(c.outline, ahead, 0.0, inside_, outside_);
  std::swap(c.outline, inside_);
  c.edges.push_back(normalized(ahead));
}

// What is left of `outline`, a part of `c`, once those of others_[begin, end) that stand in front have hidden theirs.
void VisibleSurfaces::uncover(const Candidate& c, const ConvexPolygon& outline, std::size_t begin, std::size_t end,
                              std::vector<VisiblePart>& parts) {
  const Bounds box = bounds(outline);
  const std::size_t first = others_.size();
  for (std::size_t i = begin; i < end; ++i)
    if (others_[i]->box.overlaps(box, length_rounding_) && may_hide(*others_[i], c, box)) others_.push_back(others_[i]);
  const std::size_t last = others_.size();
  if (last - first > many && last - first < end - begin) {
    halve(c, outline, first, last, parts);
  } else {
    pieces_.assign(1, outline);
    for (std::size_t i = first; i < last && !pieces_.empty(); ++i) subtract(*others_[i], c);
    for (const ConvexPolygon& piece : pieces_) emit(c, piece, parts);
  }
  others_.resize(first);
}

void VisibleSurfaces::halve(const Candidate& c, const ConvexPolygon& outline, std::size_t begin, std::size_t end,
                            std::vector<VisiblePart>& parts) {
  for (std::size_t i = begin; i < end; ++i)
    if (hides_all(*others_[i], c, outline)) return;
  const Bounds box = bounds(outline);
  const dvec2 size = box.high - box.low, half = 0.5 * (box.low + box.high);
  ConvexPolygon low, high;
  cut(outline, size.x > size.y ? Affine{-half.x, 1.0, 0.0} : Affine{-half.y, 0.0, 1.0}, length_rounding_, high, low);
  if (!low.empty()) uncover(c, low, begin, end, parts);
  if (!high.empty()) uncover(c, high, begin, end, parts);
}

// How far `c` lies behind `front`, positive where that one is nearer. Two planes that coincide are ordered by their triangles,
// over all their common box alike.
Affine VisibleSurfaces::behind(const Candidate& front, const Candidate& c) const {
  const Affine by_index{front.triangle < c.triangle ? 1.0 : -1.0, 0.0, 0.0};
  if (front.patch == c.patch) return by_index;
  const Affine difference = c.depth - front.depth;
  const Range r = over_box(difference, glm::max(front.box.low, c.box.low), glm::min(front.box.high, c.box.high));
  const double doubt = height_rounding_ / std::min(front.tilt, c.tilt);
  return r.high > doubt || r.low < -doubt ? difference : by_index;
}

bool VisibleSurfaces::may_hide(const Candidate& front, const Candidate& c, const Bounds& box) const {
  if (front.face == c.face || front.depths.low > c.depths.high) return false;
  if (separates(front.outline, c.outline) || separates(c.outline, front.outline)) return false;
  return over_box(behind(front, c), glm::max(front.box.low, box.low), glm::min(front.box.high, box.high)).high > 0.0;
}

bool VisibleSurfaces::hides_all(const Candidate& front, const Candidate& c, const ConvexPolygon& outline) const {
  return range(outline, behind(front, c)).low >= 0.0 &&
         std::ranges::all_of(front.edges, [&](const Affine& edge) { return range(outline, edge).low >= -length_rounding_; });
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
  if (separates(piece, front.outline) || separates(front.outline, piece)) return false;
  const std::size_t before = remaining_.size();
  const auto leaves_all = [&] {
    remaining_.resize(before);
    return false;
  };
  rest_ = piece;
  for (const Affine& edge : front.edges) {
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
