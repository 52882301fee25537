// The JSON of a glTF file, looked into with a sentence for whatever is not there or not as it should be.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/ordered_json.h"
#include "mesh/read/formats.h"

namespace raytube {

/// The two parts of a glTF 2.0 file: its JSON, and what stands behind that in a binary one (.glb).
struct GltfDocument {
  const MeshFile& file;
  std::shared_ptr<const Json> json;
  std::string_view binary;

  /// Element `index` of a list at top level; rejects the file if there is none.
  const Json& element(std::string_view list, std::uint64_t index) const;

  /// Member of a table that is a list; empty if there is none.
  std::span<const Json> list(const Json& table, std::string_view name) const;

  /// Member of a table that is a whole number and not negative; without it `otherwise`.
  std::uint64_t whole(const Json& table, std::string_view name, std::uint64_t otherwise) const;
  std::uint64_t required_whole(const Json& table, std::string_view name) const;
  std::uint64_t whole(const Json& value) const;

  double number(const Json& value) const;
};

/// Throws InputError if the file is no glTF 2.x, text or binary, or needs an extension that changes the surface.
GltfDocument read_gltf_document(const MeshFile& file);

}  // namespace raytube
