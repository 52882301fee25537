#include "mesh/read/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "mesh/files/numbers.h"

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

}  // namespace raytube
