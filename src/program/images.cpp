#include "program/images.h"

#include <fmt/format.h>

#include "output/tables/image_csv.h"
#include "output/vtk/image_pvd.h"
#include "output/vtk/image_vtu.h"
#include "program/work/interrupt.h"
#include "solve/image.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr const char* series_name = "image.pvd";

std::string mesh_file(const std::string& name) { return name + "_mesh.vtu"; }

bool is_series(const Case& c) { return c.image_looks.size() > 1; }

std::string name_of_image(const Case& c, std::size_t look) { return is_series(c) ? fmt::format("image_{}", look) : "image"; }

}  // namespace

ResultNames image_names(const Case& c) {
  ResultNames names;
  for (const std::size_t look : c.image_looks) {
    const std::string name = name_of_image(c, look);
    if (c.plots) names.pictures.insert(names.pictures.end(), {name + ".png", name + "_phase.png", name + "_window.png"});
    names.tables.insert(names.tables.end(), {name + ".csv", mesh_file(name)});
  }
  if (is_series(c)) names.tables.emplace_back(series_name);
  return names;
}

std::vector<std::string> image_tables(const Case& c) {
  std::vector<std::string> tables;
  for (const std::size_t look : c.image_looks) tables.push_back(name_of_image(c, look) + ".csv");
  return tables;
}

std::vector<std::string> names_of_images(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (std::string name = entry.path().filename().string(); name.starts_with("image")) names.push_back(std::move(name));
  return names;
}

void write_images(const fs::path& folder, const SolvePlan& plan, const Case& c) {
  const TriangleMesh& mesh = plan.target.mesh;
  std::vector<dvec3> vertices = mesh.vertices;
  for (dvec3& vertex : vertices) vertex += mesh.center;
  std::vector<SeriesFile> series;
  for (const std::size_t look : c.image_looks) {
    const std::string name = name_of_image(c, look);
    const LookImage image = image_of_look(plan, look, c.image_per_wavelength, [](double) { return !InterruptFlag::raised(); });
    write_image_csv(folder / (name + ".csv"), c.sweep, image);
    stop_if_interrupted();
    write_image_vtu(folder / mesh_file(name), vertices, mesh.triangles, image);
    stop_if_interrupted();
    series.push_back({look, mesh_file(name)});
  }
  if (is_series(c)) write_image_pvd(folder / series_name, series);
}

}  // namespace raytube
