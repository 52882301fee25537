#include "mesh/soundness/solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "mesh/model/triangle_pairs.h"

namespace raytube {

namespace {

// Inside of a conductor or an absorber nothing is asked of layers.
bool may_stand_inside(std::span<const Material> materials, std::uint32_t material) {
  return material == no_index || (materials[material].roughness == 0.0 && (materials[material].kind == MaterialKind::conductor ||
                                                                           materials[material].kind == MaterialKind::absorber));
}

// [component] the solid that it carries somewhere; no_index: none.
std::vector<std::uint32_t> solids_of(const TriangleMesh& mesh, std::span<const Material> materials) {
  std::vector<std::uint32_t> solids(mesh.components.size(), no_index);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (is_solid(materials, mesh.patch_of(t).material)) solids[mesh.triangle_component[t]] = mesh.patch_of(t).material;
  return solids;
}

void check_whole_bodies(const TriangleMesh& mesh, std::span<const Material> materials, const std::vector<std::uint32_t>& solids) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t component = mesh.triangle_component[t], solid = solids[component];
    if (solid == no_index) continue;
    const std::string name = quotable(materials[solid].name);
    if (!mesh.components[component].closed)
      throw InputError(
          fmt::format("material \"{}\" of kind \"solid\" is on a surface that is not closed, so that it fills nothing; "
                      "close the mesh there, or write kind = \"sheet\" or \"dielectric\"",
                      name));
    if (mesh.patch_of(t).material != solid)
      throw InputError(
          fmt::format("material \"{}\" of kind \"solid\" is on a part of a body only; give it to all of the body, or "
                      "write kind = \"coated\" or \"dielectric\"",
                      name));
  }
}

// Two triangles, of different bodies.
struct Contact {
  std::uint32_t first, second;  // `second` is a triangle of the solid
};

// Of triangles with a corner in common so much is looked at.
constexpr double inner_part = 0.98;

Corners inner(Corners corners) {
  const dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  for (dvec3& corner : corners) corner = middle + inner_part * (corner - middle);
  return corners;
}

bool touch(const TriangleMesh& mesh, std::uint32_t t, std::uint32_t other, double margin) {
  const Corners a = mesh.corners(t), b = mesh.corners(other);
  if (!share_corner(mesh.triangles[t], mesh.triangles[other])) return !are_apart(a, b, margin);
  return !are_apart(inner(a), inner(b), margin);
}

// The first triangle that comes within rounding of one of a solid of another component; where they have a corner in common, one
// that also goes on beyond it.
std::optional<Contact> find_contact(const FaceTree& faces, const std::vector<std::uint32_t>& solids) {
  const TriangleMesh& mesh = faces.mesh();
  const double margin = flat_fraction * 2.0 * mesh.radius;
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    collect_near(faces, mesh.corners(t), margin, found);
    for (const std::uint32_t face : found)
      for (const std::uint32_t other : faces.triangles(face)) {
        const std::uint32_t component = mesh.triangle_component[other];
        if (component != mesh.triangle_component[t] && solids[component] != no_index && touch(mesh, t, other, margin))
          return Contact{t, other};
      }
  }
  return {};
}

void check_contacts(const FaceTree& faces, std::span<const Material> materials, const std::vector<std::uint32_t>& solids) {
  const TriangleMesh& mesh = faces.mesh();
  if (mesh.components.size() == 1) return;
  const std::optional<Contact> contact = find_contact(faces, solids);
  if (!contact) return;
  const dvec3 at = mesh.vertices[mesh.triangles[contact->first][0]] + mesh.center;
  throw InputError(
      fmt::format("a body of {}, with a corner at ({:.6g}, {:.6g}, {:.6g}) m, touches one of kind \"solid\", \"{}\", or runs "
                  "through it; leave a gap between them, for which a hundredth of a wavelength will do",
                  material_text(materials, mesh.patch_of(contact->first).material), at.x, at.y, at.z,
                  quotable(materials[solids[mesh.triangle_component[contact->second]]].name)));
}

// Components that do not touch are inside with all of their corners or with none.
void check_inside(const TriangleMesh& mesh, std::span<const Material> materials, const std::vector<std::uint32_t>& solids) {
  const TriangleRows of_component = triangle_rows(mesh.components.size(), mesh.triangle_component);
  std::vector<bool> seen(mesh.components.size() * (materials.size() + 1), false);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t own = mesh.triangle_component[t], material = mesh.patch_of(t).material;
    if (may_stand_inside(materials, material)) continue;
    if (seen[own * (materials.size() + 1) + material]) continue;
    seen[own * (materials.size() + 1) + material] = true;
    for (std::uint32_t c = 0; c < solids.size(); ++c)
      if (c != own && solids[c] != no_index && winding_number(mesh, of_component[c], mesh.vertices[mesh.triangles[t][0]]) > 0.5)
        throw InputError(
            fmt::format("a body of material \"{}\" stands inside of one of \"{}\", of kind \"solid\", where only smooth "
                        "conductors and absorbers can be; leave it out of the mesh, or make it \"pec\"",
                        quotable(materials[material].name), quotable(materials[solids[c]].name)));
  }
}

}  // namespace

void check_solids(const FaceTree& faces, std::span<const Material> materials) {
  if (!any_solid(materials)) return;
  const TriangleMesh& mesh = faces.mesh();
  const std::vector<std::uint32_t> solids = solids_of(mesh, materials);
  check_whole_bodies(mesh, materials, solids);
  check_contacts(faces, materials, solids);
  check_inside(mesh, materials, solids);
}

}  // namespace raytube
