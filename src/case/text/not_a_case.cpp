#include "case/text/not_a_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

constexpr std::array<std::string_view, 8> mesh_endings = {".stl", ".obj", ".ply", ".off", ".msh", ".glb", ".gltf", ".3mf"};
constexpr std::array<std::string_view, 4> mesh_beginnings = {"solid ", "OFF\n", "OFF\r", "ply\n"};

bool has_mesh_ending(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  if (ending == ".gz") return has_mesh_ending(file.stem());
  return std::ranges::find(mesh_endings, ending) != mesh_endings.end();
}

[[noreturn]] void reject_mesh(const std::filesystem::path& file) {
  throw InputError(
      fmt::format("{}: is a mesh, not a case; write a case file (TOML) with mesh = \"{}\" under [target] and give that",
                  file.string(), quotable(file.filename().string())));
}

}  // namespace

void refuse_mesh_as_case(const std::filesystem::path& file) {
  if (has_mesh_ending(file)) reject_mesh(file);
}

void refuse_other_kinds(const std::filesystem::path& file, std::string_view bytes) {
  if (std::ranges::any_of(mesh_beginnings, [&](std::string_view beginning) { return bytes.starts_with(beginning); }))
    reject_mesh(file);
  if (bytes.starts_with("\x7f"
                        "ELF") ||
      bytes.find('\0') != std::string_view::npos)
    throw InputError(
        fmt::format("{}: is a program or another binary file, not a case; give the path of a case file (TOML)", file.string()));
}

}  // namespace raytube
