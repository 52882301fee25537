#include "mesh/model/mesh_bytes.h"

#include <stdexcept>

#include "core/bytes.h"

namespace raytube {

namespace {

// One list of members for both ways.
template <class Archive, class Mesh>
void visit(Archive& archive, Mesh& mesh) {
  archive(mesh.vertices), archive(mesh.triangles), archive(mesh.triangle_patch), archive(mesh.triangle_component);
  archive(mesh.patches), archive(mesh.components), archive(mesh.triangle_part), archive(mesh.part_names);
  archive(mesh.center), archive(mesh.radius), archive(mesh.coordinate_step);
}

}  // namespace

std::string bytes_of_mesh(const TriangleMesh& mesh) {
  ByteWriter writer;
  visit(writer, mesh);
  return writer.take();
}

TriangleMesh mesh_of_bytes(std::string_view bytes) {
  TriangleMesh mesh;
  ByteReader reader(bytes);
  visit(reader, mesh);
  if (!reader.fits()) throw std::runtime_error("the bytes of a mesh are not complete");
  return mesh;
}

}  // namespace raytube
