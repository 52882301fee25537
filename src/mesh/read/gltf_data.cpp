#include "mesh/read/gltf_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "mesh/files/mesh_file.h"
#include "mesh/model/triangle_mesh.h"
#include "mesh/read/gltf_uri.h"

namespace raytube {

namespace {

enum ComponentType : std::uint64_t { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

std::uint64_t component_bytes(const MeshFile& file, std::uint64_t type) {
  if (type == int8 || type == uint8) return 1;
  if (type == int16 || type == uint16) return 2;
  if (type == uint32 || type == float32) return 4;
  file.reject(fmt::format("componentType {} is not a component type of glTF; the file is damaged, export it again", type));
}

template <class Number>
double number_at(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

double raw_value(const char* bytes, std::uint64_t type) {
  switch (type) {
    case int8:
      return number_at<std::int8_t>(bytes);
    case uint8:
      return number_at<std::uint8_t>(bytes);
    case int16:
      return number_at<std::int16_t>(bytes);
    case uint16:
      return number_at<std::uint16_t>(bytes);
    case uint32:
      return number_at<std::uint32_t>(bytes);
    default:
      return number_at<float>(bytes);
  }
}

/// What a whole number of that type stands for once it is normalized (glTF 2.0, section 3.11; the least of the signed ones is
/// -1).
double normalized_value(double value, std::uint64_t type) {
  switch (type) {
    case int8:
      return std::max(value / 127.0, -1.0);
    case uint8:
      return value / 255.0;
    case int16:
      return std::max(value / 32767.0, -1.0);
    case uint16:
      return value / 65535.0;
    default:
      return value;
  }
}

}  // namespace

GltfData::GltfData(const GltfDocument& document) : document_(document), bytes_(document.file.bytes.size()) {
  const auto buffers = document_.list(*document_.json, "buffers");
  for (std::uint64_t i = 0; i < buffers.size(); ++i) buffers_.push_back(load_buffer(buffers[i], i));
}

std::string GltfData::load_buffer(const Json& buffer, std::uint64_t index) {
  const std::string uri = text_at(buffer, "uri");
  const std::uint64_t announced = document_.required_whole(buffer, "byteLength");
  std::string bytes;
  if (uri.empty())
    bytes = document_.binary;
  else if (!uri.starts_with("data:"))
    bytes = load_file(uri);
  else if (std::optional<std::string> data = data_of_uri(uri))
    bytes = std::move(*data);
  else
    document_.file.reject(fmt::format("the base64 data of buffers[{}] is damaged; export the mesh again", index));
  if (bytes.size() < announced)
    document_.file.reject(fmt::format("buffers[{}] holds {} of the {} bytes it announces; it is cut short, export it again",
                                      index, bytes.size(), announced));
  return bytes;
}

std::string GltfData::load_file(const std::string& uri) {
  const std::optional<std::string> path = path_of_uri(uri);
  if (!path)
    document_.file.reject(fmt::format(
        "its buffer '{}' is not a file in the folder of the mesh; export it as .glb, which is one file", quotable(uri)));
  further_files_.push_back(std::filesystem::path(document_.file.name).parent_path() / *path);
  if (std::error_code error; !std::filesystem::exists(further_files_.back(), error))
    document_.file.reject(
        fmt::format("its buffer '{}' is not there; copy it into the folder of the mesh, or export it as .glb, which "
                    "is one file",
                    quotable(uri)));
  std::string bytes = read_bytes(further_files_.back()).bytes;
  bytes_ += bytes.size();
  return bytes;
}

std::string_view GltfData::view(std::uint64_t index) const {
  const Json& view = document_.element("bufferViews", index);
  const std::uint64_t buffer = document_.required_whole(view, "buffer"), offset = document_.whole(view, "byteOffset", 0),
                      bytes = document_.required_whole(view, "byteLength");
  document_.element("buffers", buffer);
  if (offset > buffers_[buffer].size() || bytes > buffers_[buffer].size() - offset)
    document_.file.reject(fmt::format("bufferViews[{}] reaches beyond its buffer; the file is damaged, export it again", index));
  return std::string_view(buffers_[buffer]).substr(offset, bytes);
}

/// At least `bytes` of a view from `offset` on.
std::string_view GltfData::view_part(std::uint64_t index, std::uint64_t offset, std::uint64_t bytes) const {
  const std::string_view whole = view(index);
  if (offset > whole.size() || bytes > whole.size() - offset)
    document_.file.reject(fmt::format("an accessor reaches beyond bufferViews[{}]; the file is damaged, export it again", index));
  return whole.substr(offset);
}

GltfData::Layout GltfData::layout(const Json& accessor, std::uint64_t components) const {
  const Json* normalized = find(accessor, "normalized");
  Layout layout{{},         document_.required_whole(accessor, "count"),
                components, document_.required_whole(accessor, "componentType"),
                0,          normalized && *normalized == true};
  const std::uint64_t element_bytes = components * component_bytes(document_.file, layout.component_type);
  // So many numbers that stand nowhere would be named by as many indices.
  if (layout.count > bytes_) document_.file.reject("an accessor counts more elements than the file has bytes; export it again");
  if (!find(accessor, "bufferView") || layout.count == 0) return layout;
  const std::uint64_t index = document_.required_whole(accessor, "bufferView");
  layout.stride = document_.whole(document_.element("bufferViews", index), "byteStride", element_bytes);
  if (layout.stride < element_bytes || layout.stride > 252)
    document_.file.reject(
        fmt::format("byteStride {} of bufferViews[{}] does not fit; export the mesh again", layout.stride, index));
  layout.bytes = view_part(index, document_.whole(accessor, "byteOffset", 0), (layout.count - 1) * layout.stride + element_bytes);
  return layout;
}

double GltfData::value(const Layout& layout, std::uint64_t element, std::uint64_t component) const {
  if (layout.bytes.empty()) return 0.0;
  const std::uint64_t size = component_bytes(document_.file, layout.component_type);
  const double raw = raw_value(layout.bytes.data() + element * layout.stride + component * size, layout.component_type);
  return layout.normalized ? normalized_value(raw, layout.component_type) : raw;
}

/// The indices or the values of a sparse accessor, which stand without gaps.
GltfData::Layout GltfData::sparse_layout(const Json& part, Layout like) const {
  const std::uint64_t index = document_.required_whole(part, "bufferView");
  like.stride = like.components * component_bytes(document_.file, like.component_type);
  if (like.count > bytes_)
    document_.file.reject("a sparse accessor counts more elements than the file has bytes; export it again");
  like.bytes = view_part(index, document_.whole(part, "byteOffset", 0), like.count * like.stride);
  return like;
}

void GltfData::replace_sparse(const Json& accessor, const Layout& layout, std::vector<double>& all) const {
  const Json* sparse = find(accessor, "sparse");
  if (!sparse) return;
  const Json *indices = find(*sparse, "indices"), *replacements = find(*sparse, "values");
  if (!indices || !replacements) document_.file.reject("a sparse accessor lacks indices or values; export the mesh again");
  const std::uint64_t count = document_.required_whole(*sparse, "count");
  const Layout places = sparse_layout(*indices, {{}, count, 1, document_.required_whole(*indices, "componentType"), 0, false});
  const Layout given = sparse_layout(*replacements, {{}, count, layout.components, layout.component_type, 0, layout.normalized});
  for (std::uint64_t i = 0; i < count; ++i) {
    const double place = value(places, i, 0);
    if (!(place >= 0.0 && place < static_cast<double>(layout.count)))
      document_.file.reject(
          fmt::format("a sparse accessor replaces element {} of {}; export the mesh again", place, layout.count));
    for (std::uint64_t c = 0; c < layout.components; ++c)
      all[static_cast<std::uint64_t>(place) * layout.components + c] = value(given, i, c);
  }
}

std::vector<double> GltfData::values(std::uint64_t index, std::string_view type, std::uint64_t components) const {
  const Json& accessor = document_.element("accessors", index);
  if (const std::string found = text_at(accessor, "type"); found != type)
    document_.file.reject(fmt::format("accessors[{}] is of type '{}' where {} belongs; the file is damaged, export it again",
                                      index, quotable(found), type));
  const Layout from = layout(accessor, components);
  std::vector<double> all;
  all.reserve(from.count * components);
  for (std::uint64_t i = 0; i < from.count; ++i)
    for (std::uint64_t c = 0; c < components; ++c) all.push_back(value(from, i, c));
  replace_sparse(accessor, from, all);
  return all;
}

std::vector<dvec3> GltfData::positions(std::uint64_t accessor) const {
  const std::vector<double> all = values(accessor, "VEC3", 3);
  std::vector<dvec3> points;
  points.reserve(all.size() / 3);
  for (std::size_t i = 0; i < all.size(); i += 3) points.emplace_back(all[i], all[i + 1], all[i + 2]);
  return points;
}

std::vector<std::uint32_t> GltfData::indices(std::uint64_t accessor) const {
  std::vector<std::uint32_t> numbers;
  for (const double value : values(accessor, "SCALAR", 1)) {
    if (!(value >= 0.0 && value < no_index) || value != std::floor(value))
      document_.file.reject(fmt::format("accessors[{}] holds {}, which is not an index; export the mesh again", accessor, value));
    numbers.push_back(static_cast<std::uint32_t>(value));
  }
  return numbers;
}

}  // namespace raytube
