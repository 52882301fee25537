#include "sbr/visible/beam_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace raytube {

namespace {

// Up to so many faces are compared each with each; beyond, groups of neighbours ask the tree which faces stand in front of them.
constexpr std::size_t few = 128, group = 32;
// Times the area of its members' boxes, from which on a group's box is mostly empty.
constexpr double scattered = 2.0;
// A face with more than this in front of it is halved first, until so many times in a row nothing came of it.
constexpr std::size_t many = 100;
constexpr int patience = 1;

// All that an incident wave lights.
BeamView view_of(const Beam& incident) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {incident, no_index, nullptr, {}, 1.0, nullptr, {dvec2(-infinity), dvec2(infinity)}};
}

}  // namespace

BeamVisibility::BeamVisibility(const FaceTree& tree, const Tracer& tracer)
    : tree_(tree), tracer_(tracer), projector_(tree), depth_margin_(1e-9 * tree.mesh().radius) {}

void BeamVisibility::of_faces(const Beam& incident, std::span<const std::uint32_t> faces, std::vector<VisiblePart>& parts) {
  const BeamView view = view_of(incident);
  gather(view, faces, in_view_);
  if (faces.size() == tree_.faces().size() && in_view_.count <= few) return uncover_in_view(parts);
  waiting_.clear();
  for (std::size_t i = 0; i < in_view_.count; ++i) waiting_.push_back(&in_view_.items[i]);
  drop_hidden(view);
  uncover_in_groups(view, parts);
}

void BeamVisibility::of_whole_faces(const Beam& incident, std::span<const std::uint32_t> faces, std::vector<VisiblePart>& parts) {
  const BeamView view = view_of(incident);
  for (const std::uint32_t face : faces)
    if (projector_.project(view, face, first_)) emit(first_, first_.outline, parts);
}

// Most hidden faces lie behind a single one, and a ray through their middle finds it.
void BeamVisibility::drop_hidden(const BeamView& view) {
  rays_.clear();
  for (const ProjectedFace* c : waiting_) rays_.push_back(middle_ray(view.beam, view.source_patch, c->outline));
  hits_.resize(rays_.size());
  tracer_.closest_hits(rays_, hits_);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const ProjectedFace& c = *waiting_[i];
    const std::uint32_t first = hits_[i] ? tree_.face_of(hits_[i].triangle) : c.face;
    if (first == c.face || !projector_.project(view, first, first_) ||
        !hides_all({&first_, projector_.behind(first_, c)}, c.outline))
      waiting_[kept++] = &c;
  }
  waiting_.resize(kept);
}

Ray BeamVisibility::middle_ray(const Beam& beam, std::uint32_t source_patch, const ConvexPolygon& region) const {
  const Patch* source = source_patch == no_index ? nullptr : &tree_.mesh().patches[source_patch];
  return tube_ray(beam, middle(region), source, source_patch);
}

void BeamVisibility::from_surface(const Beam& beam, std::uint32_t source_patch, const ConvexPolygon& region, const Hit& in_middle,
                                  std::vector<VisiblePart>& parts) {
  const Patch& source = tree_.mesh().patches[source_patch];
  const double tilt = std::abs(facing(beam, source));
  const BeamView view{beam, source_patch, &source, depth_of(beam, source), tilt, &region, bounds(region)};
  double farthest = std::numeric_limits<double>::infinity();
  if (in_middle && projector_.project(view, tree_.face_of(in_middle.triangle), first_) && projector_.fills(first_, region))
    farthest = first_.depths.high + depth_margin_;
  meet(view, farthest, parts);
}

void BeamVisibility::within(const Beam& incident, const ConvexPolygon& region, std::vector<VisiblePart>& parts) {
  meet({incident, no_index, nullptr, {}, 1.0, &region, bounds(region)}, std::numeric_limits<double>::infinity(), parts);
}

void BeamVisibility::meet(const BeamView& view, double farthest, std::vector<VisiblePart>& parts) {
  tree_.collect(prism_of(view.beam, view.source, view.box, view.region, farthest, tree_.mesh().radius), found_);
  if (found_.empty()) return;
  gather_nearest_first(view, farthest);
  if (in_view_.count <= few) return uncover_in_view(parts);
  waiting_.clear();
  for (std::size_t i = 0; i < in_view_.count; ++i) waiting_.push_back(&in_view_.items[i]);
  uncover_in_groups(view, parts);
}

// The faces among `found_`, in the order in which their planes begin within the region. One that fills the region ends the
// search at its own depth.
void BeamVisibility::gather_nearest_first(const BeamView& view, double farthest) {
  by_depth_.clear();
  for (const std::uint32_t face : found_) {
    if (!projector_.faces_beam(view, face)) continue;
    const Affine depth = depth_of(view.beam, tree_.mesh().patches[tree_.faces()[face].patch]);
    if (view.source && range(view.box, depth - view.source_depth).high <= 0.0) continue;
    by_depth_.emplace_back(range(view.box, depth).low, face);
  }
  std::ranges::sort(by_depth_);
  const double filled = (1.0 - 1e-9) * area(*view.region);
  in_view_.count = 0;
  for (const auto& [nearest, face] : by_depth_) {
    if (nearest > farthest) return;
    if (!projector_.project(view, face, in_view_.next())) continue;
    const ProjectedFace& c = in_view_.items[in_view_.count++];
    if (c.depths.high + depth_margin_ < farthest && area(c.outline) >= filled && projector_.fills(c, *view.region))
      farthest = c.depths.high + depth_margin_;
  }
}

void BeamVisibility::uncover_in_groups(const BeamView& view, std::vector<VisiblePart>& parts) {
  projected_.clear();
  in_front_.count = 0;
  const std::span<const ProjectedFace* const> all = waiting_;
  for (std::size_t first = 0; first < all.size(); first += group)
    uncover_group(view, all.subspan(first, std::min(group, all.size() - first)), parts);
}

// Asks the tree which faces stand in front of these. Neighbours ask together unless they lie too scattered for that.
void BeamVisibility::uncover_group(const BeamView& view, std::span<const ProjectedFace* const> faces,
                                   std::vector<VisiblePart>& parts) {
  Bounds box = faces[0]->box;
  double farthest = faces[0]->depths.high, sum_of_areas = 0.0;
  for (const ProjectedFace* c : faces) {
    box = {glm::min(box.low, c->box.low), glm::max(box.high, c->box.high)};
    farthest = std::max(farthest, c->depths.high);
    sum_of_areas += area(c->box);
  }
  if (faces.size() > 1 && area(box) > scattered * sum_of_areas) {
    uncover_group(view, faces.first(faces.size() / 2), parts);
    return uncover_group(view, faces.subspan(faces.size() / 2), parts);
  }
  tree_.collect(prism_of(view.beam, view.source, box, nullptr, farthest + depth_margin_, tree_.mesh().radius), found_in_front_);
  others_.clear();
  for (const std::uint32_t face : found_in_front_) {
    const ProjectedFace* other = projected(view, face);
    if (other && other->box.overlaps(box, projector_.length_rounding())) others_.push_back(other);
  }
  for (const ProjectedFace* c : faces) uncover(*c, parts);
}

// A face as the view has it, for the groups that are uncovered; null if the beam meets none of it.
const ProjectedFace* BeamVisibility::projected(const BeamView& view, std::uint32_t face) {
  if (!projector_.faces_beam(view, face)) return nullptr;
  const auto [known, is_new] = projected_.try_emplace(face, nullptr);
  if (is_new && projector_.project(view, face, in_front_.next())) known->second = &in_front_.items[in_front_.count++];
  return known->second;
}

// Compares the faces in view each with each.
void BeamVisibility::uncover_in_view(std::vector<VisiblePart>& parts) {
  others_.clear();
  for (std::size_t i = 0; i < in_view_.count; ++i) others_.push_back(&in_view_.items[i]);
  for (std::size_t i = 0; i < in_view_.count; ++i) uncover(in_view_.items[i], parts);
}

void BeamVisibility::gather(const BeamView& view, std::span<const std::uint32_t> faces, Pool& pool) {
  pool.count = 0;
  for (const std::uint32_t face : faces)
    if (projector_.project(view, face, pool.next())) ++pool.count;
}

// What is left of a face once those of others_ that stand in front have hidden theirs.
void BeamVisibility::uncover(const ProjectedFace& c, std::vector<VisiblePart>& parts) {
  occluders_.clear();
  for (const ProjectedFace* front : others_) {
    if (front->face == c.face || front->depths.low > c.depths.high) continue;
    if (!front->box.overlaps(c.box, projector_.length_rounding())) continue;
    if (projector_.separates(front->outline, c.outline) || projector_.separates(c.outline, front->outline)) continue;
    const Affine behind = projector_.behind(*front, c);
    if (range(common(front->box, c.box), behind).high > 0.0) occluders_.push_back({front, behind});
  }
  uncover(c, c.outline, 0, occluders_.size(), others_.size(), patience, parts);
}

// What occluders_[begin, end) leave of `outline`, a part of `c`. What it was cut from had `before` of them.
void BeamVisibility::uncover(const ProjectedFace& c, const ConvexPolygon& outline, std::size_t begin, std::size_t end,
                             std::size_t before, int tries, std::vector<VisiblePart>& parts) {
  if (end - begin > many && tries > 0) return halve(c, outline, begin, end, end - begin < before ? patience : tries - 1, parts);
  pieces_.assign(1, outline);
  for (std::size_t i = begin; i < end && !pieces_.empty(); ++i) subtract(occluders_[i]);
  for (const ConvexPolygon& piece : pieces_) emit(c, piece, parts);
}

void BeamVisibility::halve(const ProjectedFace& c, const ConvexPolygon& outline, std::size_t begin, std::size_t end, int tries,
                           std::vector<VisiblePart>& parts) {
  for (std::size_t i = begin; i < end; ++i)
    if (hides_all(occluders_[i], outline)) return;
  const Bounds box = bounds(outline);
  const dvec2 size = box.high - box.low, middle = 0.5 * (box.low + box.high);
  std::array<ConvexPolygon, 2> halves;
  cut(outline, size.x > size.y ? Affine{-middle.x, 1.0, 0.0} : Affine{-middle.y, 0.0, 1.0}, projector_.length_rounding(),
      halves[1], halves[0]);
  for (const ConvexPolygon& half : halves) {
    if (half.empty()) continue;
    const Bounds within = bounds(half);
    const std::size_t first = occluders_.size();
    for (std::size_t i = begin; i < end; ++i) {
      const auto [front, behind] = occluders_[i];
      if (front->box.overlaps(within, projector_.length_rounding()) && range(common(front->box, within), behind).high > 0.0)
        occluders_.push_back({front, behind});
    }
    uncover(c, half, first, occluders_.size(), end - begin, tries, parts);
    occluders_.resize(first);
  }
}

bool BeamVisibility::hides_all(const Occluder& front, const ConvexPolygon& outline) const {
  return range(outline, front.behind).low >= 0.0 && projector_.fills(*front.face, outline);
}

void BeamVisibility::subtract(const Occluder& front) {
  remaining_.clear();
  for (ConvexPolygon& piece : pieces_)
    if (!subtract(*front.face, front.behind, piece)) remaining_.push_back(std::move(piece));
  std::swap(pieces_, remaining_);
}

// Puts what `front` leaves of the piece in `remaining_`; false if it leaves all of it.
bool BeamVisibility::subtract(const ProjectedFace& front, const Affine& order, const ConvexPolygon& piece) {
  if (!front.box.overlaps(bounds(piece), projector_.length_rounding()) || !reaches_beyond(piece, order, 0.0)) return false;
  if (projector_.separates(piece, front.outline) || projector_.separates(front.outline, piece)) return false;
  const std::size_t before = remaining_.size();
  const auto leaves_all = [&] {
    remaining_.resize(before);
    return false;
  };
  rest_ = piece;
  for (const Affine& edge : front.edges) {
    const Range r = range(rest_, edge);
    if (r.high <= projector_.length_rounding()) return leaves_all();
    if (r.low >= -projector_.length_rounding()) continue;
    cut(rest_, edge, projector_.length_rounding(), inside_, outside_);
    remaining_.push_back(outside_);
    std::swap(rest_, inside_);
  }
  const Range r = range(rest_, order);
  if (r.high <= 0.0) return leaves_all();
  if (r.low >= 0.0) return true;
  cut(rest_, order, 0.0, inside_, outside_);
  if (projector_.is_sliver(inside_)) return leaves_all();
  if (outside_.empty()) return true;
  remaining_.push_back(outside_);
  return true;
}

void BeamVisibility::emit(const ProjectedFace& c, const ConvexPolygon& piece, std::vector<VisiblePart>& parts) {
  if (projector_.is_sliver(piece))
    sliver_area_ += std::max(area(piece), 0.0);
  else
    parts.push_back({c.face, piece});
}

}  // namespace raytube
