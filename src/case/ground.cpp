#include "case/ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/materials/materials.h"
#include "case/text/keys.h"
#include "case/text/values.h"
#include "core/text.h"

namespace raytube {

namespace {

// None: a perfect conductor.
std::optional<Material> read_material(const CaseValue& value, const CaseValue& root, const Case& c) {
  const std::string name = read_text(value, "ground.material");
  if (name == "pec") return {};
  const auto choice = std::ranges::find(c.materials, name, &MaterialChoice::name);
  if (choice == c.materials.end()) {
    std::vector<std::string> names{"pec"};
    for (const MaterialChoice& known : c.materials) names.push_back(known.name);
    reject(value, fmt::format("ground.material \"{}\" is neither \"pec\" nor in [materials]; {}", quotable(name),
                              name_meant(name, names)));
  }
  if (choice->kind == "sheet")
    reject(value, "ground.material is a sheet, which has another side; write kind = \"dielectric\" or \"coated\" in its section");
  if (choice->kind == "solid")
    reject(value, "ground.material is a solid, which fills a body; write kind = \"dielectric\" in its section");
  if (choice->kind == "pec" && choice->roughness_mm == 0.0) return {};
  return material_of(*choice, c, find(root, "frequency.ghz")->location);
}

// On the horizon the reflected wave takes all away, but over a perfect conductor.
void check_far_look(const CaseValue& section, const Case& c, std::size_t look) {
  for (const Direction& end : {c.sweep.looks[look].transmit, c.sweep.looks[look].receive}) {
    const double height = spherical_basis(end).radial.z;
    if (height < 0.0)
      reject(section, fmt::format("look {} has theta = {:.6g} degrees, from below the ground; leave out angles above 90", look,
                                  end.theta / degree));
    if (height == 0.0 && !c.ground->perfect())
      reject(section, fmt::format("look {} has theta = 90 degrees, where nothing is left of waves over a medium; leave out the "
                                  "horizon, or write ground.material = \"pec\"",
                                  look));
  }
}

void check_antennas_above(const CaseValue& section, const Case& c, std::size_t look) {
  for (const AntennaPosition& antenna : {c.sweep.looks[look].transmitter(), c.sweep.looks[look].receiver()}) {
    const double z = antenna.point().z;
    if (z < c.ground->height || (z == c.ground->height && !c.ground->perfect()))
      reject(section,
             fmt::format("look {} has an antenna at z = {:.6g} m, not above the ground at {:.6g} m; move it up, or lower "
                         "ground.height_m",
                         look, z, c.ground->height));
  }
}

void check_above(const CaseValue& section, const Case& c) {
  for (std::size_t look = 0; look < c.sweep.looks.size(); ++look)
    c.sweep.looks[look].far() ? check_far_look(section, c, look) : check_antennas_above(section, c, look);
}

}  // namespace

void read_ground(const CaseValue& root, Case& c) {
  const CaseValue* section = root.find("ground");
  if (!section) return;
  c.ground.emplace();
  if (const CaseValue* height = section->find("height_m")) {
    c.ground->height = read_number(*height, "ground.height_m");
    if (!(std::abs(c.ground->height) < farthest))
      reject(*height, fmt::format("ground.height_m must be less than {:g} m from the origin", farthest));
  }
  if (const CaseValue* material = section->find("material")) c.ground->material = read_material(*material, root, c);
  check_above(*section, c);
}

}  // namespace raytube
