#include "sbr/curved/curved_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sbr/beams/current_map.h"
#include "sbr/curved/curved_integral.h"
#include "sbr/curved/through_sheets.h"
#include "sbr/visible/beam_visibility.h"
#include "scene/frequency_bands.h"

namespace raytube {

namespace {

// A cell with more faces than this is split without a look at them; one with no more than `few` is not worth splitting.
constexpr std::size_t many = 160, few = 24;
// Phase [rad] by which the integrand may vary over a cell.
constexpr double widest_cell_phase = 60.0;
// Smallest cell in wavelengths; and, in rises of the surface over the facets in it, of those that the facets' outline crosses:
// what lies between it and the shadow boundary beyond it is found from these.
constexpr double smallest_cell = 1.0 / 32.0, outline_cell = 16.0;
// Share of a cell that facets may leave free, by rounding.
constexpr double free_share = 1e-9;
class CellTrace {
 public:
  CellTrace(const TubeLook& look, std::span<const FacingTriangle> facing)
      : look_(look),
        facing_(facing),
        incident_(incident_beam(look.grid, look.transmit, dvec2(0.0))),
        band_(look.wavenumbers()),
        light_{look.grid, look.transmit, look.receive, look.surfaces, &band_},
        map_light_{look.grid, look.transmit, look.receive, look.surfaces},
        highest_(sampling_wavenumber(look.wavenumbers())),
        smallest_(smallest_cell * 2.0 * pi / highest_),
        visible_(look.faces, look.tracer),
        elsewhere_(looks_from_elsewhere(look)) {
    if (look.sheets) through_sheets_.emplace(look, visible_);
    if (!look.map) return;
    map_materials_ = at_frequency({look.surfaces.materials.begin(), look.surfaces.materials.end()}, look.map->frequency_index());
    map_light_.surfaces = {map_materials_, std::span(&look.map->wavenumber(), 1)};
  }

  TubeSums run(const Bounds& block, std::span<const std::uint32_t> triangles) {
    cell(block, triangles);
    sums_.tubes = sums_.hits.empty() ? 0 : sums_.hits[0];
    sums_.rays += sums_.tubes;
    return std::move(sums_);
  }

 private:
  enum class Verdict { one_piece, bent, above_limit };

  // `triangles` in facing_ are all that reach into the cell.
  void cell(const Bounds& box, std::span<const std::uint32_t> triangles) {
    if (std::ranges::none_of(triangles, [&](std::uint32_t t) { return facing_[t].region != no_index; })) return;
    const double size = glm::length(box.high - box.low);
    const bool smallest = size < smallest_;
    if (triangles.size() > many && !smallest) return split(box, triangles);
    const std::optional<CurvedPiece> piece = piece_in(box, triangles);
    if (!piece) return;
    const Verdict verdict = judge(*piece, box, triangles);
    const bool within_dents = verdict == Verdict::bent && (smallest || size < outline_cell * rise(triangles));
    if (through_sheets_ && verdict != Verdict::above_limit && has_sheets(*piece, box, triangles))
      return divide_by_sheets(*piece, box, triangles);
    const bool on_outline = within_dents && (smallest || !is_covered(box, triangles));
    if (verdict == Verdict::one_piece || on_outline) {
      const auto triangle_at = [&](const dvec2& at) { return surface_at(at, triangles); };
      return add(*piece, box, triangle_at);
    }
    const bool splits = verdict == Verdict::bent && !within_dents;
    if (smallest || (!splits && triangles.size() <= few)) return facets(box, triangles);
    split(box, triangles);
  }

  void split(const Bounds& box, std::span<const std::uint32_t> triangles) {
    const dvec2 middle = 0.5 * (box.low + box.high);
    std::vector<std::uint32_t> inside;
    for (const Bounds& quarter : {Bounds{box.low, middle}, Bounds{dvec2(middle.x, box.low.y), dvec2(box.high.x, middle.y)},
                                  Bounds{dvec2(box.low.x, middle.y), dvec2(middle.x, box.high.y)}, Bounds{middle, box.high}}) {
      inside.clear();
      std::ranges::copy_if(triangles, std::back_inserter(inside), [&](std::uint32_t t) { return facing_[t].reaches(quarter); });
      cell(quarter, inside);
    }
  }

  bool is_sheet(std::uint32_t t) const { return through_sheets_ && through_sheets_->is_sheet(facing_[t].triangle); }

  // Whether sheets may stand before any of this, seen from either antenna.
  bool has_sheets(const CurvedPiece& piece, const Bounds& box, std::span<const std::uint32_t> triangles) {
    const double farthest = farthest_depth(piece, box);
    const auto stands_before = [&](std::uint32_t t) { return is_sheet(t) && reaches_before(facing_[t], box, farthest); };
    if (std::ranges::any_of(triangles, stands_before)) return true;
    if (!elsewhere_) return false;
    const TriangleMesh& mesh = look_.faces.mesh();
    std::vector<dvec3> corners;
    for (const std::uint32_t t : triangles)
      for (const std::uint32_t v : mesh.triangles[facing_[t].triangle]) corners.push_back(mesh.vertices[v]);
    return look_.sheets->may_cover_any(corners);
  }

  // Sheets divide the parts of facets. Cells that the facets' outline crosses have those before their middle, small as they are.
  void divide_by_sheets(const CurvedPiece& piece, const Bounds& box, std::span<const std::uint32_t> triangles) {
    const double size = glm::length(box.high - box.low);
    const bool smallest = size < smallest_, covered = is_covered(box, triangles);
    if (!covered && (smallest || size < outline_cell * rise(triangles))) return add_on_outline(piece, box, triangles);
    if (smallest || (covered && triangles.size() <= few)) return facets(box, triangles);
    split(box, triangles);
  }

  void add_on_outline(const CurvedPiece& piece, const Bounds& box, std::span<const std::uint32_t> triangles) {
    const dvec2 at = middle(box);
    const double depth =
        glm::dot(piece.surface().point - look_.grid.plane_origin, look_.grid.direction) + piece.depth(at - piece.anchor()).depth;
    const SheetsBefore sheets = through_sheets_->sheets_before(at, depth, base_->triangle);
    const auto bounce = static_cast<int>(sheets.transmitter.size());
    if (bounce >= look_.max_bounces) return;
    const std::vector<ScatteringMatrix> part = through_sheets_->far_field(sheets, piece, box, sums_);
    add(part, bounce);
    if (look_.map) look_.map->add(bounce, at, surface_at(at, triangles), part[look_.map->frequency_index()]);
  }

  // Height to which the piece's surface rises over these facets [m].
  double rise(std::span<const std::uint32_t> triangles) const {
    double most = 0.0;
    for (const std::uint32_t t : triangles)
      if (facing_[t].region == base_->region) most = std::max(most, look_.smooth->rise(facing_[t].triangle));
    return most;
  }

  // Whether facets of the piece's surface hide all of the launch plane's cell.
  bool is_covered(const Bounds& box, std::span<const std::uint32_t> triangles) {
    double free = area(box);
    const double most_free = free_share * free;
    for (const std::uint32_t t : triangles)
      if (facing_[t].region == base_->region && clip(facing_[t], box)) free -= area(clipped_);
    return free <= most_free;
  }

  std::uint32_t region(std::uint32_t face) const { return look_.smooth->region(look_.faces.faces()[face].triangle); }

  dvec3 above(const dvec2& at) const { return look_.grid.plane_origin + at.x * look_.grid.u_hat + at.y * look_.grid.v_hat; }

  // The quadric about the cell's middle; where that misses the surface, about the largest part of a facet in the cell.
  std::optional<CurvedPiece> piece_in(const Bounds& box, std::span<const std::uint32_t> triangles) {
    dvec2 at = 0.5 * (box.low + box.high);
    const FacingTriangle* base = nullptr;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t t : triangles) {
      const FacingTriangle& f = facing_[t];
      if (f.region == no_index || !f.contains(at)) continue;
      const double depth = facet_depth(f)(at);
      if (depth < nearest - tie * look_.faces.mesh().radius) base = &f, nearest = depth;
    }
    if (!base) {
      double largest = 0.0;
      for (const std::uint32_t t : triangles) {
        const FacingTriangle& f = facing_[t];
        if (f.region == no_index || area(common(f.bounds(), box)) <= largest || !clip(f, box)) continue;
        if (const double size = area(clipped_); size > (1.0 + tie) * largest) base = &f, largest = size, at = middle(clipped_);
      }
    }
    if (!base) return {};
    base_ = base;
    return piece_over(look_, at, base->triangle);
  }

  Affine facet_depth(const FacingTriangle& f) const {
    const TriangleMesh& mesh = look_.faces.mesh();
    return depth_of(incident_, mesh.patch_of(f.triangle));
  }

  // Fills clipped_ with the part of the triangle in the box.
  bool clip(const FacingTriangle& f, const Bounds& box) {
    set_corners(clipped_, f.at);
    for (const Affine& side : {Affine{-box.low.x, 1.0, 0.0}, Affine{box.high.x, -1.0, 0.0}, Affine{-box.low.y, 0.0, 1.0},
                               Affine{box.high.y, 0.0, -1.0}}) {
      raytube::clip(clipped_, side, 0.0, inside_);
      std::swap(clipped_, inside_);
      if (clipped_.empty()) return false;
    }
    return true;
  }

  Verdict judge(const CurvedPiece& piece, const Bounds& box, std::span<const std::uint32_t> triangles) {
    if (highest_ * path_range(light_, piece, box) > widest_cell_phase) return Verdict::bent;
    const double farthest = farthest_depth(piece, box);
    phase_off_ = 0.0;
    bool others = false;
    for (const std::uint32_t t : triangles) {
      if (facing_[t].region == base_->region || is_sheet(t)) continue;
      if (reaches_before(facing_[t], box, farthest)) return Verdict::above_limit;
      others = true;
    }
    // Beside the piece they are lit.
    if (others && !is_covered(box, triangles)) return Verdict::above_limit;
    const auto of_piece = [&](std::uint32_t t) { return facing_[t].region == base_->region; };
    if (std::ranges::any_of(triangles, [&](std::uint32_t t) { return of_piece(t) && ends_within(facing_[t], box); }))
      return Verdict::above_limit;
    const auto leaves_piece = [&](std::uint32_t t) { return of_piece(t) && !lies_on(facing_[t], piece, box); };
    return std::ranges::any_of(triangles, leaves_piece) ? Verdict::bent : Verdict::one_piece;
  }

  double farthest_depth(const CurvedPiece& piece, const Bounds& box) const {
    double farthest = 0.0;
    for (const dvec2& at : {box.low, box.high, dvec2(box.low.x, box.high.y), dvec2(box.high.x, box.low.y)})
      farthest = std::max(farthest, piece.depth(at - piece.anchor()).depth);
    return farthest + glm::dot(piece.surface().point - look_.grid.plane_origin, look_.grid.direction);
  }

  bool reaches_before(const FacingTriangle& f, const Bounds& box, double farthest) {
    const Affine depth = facet_depth(f);
    return range(common(f.bounds(), box), depth).low < farthest && clip(f, box) && range(clipped_, depth).low < farthest;
  }

  // Whether the surface ends at a side of the facet in the box.
  bool ends_within(const FacingTriangle& f, const Bounds& box) const {
    for (int c = 0; c < 3; ++c)
      if (look_.smooth->on_boundary(f.triangle, c) && !part_within(box, f.at[c], f.at[(c + 1) % 3]).empty()) return true;
    return false;
  }

  // Whether the surface's sides within the box lie on the piece.
  bool lies_on(const FacingTriangle& f, const CurvedPiece& piece, const Bounds& box) {
    const TriangleMesh& mesh = look_.faces.mesh();
    double most_bend = 0.0;
    for (int c = 0; c < 3; ++c) {
      const dvec3 bend = look_.smooth->bend(f.triangle, c);
      most_bend = std::max(most_bend, glm::length(bend));
      const Range part = part_within(box, f.at[c], f.at[(c + 1) % 3]);
      if (part.empty()) continue;
      const dvec3 start = mesh.vertices[mesh.triangles[f.triangle][c]],
                  along = mesh.vertices[mesh.triangles[f.triangle][(c + 1) % 3]] - start;
      for (const double x : {part.low, part.high})
        phase_off_ = std::max(phase_off_, 2.0 * highest_ * piece.distance(start + x * along - x * (1.0 - x) * bend));
    }
    // A facet wider than the cell has no side in it. It may rise from its plane by half of its strongest bend.
    const dvec2 middle = 0.5 * (box.low + box.high);
    const bool on_piece = !f.contains(middle) || piece.distance(above(middle) + facet_depth(f)(middle) * look_.grid.direction) <
                                                     0.5 * most_bend + look_.phase_tolerance / (2.0 * highest_);
    return on_piece && phase_off_ < look_.phase_tolerance;
  }

  // The facet at a point of the cell among those for which belongs(facet) holds; else `other`.
  template <class Belongs>
  std::uint32_t facet_at(const dvec2& at, std::span<const std::uint32_t> triangles, std::uint32_t other, Belongs belongs) const {
    const auto holds = [&](std::uint32_t t) { return belongs(facing_[t]) && facing_[t].contains(at); };
    const auto found = std::ranges::find_if(triangles, holds);
    return found == triangles.end() ? other : facing_[*found].triangle;
  }

  // The facet of the piece's own surface there.
  std::uint32_t surface_at(const dvec2& at, std::span<const std::uint32_t> triangles) const {
    return facet_at(at, triangles, base_->triangle, [&](const FacingTriangle& f) { return f.region == base_->region; });
  }

  // The part of a piece within a box or a polygon.
  template <class Shape, class TriangleAt>
  void add(const CurvedPiece& piece, const Shape& shape, TriangleAt triangle_at) {
    const std::vector<ScatteringMatrix> part = curved_far_field(light_, piece, shape, &sums_);
    add(part);
    if (!look_.map) return;
    look_.map->add(0, shape, triangle_at, part[look_.map->frequency_index()],
                   [&](const Shape& of) { return curved_far_field(map_light_, piece, of).front(); });
  }

  // A piece that lies off the surface by some phase is wrong by as large a share of its far field. Twice: sides are only looked
  // at where they enter and leave the cell.
  void add(const std::vector<ScatteringMatrix>& part, int bounce = 0) {
    std::vector<ScatteringMatrix>& sums = sums_.at(bounce, part.size());
    ++sums_.hits[static_cast<std::size_t>(bounce)];
    sums_.pieces.resize(part.size());
    for (std::size_t f = 0; f < part.size(); ++f) {
      sums[f] += part[f];
      ScatteringMatrix error = part[f];
      sums_.pieces[f].add(error *= 2.0 * phase_off_ + curved_integration_error);
    }
  }

  void facets(const Bounds& box, std::span<const std::uint32_t> triangles) {
    parts_.clear();
    phase_off_ = 0.0;
    const std::vector<std::uint32_t>& patch_of = look_.faces.mesh().triangle_patch;
    visible_.within(incident_, rectangle(box), parts_);
    for (const VisiblePart& part : parts_) {
      if (through_sheets_ && through_sheets_->is_sheet(look_.faces.faces()[part.face].triangle))
        through_sheets_->go_through(sums_, part);
      if (region(part.face) == no_index) continue;
      const dvec2 at = middle(part.outline);
      const std::uint32_t first = look_.faces.faces()[part.face].triangle;
      const auto of_face = [&](const FacingTriangle& f) { return patch_of[f.triangle] == patch_of[first]; };
      const std::uint32_t facet = facet_at(at, triangles, first, of_face);
      add(piece_over(look_, at, facet), part.outline, [&](const dvec2&) { return facet; });
      if (through_sheets_ && elsewhere_) through_sheets_->screen(sums_, part);
    }
  }

  const TubeLook& look_;
  std::span<const FacingTriangle> facing_;
  Beam incident_;
  Band band_;
  Illumination light_, map_light_;
  std::vector<Material> map_materials_;  // at the map's frequency
  double highest_;                       // wavenumber [rad/m]
  double smallest_;                      // cell [m]
  BeamVisibility visible_;
  std::optional<CurvedThroughSheets> through_sheets_;  // where there are sheets
  bool elsewhere_;                                     // see looks_from_elsewhere()
  const FacingTriangle* base_ = nullptr;
  double phase_off_ = 0.0;  // of the facets' sides from the piece in question [rad], at the highest frequency
  ConvexPolygon clipped_, inside_;
  std::vector<VisiblePart> parts_;
  TubeSums sums_;
};

}  // namespace

CurvedLook::CurvedLook(const TubeLook& look) : look_(look), facing_(facing_triangles(look)) { fill_blocks(); }

void CurvedLook::fill_blocks() {
  const dvec2 low(look_.grid.u_begin, look_.grid.v_begin);
  const dvec2 size = dvec2(look_.grid.columns * look_.grid.du, look_.grid.rows * look_.grid.dv) / static_cast<double>(across);
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column)
      blocks_.push_back({{low + dvec2(column, row) * size, low + dvec2(column + 1, row + 1) * size}, {}});
  for (std::uint32_t t = 0; t < facing_.size(); ++t) {
    const Bounds box = facing_[t].bounds();
    const glm::ivec2 first = glm::max(glm::ivec2(glm::floor((box.low - low) / size - 1e-9)), 0),
                     last = glm::min(glm::ivec2((box.high - low) / size + 1e-9), across - 1);
    for (int row = first.y; row <= last.y; ++row)
      for (int column = first.x; column <= last.x; ++column) blocks_[row * across + column].triangles.push_back(t);
  }
}

TubeSums CurvedLook::trace(std::size_t block) const {
  return CellTrace(look_, facing_).run(blocks_[block].box, blocks_[block].triangles);
}

}  // namespace raytube
