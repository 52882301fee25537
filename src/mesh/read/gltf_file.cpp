#include "mesh/read/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/text.h"
#include "mesh/files/mesh_file.h"
#include "mesh/model/triangle_mesh.h"

namespace raytube {

namespace {

constexpr std::size_t glb_head_bytes = 12, chunk_head_bytes = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

std::uint32_t word_at(std::string_view bytes, std::size_t position) { return number_at<std::uint32_t>(bytes.data() + position); }

/// Takes the next chunk of a binary file off `bytes`, if it is of that type.
std::string_view take_chunk(const MeshFile& file, std::string_view& bytes, std::uint32_t type) {
  if (bytes.size() < chunk_head_bytes || word_at(bytes, 4) != type) return {};
  const std::size_t size = word_at(bytes, 0);
  if (bytes.size() - chunk_head_bytes < size) file.reject("ends before its last chunk; it is cut short, export it again");
  const std::string_view chunk = bytes.substr(chunk_head_bytes, size);
  bytes.remove_prefix(chunk_head_bytes + size);
  return chunk;
}

std::shared_ptr<const Json> parsed_or_rejected(const MeshFile& file, std::string_view text) {
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  Json json = json_of(text);
  if (!json.is_object()) file.reject("its JSON is damaged or cut short; export the mesh again");
  return std::make_shared<const Json>(std::move(json));
}

GltfDocument binary_document(const MeshFile& file) {
  std::string_view bytes = file.bytes;
  if (bytes.size() < glb_head_bytes) file.reject("is too short for a glTF file; export it again");
  if (const std::uint32_t version = word_at(bytes, 4); version != 2)
    file.reject(fmt::format("version {} of glTF is not read; export it as glTF 2.0", version));
  if (word_at(bytes, 8) != bytes.size())
    file.reject(fmt::format("holds {} of the {} bytes it announces; copy or export it again", bytes.size(), word_at(bytes, 8)));
  bytes.remove_prefix(glb_head_bytes);
  const std::string_view text = take_chunk(file, bytes, json_chunk);
  return {file, parsed_or_rejected(file, text), take_chunk(file, bytes, binary_chunk)};
}

/// Those that a mesh can do without: looks, lights, textures. Numbers of fewer bits are read.
bool leaves_surface_as_it_is(std::string_view extension) {
  static constexpr std::array<std::string_view, 6> beginnings = {"KHR_mesh_quantization", "KHR_materials_", "KHR_texture_",
                                                                 "KHR_lights_",           "EXT_texture_",   "KHR_xmp"};
  return std::ranges::any_of(beginnings, [&](std::string_view beginning) { return extension.starts_with(beginning); });
}

void check_extensions(const GltfDocument& document) {
  for (const Json& extension : document.list(*document.json, "extensionsRequired"))
    if (const std::string name = extension.is_string() ? extension.get<std::string>() : ""; !leaves_surface_as_it_is(name))
      document.file.reject(
          fmt::format("needs the extension {}, which is not read; export it without compression and extensions", quotable(name)));
  for (const Json& extension : document.list(*document.json, "extensionsUsed"))
    if (extension == "EXT_mesh_gpu_instancing")
      document.file.reject("places its meshes by EXT_mesh_gpu_instancing, which is not read; export it without instancing");
}

void check_version(const GltfDocument& document) {
  const Json* asset = find(*document.json, "asset");
  const std::string version = asset ? text_at(*asset, "version") : "";
  if (!version.starts_with("2."))
    document.file.reject(
        fmt::format("its asset.version is '{}', where glTF 2.0 is read; export it as glTF 2.0", quotable(version)));
}

}  // namespace

const Json& GltfDocument::element(std::string_view list_name, std::uint64_t index) const {
  const std::span<const Json> items = list(*json, list_name);
  if (index >= items.size())
    file.reject(
        fmt::format("{}[{}] does not exist, there are {}; the file is damaged, export it again", list_name, index, items.size()));
  return items[index];
}

std::span<const Json> GltfDocument::list(const Json& table, std::string_view name) const {
  const Json* value = find(table, name);
  if (!value) return {};
  if (!value->is_array()) file.reject(fmt::format("'{}' is not a list; export the mesh again", name));
  return value->get_ref<const Json::array_t&>();
}

std::uint64_t GltfDocument::whole(const Json& value) const {
  if (!value.is_number_unsigned())
    file.reject("a whole number is missing, or something else is in its place; the file is damaged, export it again");
  return value.get<std::uint64_t>();
}

std::uint64_t GltfDocument::whole(const Json& table, std::string_view name, std::uint64_t otherwise) const {
  return find(table, name) ? required_whole(table, name) : otherwise;
}

std::uint64_t GltfDocument::required_whole(const Json& table, std::string_view name) const {
  const Json* value = find(table, name);
  if (!value || !value->is_number_unsigned())
    file.reject(fmt::format("'{}' is missing or not a whole number; the file is damaged, export it again", name));
  return value->get<std::uint64_t>();
}

double GltfDocument::number(const Json& value) const {
  if (!value.is_number()) file.reject("something else is in the place of a number; the file is damaged, export it again");
  return value.get<double>();
}

GltfDocument read_gltf_document(const MeshFile& file) {
  GltfDocument document =
      file.bytes.starts_with("glTF") ? binary_document(file) : GltfDocument{file, parsed_or_rejected(file, file.bytes), {}};
  check_version(document);
  check_extensions(document);
  return document;
}

namespace {

/// What a whole number of that type stands for once it is normalized (glTF 2.0, section 3.11; the least of the signed ones is
/// -1).
double normalized_value(double value, NumberType type) {
  constexpr double largest[] = {127.0, 255.0, 32767.0, 65535.0};
  return type > NumberType::uint16 ? value : std::max(value / largest[static_cast<int>(type)], -1.0);
}

constexpr std::uint8_t no_digit = 64;

constexpr std::array<std::uint8_t, 256> base64_values = [] {
  std::array<std::uint8_t, 256> values;
  values.fill(no_digit);
  std::uint8_t value = 0;
  for (const unsigned char digit : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"))
    values[digit] = value++;
  return values;
}();

std::optional<std::string> decoded_base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::uint8_t value = base64_values[static_cast<unsigned char>(text[i])];
    if (value == no_digit) return std::nullopt;
    bits = bits << 6 | value;
    if (i % 4 != 0) bytes += static_cast<char>(bits >> (6 - 2 * (i % 4)) & 0xFF);
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

NumberType GltfData::number_type(std::uint64_t component_type) const {
  static constexpr std::pair<std::uint64_t, NumberType> types[] = {{5120, NumberType::int8},   {5121, NumberType::uint8},
                                                                   {5122, NumberType::int16},  {5123, NumberType::uint16},
                                                                   {5125, NumberType::uint32}, {5126, NumberType::float32}};
  for (const auto& [number, type] : types)
    if (number == component_type) return type;
  document_.file.reject(
      fmt::format("componentType {} is not a component type of glTF; the file is damaged, export it again", component_type));
}

/// At least `bytes` of a view from `offset` on.
std::string_view GltfData::view_part(std::uint64_t index, std::uint64_t offset, std::uint64_t bytes) const {
  const Json& view = document_.element("bufferViews", index);
  const std::uint64_t buffer = document_.required_whole(view, "buffer"), begin = document_.whole(view, "byteOffset", 0),
                      size = document_.required_whole(view, "byteLength");
  document_.element("buffers", buffer);
  if (begin > buffers_[buffer].size() || size > buffers_[buffer].size() - begin)
    document_.file.reject(fmt::format("bufferViews[{}] reaches beyond its buffer; the file is damaged, export it again", index));
  if (offset > size || bytes > size - offset)
    document_.file.reject(fmt::format("an accessor reaches beyond bufferViews[{}]; the file is damaged, export it again", index));
  return std::string_view(buffers_[buffer]).substr(begin, size).substr(offset);
}

GltfData::Layout GltfData::layout(const Json& accessor, std::uint64_t components) const {
  const Json* normalized = find(accessor, "normalized");
  const std::uint64_t count = document_.required_whole(accessor, "count");
  Layout layout{{},
                count,
                components,
                0,
                number_type(document_.required_whole(accessor, "componentType")),
                normalized && *normalized == true};
  const std::uint64_t element_bytes = components * size_of(layout.type);
  // So many numbers that stand nowhere would be named by as many indices.
  if (count > bytes_) document_.file.reject("an accessor counts more elements than the file has bytes; export it again");
  if (!find(accessor, "bufferView") || count == 0) return layout;
  const std::uint64_t index = document_.required_whole(accessor, "bufferView");
  layout.stride = document_.whole(document_.element("bufferViews", index), "byteStride", element_bytes);
  if (layout.stride < element_bytes || layout.stride > 252)
    document_.file.reject(
        fmt::format("byteStride {} of bufferViews[{}] does not fit; export the mesh again", layout.stride, index));
  layout.bytes = view_part(index, document_.whole(accessor, "byteOffset", 0), (count - 1) * layout.stride + element_bytes);
  return layout;
}

double GltfData::Layout::value(std::uint64_t element, std::uint64_t component) const {
  if (bytes.empty()) return 0.0;
  const double raw = number_at(type, bytes.data() + element * stride + component * size_of(type));
  return normalized ? normalized_value(raw, type) : raw;
}

/// The indices or the values of a sparse accessor, which stand without gaps.
GltfData::Layout GltfData::sparse_layout(const Json& part, std::uint64_t count, std::uint64_t components,
                                         std::uint64_t component_type) const {
  const std::uint64_t index = document_.required_whole(part, "bufferView");
  const NumberType type = number_type(component_type);
  if (count > bytes_) document_.file.reject("a sparse accessor counts more elements than the file has bytes; export it again");
  const std::uint64_t stride = components * size_of(type);
  return {view_part(index, document_.whole(part, "byteOffset", 0), count * stride), count, components, stride, type, false};
}

void GltfData::replace_sparse(const Json& accessor, const Layout& layout, std::vector<double>& all) const {
  const Json* sparse = find(accessor, "sparse");
  if (!sparse) return;
  const Json *indices = find(*sparse, "indices"), *replacements = find(*sparse, "values");
  if (!indices || !replacements) document_.file.reject("a sparse accessor lacks indices or values; export the mesh again");
  const std::uint64_t count = document_.required_whole(*sparse, "count");
  const Layout places = sparse_layout(*indices, count, 1, document_.required_whole(*indices, "componentType"));
  Layout given = sparse_layout(*replacements, count, layout.components, document_.required_whole(accessor, "componentType"));
  given.normalized = layout.normalized;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double place = places.value(i, 0);
    if (!(place >= 0.0 && place < static_cast<double>(layout.count)))
      document_.file.reject(
          fmt::format("a sparse accessor replaces element {} of {}; export the mesh again", place, layout.count));
    for (std::uint64_t c = 0; c < layout.components; ++c)
      all[static_cast<std::uint64_t>(place) * layout.components + c] = given.value(i, c);
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
    for (std::uint64_t c = 0; c < components; ++c) all.push_back(from.value(i, c));
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
