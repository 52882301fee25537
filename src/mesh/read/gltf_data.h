// The numbers of a glTF file: buffers, views of them, and accessors (Khronos, glTF 2.0 specification, section 3.6).
#pragma once

#include <filesystem>
#include <vector>

#include "core/field.h"
#include "mesh/read/gltf_document.h"

namespace raytube {

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
    std::uint64_t count, components, component_type, stride;
    bool normalized;
  };

  std::string load_buffer(const Json& buffer, std::uint64_t index);
  std::string load_file(const std::string& uri);
  std::string_view view(std::uint64_t index) const;
  std::string_view view_part(std::uint64_t index, std::uint64_t offset, std::uint64_t bytes) const;
  Layout layout(const Json& accessor, std::uint64_t components) const;
  Layout sparse_layout(const Json& part, Layout like) const;
  double value(const Layout& layout, std::uint64_t element, std::uint64_t component) const;
  void replace_sparse(const Json& accessor, const Layout& layout, std::vector<double>& values) const;
  std::vector<double> values(std::uint64_t accessor, std::string_view type, std::uint64_t components) const;

  const GltfDocument& document_;
  std::vector<std::string> buffers_;
  std::vector<std::filesystem::path> further_files_;
  std::uint64_t bytes_;
};

}  // namespace raytube
