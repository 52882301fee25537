#include "mesh/smooth/smooth.h"

#include <algorithm>
#include <cmath>

#include "mesh/smooth/corner_normals.h"

namespace raytube {

namespace {

// Twice the harmonic mean; nothing of what bends both ways. The mean of a wide flank's and a narrow nose's curvature that does
// not make the flank bulge.
double twice_harmonic_mean(double a, double b) { return a * b > 0.0 ? 4.0 * a * b / (a + b) : 0.0; }

// A side leans off the normals at its ends by less than this many of the steepest creases where it is a chord, and by so much at
// most; of a surface no more than this share may lean more.
constexpr double most_creases = 1.5, widest_lean = 60.0 * degree, doubtful_share = 0.01;

// The end of a side: the normal there, and whether it knows one side of the vertex only.
struct SideEnd {
  const dvec3& normal;
  bool one_sided;
};

// The parabola over a side between these ends, r = a + x (b - a) - x (1 - x) bend (a.normal + b.normal). How far the
// normals lean along the side tells the curvature at its ends; one of which says nothing has the other's. Nothing where one
// leans by more than a share of the side that no chord does, or where they are a right angle apart and more.
double bend_of(const dvec3& side, const SideEnd& a, const SideEnd& b, double steepest) {
  if (glm::dot(a.normal, b.normal) <= 0.0) return 0.0;
  const dvec3 sum = a.normal + b.normal;
  double lean_a = glm::dot(a.normal, side), lean_b = -glm::dot(b.normal, side);
  if (a.one_sided && !b.one_sided) lean_a = lean_b;
  if (b.one_sided && !a.one_sided) lean_b = lean_a;
  if (std::max(std::abs(lean_a), std::abs(lean_b)) > steepest * glm::length(side)) return 0.0;
  return twice_harmonic_mean(lean_a, lean_b) / glm::dot(sum, sum);
}

double steepest_lean(double crease) { return std::sin(std::min(most_creases * crease, widest_lean)); }

}  // namespace

SmoothSurfaces::SmoothSurfaces(const TriangleMesh& mesh, double max_crease, double max_rise)
    : SmoothSurfaces(mesh, find_chords(mesh, max_crease), nullptr, max_crease, max_rise) {}

SmoothSurfaces::SmoothSurfaces(const SmoothSurfaces& others, double max_crease, double max_rise)
    : SmoothSurfaces(others.mesh_, others.has_chords_of(max_crease) ? others.chords_ : find_chords(others.mesh_, max_crease),
                     others.sides_->max_crease == max_crease ? others.sides_ : nullptr, max_crease, max_rise) {}

SmoothSurfaces::SmoothSurfaces(const TriangleMesh& mesh, std::shared_ptr<const Chords> chords, std::shared_ptr<const Sides> sides,
                               double max_crease, double max_rise)
    : mesh_(mesh),
      chords_(std::move(chords)),
      sides_(sides ? std::move(sides) : find_sides(mesh, *chords_, max_crease)),
      region_(chords_->region) {
  keep_flat(max_rise);
  count_facets();
}

bool SmoothSurfaces::has_chords_of(double max_crease) const {
  return chords_->steepest_crossed > std::cos(max_crease) && chords_->flattest_left <= std::cos(max_crease);
}

std::shared_ptr<const SmoothSurfaces::Chords> SmoothSurfaces::find_chords(const TriangleMesh& mesh, double max_crease) {
  const Creases creases(mesh, max_crease);
  CornerNormals corners(mesh, creases);
  auto chords = std::make_shared<Chords>(Chords{creases.steepest_crossed(), creases.flattest_left(), {}, {}, {}, {}, {}});
  chords->corner_normal = std::move(corners.group);
  chords->normals = std::move(corners.normals);
  chords->one_sided = std::move(corners.one_sided);
  find_regions(mesh, creases, corners.is_plane, *chords);
  return chords;
}

// Round a vertex of a smooth surface no facet leans off the normal by more than one crease turns; round the tip of a cone all do.
std::shared_ptr<const SmoothSurfaces::Sides> SmoothSurfaces::find_sides(const TriangleMesh& mesh, const Chords& chords,
                                                                        double max_crease) {
  auto sides = std::make_shared<Sides>(
      Sides{max_crease, std::vector<double>(mesh.vertices.size(), steepest_lean(max_crease)), chords.one_sided, {}});
  std::vector<double> cosines(mesh.vertices.size(), std::cos(max_crease));
  for (const Bend& bend : mesh.bends)
    for (const std::uint32_t v : {bend.low, bend.high}) {
      sides->steepest[v] = std::max(sides->steepest[v], steepest_lean(bend.angle));
      cosines[v] = std::min(cosines[v], std::cos(bend.angle));
    }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t normal = chords.corner_normal[3 * std::size_t{t} + corner];
      if (glm::dot(mesh.patch_of(t).normal, chords.normals[normal]) < cosines[mesh.triangles[t][corner]])
        sides->one_sided[normal] = true;
    }
  find_bends(mesh, chords, *sides);
  return sides;
}

void SmoothSurfaces::find_bends(const TriangleMesh& mesh, const Chords& chords, Sides& sides) {
  const auto is_curved = [](std::uint32_t region) { return region != no_index; };
  if (std::ranges::none_of(chords.region, is_curved)) return;
  sides.bends.resize(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_curved(chords.region[t])) continue;
    const Triangle& corners = mesh.triangles[t];
    const auto end = [&](int c) {
      const std::uint32_t normal = chords.corner_normal[3 * std::size_t{t} + c];
      return SideEnd{chords.normals[normal], sides.one_sided[normal]};
    };
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3;
      sides.bends[3 * std::size_t{t} + c] = bend_of(mesh.vertices[corners[next]] - mesh.vertices[corners[c]], end(c), end(next),
                                                    std::max(sides.steepest[corners[c]], sides.steepest[corners[next]]));
    }
  }
}

void SmoothSurfaces::keep_components(const std::vector<bool>& kept) {
  for (std::uint32_t t = 0; t < region_.size(); ++t)
    if (!kept[mesh_.triangle_component[t]]) region_[t] = no_index;
  count_facets();
}

void SmoothSurfaces::flatten(const std::vector<bool>& materials) {
  for (std::uint32_t t = 0; t < region_.size(); ++t) {
    const std::uint32_t material = mesh_.patch_of(t).material;
    if (material != no_index && materials[material]) region_[t] = no_index;
  }
  count_facets();
}

void SmoothSurfaces::count_facets() {
  facets_ = 0, rise_ = 0.0;
  for (std::uint32_t t = 0; t < region_.size(); ++t) {
    if (region_[t] == no_index) continue;
    ++facets_;
    rise_ = std::max(rise_, rise(t));
  }
}

void SmoothSurfaces::find_regions(const TriangleMesh& mesh, const Creases& creases, const std::vector<bool>& is_plane,
                                  Chords& chords) {
  const auto bends = [&](std::uint32_t t) { return !is_plane[creases.plane(t)]; };
  const auto material = [&](std::uint32_t t) { return mesh.patch_of(t).material; };
  chords.boundary.assign(3 * mesh.triangles.size(), true);
  DisjointSets surfaces(mesh.triangles.size());
  for (std::size_t e = 0; e < creases.edges().size(); ++e) {
    if (!creases.crossable(e)) continue;
    const auto sides = creases.edges()[e].sides;
    const std::uint32_t a = sides[0].triangle, b = sides[1].triangle;
    if (!bends(a) || !bends(b) || material(a) != material(b)) continue;
    for (const EdgeTable::Side& side : sides) chords.boundary[3 * std::size_t{side.triangle} + side.corner] = false;
    surfaces.join(a, b);
  }
  chords.region = surfaces.numbers();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (!bends(t)) chords.region[t] = no_index;
}

double SmoothSurfaces::rise(std::uint32_t triangle) const {
  return 0.25 * std::max({glm::length(bend(triangle, 0)), glm::length(bend(triangle, 1)), glm::length(bend(triangle, 2))});
}

bool SmoothSurfaces::is_doubtful(std::uint32_t triangle) const {
  const Triangle& t = mesh_.triangles[triangle];
  const auto leans = [&](int corner, const dvec3& side) {
    return !sides_->one_sided[normal_index(triangle, corner)] &&
           std::abs(glm::dot(normal(triangle, corner), side)) > sides_->steepest[t[corner]] * glm::length(side);
  };
  for (int c = 0; c < 3; ++c) {
    const int next = (c + 1) % 3;
    const dvec3 side = mesh_.vertices[t[next]] - mesh_.vertices[t[c]];
    if (leans(c, side) || leans(next, side)) return true;
  }
  return false;
}

// A surface of which one half is curved and the other half facets is worse than either: the halves are out of phase.
void SmoothSurfaces::keep_flat(double max_rise) {
  std::vector<double> risen(mesh_.triangles.size(), 0.0), areas(mesh_.triangles.size(), 0.0),
      doubtful(mesh_.triangles.size(), 0.0);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    if (region_[t] == no_index) continue;
    const double area = mesh_.twice_area(t);
    risen[region_[t]] += area * rise(t);
    areas[region_[t]] += area;
    if (is_doubtful(t)) doubtful[region_[t]] += area;
  }
  const auto stays_flat = [&](std::uint32_t region) {
    return risen[region] > max_rise * areas[region] || doubtful[region] > doubtful_share * areas[region];
  };
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
    if (region_[t] != no_index && stays_flat(region_[t])) region_[t] = no_index;
}

double SmoothSurfaces::boundary_length() const {
  double sum = 0.0;
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
      if (region_[t] != no_index && on_boundary(t, c))
        sum += glm::distance(mesh_.vertices[mesh_.triangles[t][c]], mesh_.vertices[mesh_.triangles[t][(c + 1) % 3]]);
  return sum;
}

namespace {

// Where the line meets it: Newton's method across the line, from the facet's plane. Nothing if that does not settle near it.
std::optional<dvec2> meet(const BentFacet& s, const dvec3& origin, const dvec3& direction) {
  dvec2 l(1.0 / 3.0);
  const double size = glm::distance(s.corners()[1], s.corners()[0]) + glm::distance(s.corners()[2], s.corners()[0]);
  for (int step = 0; step < 12; ++step) {
    // Solves off + dl1 a + dl2 b = (anything) direction.
    const dvec3 off = s.point(l) - origin, a = s.along_1(l), b = s.along_2(l);
    const double determinant = glm::dot(glm::cross(a, b), direction);
    if (std::abs(determinant) < 1e-12 * size * size) return {};
    const dvec2 change = -dvec2(glm::dot(glm::cross(off, b), direction), glm::dot(glm::cross(a, off), direction)) / determinant;
    l += change;
    if (std::max(std::abs(l.x - 1.0 / 3.0), std::abs(l.y - 1.0 / 3.0)) > 4.0) return {};
    if (std::max(std::abs(change.x), std::abs(change.y)) < 1e-10) return l;
  }
  return {};
}

LocalSurface facet_plane(const Patch& patch, const dvec3& origin, const dvec3& direction) {
  const bool from_front = glm::dot(patch.normal, direction) < 0.0;
  return {origin + patch.distance(origin, direction) * direction, from_front ? patch.normal : -patch.normal, glm::dmat3(0.0)};
}

// Second fundamental form of a parametrised surface with tangents a1, a2 and second derivatives r11, r12, r22 (do Carmo 1976,
// section 3-3), as a matrix of space, with the stronger principal curvature along the normal.
glm::dmat3 curvature_of(const dvec3& a1, const dvec3& a2, const dvec3& n, const dvec3& r11, const dvec3& r12, const dvec3& r22) {
  const dvec3 dual1 = glm::cross(a2, n) / glm::dot(a1, glm::cross(a2, n)),
              dual2 = glm::cross(n, a1) / glm::dot(a2, glm::cross(n, a1));
  const double l = glm::dot(n, r11), m = glm::dot(n, r12), r = glm::dot(n, r22);
  const dvec3 area = glm::cross(a1, a2);
  const double sum = l * glm::dot(dual1, dual1) + 2.0 * m * glm::dot(dual1, dual2) + r * glm::dot(dual2, dual2);
  const double product = (l * r - m * m) / glm::dot(area, area);
  const double stronger = 0.5 * sum + std::copysign(std::sqrt(std::max(0.0, 0.25 * sum * sum - product)), sum);
  return l * glm::outerProduct(dual1, dual1) + m * (glm::outerProduct(dual1, dual2) + glm::outerProduct(dual2, dual1)) +
         r * glm::outerProduct(dual2, dual2) + stronger * glm::outerProduct(n, n);
}

}  // namespace

SurfacePoint BentFacet::over(const dvec3& r) const {
  const dvec3 e1 = x_[1] - x_[0], e2 = x_[2] - x_[0], across = glm::cross(e1, e2), step = r - x_[0];
  const double square = glm::dot(across, across);
  const dvec2 l{glm::dot(glm::cross(step, e2), across) / square, glm::dot(glm::cross(e1, step), across) / square};
  const dvec3 normal = glm::cross(along_1(l), along_2(l));
  const double size = glm::length(normal);
  return {point(l), normal / size, size / std::sqrt(square)};
}

LocalSurface SmoothSurfaces::at(const dvec3& origin, const dvec3& direction, std::uint32_t triangle) const {
  const Patch& patch = mesh_.patch_of(triangle);
  const BentFacet s = facet(triangle);
  const std::optional<dvec2> l = meet(s, origin, direction);
  if (!l) return facet_plane(patch, origin, direction);
  const dvec3 a1 = s.along_1(*l), a2 = s.along_2(*l);
  dvec3 n = glm::normalize(glm::cross(a1, a2));
  const bool from_front = glm::dot(patch.normal, direction) < 0.0;
  if ((glm::dot(n, direction) < 0.0) != from_front) return facet_plane(patch, origin, direction);
  if (!from_front) n = -n;
  const dvec3 point = origin + glm::dot(s.point(*l) - origin, direction) * direction;
  return {point, n, curvature_of(a1, a2, n, 2.0 * s.bend(0), s.bend(0) - s.bend(1) + s.bend(2), 2.0 * s.bend(2))};
}

}  // namespace raytube
