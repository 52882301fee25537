// A glTF file: its JSON, looked into with a sentence for whatever is not there or not as it should be, and its numbers: buffers,
// views of them, and accessors (Khronos, glTF 2.0 specification, section 3.6).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/field.h"
#include "core/ordered_json.h"
#include "mesh/files/numbers.h"
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

/// Reads accessors. The document must outlive it.
class GltfData {
 public:
  /// Loads all buffers: the binary chunk, base64 in the file, files beside it. Throws InputError.
  explicit GltfData(const GltfDocument& document);

  std::vector<dvec3> positions(std::uint64_t accessor) const;
  std::vector<std::uint32_t> indices(std::uint64_t accessor) const;

  /// Of the file and all its buffers.
  std::uint64_t bytes() const { return bytes_; }
  const std::vector<std::filesystem::path>& further_files() const { return further_files_; }

 private:
  struct Layout {
    std::string_view bytes;  // from the first number on; empty: all are zero
    std::uint64_t count, components, stride;
    NumberType type;
    bool normalized;

    double value(std::uint64_t element, std::uint64_t component) const;
  };

  std::string load_buffer(const Json& buffer, std::uint64_t index);
  std::string load_file(const std::string& uri);
  NumberType number_type(std::uint64_t component_type) const;
  std::string_view view_part(std::uint64_t index, std::uint64_t offset, std::uint64_t bytes) const;
  Layout layout(const Json& accessor, std::uint64_t components) const;
  Layout sparse_layout(const Json& part, std::uint64_t count, std::uint64_t components, std::uint64_t component_type) const;
  void replace_sparse(const Json& accessor, const Layout& layout, std::vector<double>& values) const;
  std::vector<double> values(std::uint64_t accessor, std::string_view type, std::uint64_t components) const;

  const GltfDocument& document_;
  std::vector<std::string> buffers_;
  std::vector<std::filesystem::path> further_files_;
  std::uint64_t bytes_;
};

}  // namespace raytube
