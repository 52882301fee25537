#include "mesh/read/gltf_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/text.h"
#include "mesh/files/mesh_file.h"
#include "mesh/files/numbers.h"
#include "mesh/model/triangle_mesh.h"

namespace raytube {

namespace {

NumberType number_type(const MeshFile& file, std::uint64_t component_type) {
  static constexpr std::pair<std::uint64_t, NumberType> types[] = {{5120, NumberType::int8},   {5121, NumberType::uint8},
                                                                   {5122, NumberType::int16},  {5123, NumberType::uint16},
                                                                   {5125, NumberType::uint32}, {5126, NumberType::float32}};
  for (const auto& [number, type] : types)
    if (number == component_type) return type;
  file.reject(
      fmt::format("componentType {} is not a component type of glTF; the file is damaged, export it again", component_type));
}

/// What a whole number of that type stands for once it is normalized (glTF 2.0, section 3.11; the least of the signed ones is
/// -1).
double normalized_value(double value, NumberType type) {
  constexpr double largest[] = {127.0, 255.0, 32767.0, 65535.0};
  return type > NumberType::uint16 ? value : std::max(value / largest[static_cast<int>(type)], -1.0);
}

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t no_digit = 64;

constexpr std::array<std::uint8_t, 256> digit_values() {
  std::array<std::uint8_t, 256> values;
  values.fill(no_digit);
  for (std::size_t i = 0; i < base64_digits.size(); ++i) values[static_cast<unsigned char>(base64_digits[i])] = i & 63;
  return values;
}

std::optional<std::string> decoded_base64(std::string_view text) {
  static constexpr std::array<std::uint8_t, 256> values = digit_values();
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::uint8_t value = values[static_cast<unsigned char>(text[i])];
    if (value == no_digit) return std::nullopt;
    bits = bits << 6 | value;
    if (const std::size_t left = 6 - 2 * (i % 4); i % 4 != 0) bytes += static_cast<char>(bits >> left & 0xFF);
  }
  return bytes;
}

std::string without_percents(std::string_view text) {
  std::string decoded;
  for (; !text.empty(); text.remove_prefix(1)) {
    unsigned value = 0;
    const char* digits = text.data() + 1;
    const bool is_code =
        text.front() == '%' && text.size() > 2 && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2;
    decoded += is_code ? static_cast<char>(value) : text.front();
    if (is_code) text.remove_prefix(2);
  }
  return decoded;
}

/// The bytes that a `data:` address in base64 stands for (RFC 2397, RFC 4648); nothing if they are damaged or written in another
/// way.
std::optional<std::string> data_of_uri(std::string_view uri) {
  static constexpr std::string_view mark = ";base64,";
  const std::size_t end = uri.find(mark);
  if (!uri.starts_with("data:") || end == std::string_view::npos) return std::nullopt;
  return decoded_base64(uri.substr(end + mark.size()));
}

/// The relative path that an address stands for (RFC 3986), `%20` and the like decoded; nothing if it leads out of the folder or
/// is no path.
std::optional<std::string> path_of_uri(std::string_view uri) {
  if (uri.find(':') != std::string_view::npos) return std::nullopt;
  const std::string path = without_percents(uri);
  const std::filesystem::path file = std::filesystem::path(path).lexically_normal();
  const bool outside = file.is_absolute() || file.empty() || *file.begin() == "..";
  const bool printable = is_utf8(path) && std::ranges::all_of(path, [](char c) { return c < 0 || (c >= ' ' && c != '\x7F'); });
  return outside || !printable ? std::nullopt : std::optional(path);
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
  const std::uint64_t element_bytes = components * size_of(number_type(document_.file, layout.component_type));
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
  const NumberType type = number_type(document_.file, layout.component_type);
  const double raw = number_at(type, layout.bytes.data() + element * layout.stride + component * size_of(type));
  return layout.normalized ? normalized_value(raw, type) : raw;
}

/// The indices or the values of a sparse accessor, which stand without gaps.
GltfData::Layout GltfData::sparse_layout(const Json& part, Layout like) const {
  const std::uint64_t index = document_.required_whole(part, "bufferView");
  like.stride = like.components * size_of(number_type(document_.file, like.component_type));
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
