#include "uncertainty/target_features.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "mesh/model/edge_table.h"
#include "uncertainty/constants.h"

namespace raytube {

using namespace uncertainty;

namespace {

// The end of a wedge.
struct WedgeEnd {
  dvec3 point, away;  // unit vector along the wedge, away from it
  std::uint32_t wedge;
};

// In single precision: what thin plates are merged into ends at the same points to rounding only.
auto order_of(const dvec3& p) { return std::tuple(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)); }

bool counts(const Wedge& wedge) { return wedge.stands_alone() && !wedge.enclosed; }

std::vector<WedgeEnd> ends_of(std::span<const Wedge> wedges) {
  std::vector<WedgeEnd> ends;
  for (std::uint32_t i = 0; i < wedges.size(); ++i) {
    if (!counts(wedges[i])) continue;
    const dvec3 along = glm::normalize(wedges[i].end - wedges[i].start);
    ends.push_back({wedges[i].start, along, i});
    ends.push_back({wedges[i].end, -along, i});
  }
  std::ranges::sort(ends, {}, [](const WedgeEnd& e) { return std::tuple(order_of(e.point), e.wedge); });
  return ends;
}

// Calls visit(ends) for every point at which wedges end.
template <class Visit>
void for_each_point(std::span<const WedgeEnd> ends, Visit visit) {
  for (std::size_t first = 0; first < ends.size();) {
    std::size_t last = first + 1;
    while (last < ends.size() && order_of(ends[last].point) == order_of(ends[first].point)) ++last;
    visit(ends.subspan(first, last - first));
    first = last;
  }
}

// Two wedges that go on in one another, more or less.
bool goes_on(std::span<const WedgeEnd> ends) {
  return ends.size() == 2 && glm::length(ends[0].away + ends[1].away) < 2.0 * std::sin(0.5 * least_turn);
}

// How strong the currents of an edge of this face are, over those of a conductor's.
double strength_of(const WedgeFace& face, const EdgeCurrents& currents) {
  if (face.material == no_index) return 1.0;
  return currents.material_strengths.empty() ? 0.0 : currents.material_strengths[face.material];
}

double strength_of(const Wedge& wedge, const EdgeCurrents& currents) {
  return std::max(strength_of(wedge.faces[0], currents), strength_of(wedge.faces[1], currents));
}

void add_corner(EdgeFeatures& features, std::span<const Wedge> wedges, std::span<const WedgeEnd> ends,
                const EdgeCurrents& currents) {
  if (goes_on(ends)) return;
  dvec3 sum{0.0};
  SharpCorner corner{0.0, 0.0, static_cast<std::uint32_t>(features.corner_normals.size()), 0};
  for (const WedgeEnd& end : ends) {
    const Wedge& wedge = wedges[end.wedge];
    sum += end.away;
    corner.weight = std::max(corner.weight, strength_of(wedge, currents) * std::min(wedge.n - 1.0, 1.0));
    corner.reach = std::max(corner.reach, wedge.length());
    for (const WedgeFace& face : wedge.faces) features.corner_normals.push_back(face.normal);
  }
  corner.weight *= std::min(glm::length(sum), 1.0);
  corner.last_normal = static_cast<std::uint32_t>(features.corner_normals.size());
  features.corners.push_back(corner);
}

double missing_share(const Wedge& wedge, const EdgeCurrents& currents) {
  if (wedge.conducting()) return currents.conductors ? 0.0 : 1.0;
  const double all = strength_of(wedge, currents);
  const auto sheet_share = [&](const WedgeFace& face) {
    return face.material == no_index || currents.sheet_shares.empty() ? 0.0 : currents.sheet_shares[face.material];
  };
  if (!currents.materials) return material_share * all;
  const double there = std::max(sheet_share(wedge.faces[0]), sheet_share(wedge.faces[1]));
  if (there == 0.0) return opaque_share * all;
  return (wedge.is_border() ? std::lerp(material_share, rim_share, there) : material_share) * all;
}

// Wedges that go on in one another, or lie beside one narrow face, are one run.
std::vector<std::uint32_t> find_runs(std::span<const Wedge> wedges, std::span<const WedgeEnd> ends, std::size_t patches,
                                     double wavelength) {
  DisjointSets runs(wedges.size());
  for_each_point(ends, [&](std::span<const WedgeEnd> here) {
    if (goes_on(here)) runs.join(here[0].wedge, here[1].wedge);
  });
  std::vector<std::uint32_t> first(patches, no_index);  // of the wedges beside a face
  for (std::uint32_t i = 0; i < wedges.size(); ++i)
    for (const WedgeFace& face : wedges[i].faces) {
      if (!counts(wedges[i]) || face.patch == no_index || !is_narrow(face.width, wavelength)) continue;
      std::uint32_t& other = first[face.patch];
      if (other == no_index) other = i;
      runs.join(other, i);
    }
  return runs.numbers();
}

double triangle_area(const TriangleMesh& mesh, std::uint32_t triangle) { return 0.5 * mesh.twice_area(triangle); }

// Angle between the normals of the two patches at an edge; 0 where more or fewer than two triangles meet [rad].
double crease_angle(const TriangleMesh& mesh, const EdgeTable::Edge& edge) {
  if (edge.sides.size() != 2) return 0.0;
  const EdgeTable::Side &first = edge.sides[0], &second = edge.sides[1];
  const dvec3& a = mesh.patch_of(first.triangle).normal;
  const dvec3& b = mesh.patch_of(second.triangle).normal;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, mesh.is_turned(first, second) ? -b : b));
}

// Sets of triangles that patches and creases join. `ends` says of each patch whether it has an edge.
std::vector<FaceExtent> face_extents(const TriangleMesh& mesh, std::span<const SmoothCrease> creases,
                                     const std::vector<bool>& ends) {
  DisjointSets joined(mesh.patches.size());
  for (const SmoothCrease& crease : creases) {
    const auto [first, second] = crease.triangles;
    joined.join(mesh.triangle_patch[second], mesh.triangle_patch[first]);
  }
  std::vector<FaceExtent> faces(mesh.patches.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t patch = mesh.triangle_patch[t];
    FaceExtent& face = faces[joined.root(patch)];
    face.area += triangle_area(mesh, t);
    face.ends = face.ends || ends[patch];
    face.material = mesh.patches[patch].material;
  }
  std::erase_if(faces, [](const FaceExtent& face) { return face.area == 0.0; });
  faces.shrink_to_fit();  // one for each facet of a curved surface went
  return faces;
}

}  // namespace

PenumbraShares penumbra_shares(std::span<const FaceExtent> faces, double wavelength, std::span<const Material> materials) {
  double all = 0.0, edges = 0.0, smooth = 0.0, shells = 0.0;
  for (const FaceExtent& face : faces) {
    all += face.area;
    if (!face.ends && face.material != no_index && !materials.empty() && materials[face.material].transmits())
      shells += face.area;
    (face.ends ? edges : smooth) += face.area * std::min(1.0, wavelength / std::sqrt(face.area));
  }
  if (all == 0.0) return {};
  return {std::sqrt(edges / all), std::sqrt(smooth / all), std::sqrt(shells / all)};
}

CurvedParts find_curved_parts(const TriangleMesh& mesh, double min_wedge_angle) {
  CurvedParts parts;
  parts.patches.resize(mesh.patches.size());
  std::vector<bool> ends(mesh.patches.size());
  const EdgeTable& edges = mesh.edges();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const double angle = crease_angle(mesh, edges[e]);
    const bool sharp = angle >= min_wedge_angle && !mesh.is_bend(edges[e].low, edges[e].high);
    if (sharp || edges[e].sides.size() != 2)
      for (const EdgeTable::Side& side : edges[e].sides) ends[mesh.triangle_patch[side.triangle]] = true;
    if (sharp || angle < flat_crease) continue;
    const std::uint32_t a = edges[e].sides[0].triangle, b = edges[e].sides[1].triangle;
    const double along = glm::distance(mesh.vertices[edges[e].low], mesh.vertices[edges[e].high]);
    const double area = triangle_area(mesh, a) + triangle_area(mesh, b), step = area / along;  // mean width across the crease
    parts.creases.push_back({{a, b},
                             static_cast<float>(along),
                             static_cast<float>(step / angle),
                             static_cast<float>(angle),
                             static_cast<float>(0.5 * area)});
    parts.patches[mesh.triangle_patch[a]] = parts.patches[mesh.triangle_patch[b]] = true;
  }
  parts.faces = face_extents(mesh, parts.creases, ends);
  return parts;
}

EdgeFeatures find_edge_features(std::span<const Wedge> wedges, const CurvedParts& curved, const EdgeCurrents& currents,
                                double wavelength) {
  EdgeFeatures features;
  const std::vector<WedgeEnd> ends = ends_of(wedges);
  for_each_point(ends, [&](std::span<const WedgeEnd> here) { add_corner(features, wedges, here, currents); });
  const std::vector<std::uint32_t> runs = find_runs(wedges, ends, curved.patches.size(), wavelength);
  const auto is_curved = [&](const WedgeFace& face) { return face.patch != no_index && curved.patches[face.patch]; };
  for (std::size_t i = 0; i < wedges.size(); ++i) {
    const Wedge& wedge = wedges[i];
    if (!counts(wedge)) continue;
    const bool beside_curved = std::ranges::any_of(wedge.faces, is_curved);
    const double share = currents.over_curved && wedge.conducting() ? followed_faces_share : curved_faces_share;
    const double missing = std::max(missing_share(wedge, currents), beside_curved ? share : 0.0);
    const double width = std::min(wedge.faces[0].width, wedge.faces[1].width);
    if (missing == 0.0 && !is_narrow(width, wavelength)) continue;
    features.edges.push_back({.middle = 0.5 * (wedge.start + wedge.end),
                              .half = 0.5 * (wedge.end - wedge.start),
                              .normals = {wedge.faces[0].normal, wedge.faces[1].normal},
                              .sharpness = std::min(wedge.n - 1.0, 1.0),
                              .missing = missing,
                              .width = width,
                              .curved = beside_curved,
                              .run = runs[i]});
  }
  std::ranges::stable_sort(features.edges, {}, &WeakEdge::run);
  return features;
}

double curved_share(std::span<const WeakEdge> edges) {
  double all = 0.0, curved = 0.0;
  for (const WeakEdge& edge : edges) {
    const double length = glm::length(edge.half);
    all += length;
    if (edge.curved) curved += length;
  }
  return all > 0.0 ? curved / all : 0.0;
}

}  // namespace raytube
