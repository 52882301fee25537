#include "case/resolved_case.h"

#include <algorithm>

#include "case/data/names.h"
#include "core/decimal.h"
#include "core/json.h"

namespace raytube {

namespace {

JsonValue one_or_list(const std::vector<double>& values) {
  return values.size() == 1 ? JsonValue(values.front()) : JsonValue(values);
}

JsonValue frequency_json(const Sweep& sweep) {
  std::vector<double> ghz;
  for (const double hertz : sweep.frequencies) ghz.push_back(hertz / 1e9);
  return {{"ghz", one_or_list(ghz)}};
}

JsonValue vector_json(const dvec3& v) { return std::vector<double>{v.x, v.y, v.z}; }

JsonValue tubes_json(const TubeOptions& tubes) {
  const bool adaptive = tubes.mode == TubeMode::adaptive;
  JsonValue json = {{"mode", adaptive ? "adaptive" : "uniform"},
                    {"per_wavelength", tubes.refines() ? tubes.max_per_wavelength : tubes.per_wavelength},
                    {"max_bounces", tubes.max_bounces}};
  if (adaptive) json["clip"] = tubes.clip;
  if (adaptive && tubes.clip) json["curved"] = curved_name(tubes.curved);
  json["skip"] = tubes.skip;
  if (tubes.up) json["up"] = vector_json(*tubes.up);
  return json;
}

JsonValue use_json(const Use& use) {
  if (use.forced()) return true;
  if (use.possible()) return "auto";
  return false;
}

JsonValue edges_json(const EdgeOptions& edges, const WedgeOptions& wedges, bool has_materials) {
  JsonValue json = {{"method", edge_method_name(edges.method)}, {"order", edges.order},
                    {"between", use_json(edges.interaction)},   {"between_budget", edges.interaction_budget},
                    {"receiver_shadow", edges.receiver_shadow}, {"transition", transition_name(edges.transition)},
                    {"thin_sheets", wedges.thin_plates},        {"min_wedge_deg", decimal_degrees(wedges.min_wedge_angle)}};
  if (has_materials) json["materials"] = material_edge_name(edges.materials);
  if (edges.utd_range > 0.0) json["utd_range_m"] = edges.utd_range;
  return json;
}

JsonValue vectors_json(const std::vector<dvec3>& vectors) {
  JsonValue list;
  for (const dvec3& vector : vectors) list.append(vector_json(vector));
  return list;
}

JsonValue radar_json(const Case& c) {
  JsonValue json;
  const RadarChoice& radar = c.radar;
  if (radar.positions.empty()) json["range_m"] = radar.range_m;
  if (radar.positions.empty() && c.sweep.bistatic) json["receive_range_m"] = radar.receive_range_m;
  if (!radar.positions.empty()) json["position_m"] = vectors_json(radar.positions);
  if (!radar.receive_positions.empty()) json["receive_position_m"] = vectors_json(radar.receive_positions);
  json["aim_m"] = vector_json(c.sweep.radar.aim);
  if (c.sweep.radar.receive_aim) json["receive_aim_m"] = vector_json(*c.sweep.radar.receive_aim);
  if (!radar.turntable_deg.empty()) json["turntable_deg"] = one_or_list(radar.turntable_deg);
  if (radar.link) json["transmit_power_dbm"] = radar.link->transmit_power_dbm, json["gain_dbi"] = radar.link->gain_dbi;
  if (!radar.beamwidth_deg.empty()) json["beamwidth_deg"] = one_or_list(radar.beamwidth_deg);
  if (!radar.pattern_csv.empty()) json["pattern_csv"] = radar.pattern_csv;
  return json;
}

// Columns, as a look list has them, before a turntable turns.
JsonValue look_list_json(const Case& c) {
  JsonValue json;
  const std::size_t turns = std::max<std::size_t>(c.radar.turntable_deg.size(), 1);
  for (std::size_t i = 0; i < c.sweep.looks.size(); i += turns) {
    const Look& look = c.sweep.looks[i];
    json["theta_deg"].append(decimal_degrees(look.transmit.theta));
    json["phi_deg"].append(decimal_degrees(look.transmit.phi + look.turn));
    if (!c.sweep.bistatic) continue;
    json["rx_theta_deg"].append(decimal_degrees(look.receive.theta));
    json["rx_phi_deg"].append(decimal_degrees(look.receive.phi + look.turn));
  }
  return json;
}

void put_looks(const Case& c, JsonValue& json) {
  const LookChoice& looks = c.looks;
  if (looks.given_as_numbers)
    json["look"] = {{"list", look_list_json(c)}};
  else if (!looks.looks_csv.empty())
    json["look"] = {{"looks_csv", looks.looks_csv}};
  else
    json["look"] = {{"theta_deg", one_or_list(looks.theta_deg)}, {"phi_deg", one_or_list(looks.phi_deg)}};
  if (!looks.rx_theta_deg.empty())
    json["receive"] = {{"theta_deg", one_or_list(looks.rx_theta_deg)}, {"phi_deg", one_or_list(looks.rx_phi_deg)}};
}

JsonValue facets_json(const std::vector<MaterialAssignment::Facets>& facets) {
  JsonValue json;
  for (const auto& [first, last, material, location] : facets)
    json[material].append(first == last ? JsonValue(first) : JsonValue(std::vector<std::uint64_t>{first, last}));
  return json;
}

JsonValue target_json(const Case& c) {
  JsonValue json = {{"mesh", c.meshes.size() == 1 ? JsonValue(c.meshes.front()) : JsonValue(c.meshes)},
                    {"unit", c.unit},
                    {"material", c.assignment.elsewhere}};
  for (const auto& [name, material, location] : c.assignment.parts) json["parts"][name] = material;
  if (!c.assignment.facets.empty()) json["facets"] = facets_json(c.assignment.facets);
  return json;
}

JsonValue pair_json(const std::array<double, 2>& pair) { return std::vector<double>{pair[0], pair[1]}; }

void put_medium(const MediumChoice& medium, JsonValue& json) {
  if (!medium.medium.empty()) {
    json["medium"] = medium.medium;
  } else if (!medium.table_csv.empty()) {
    json["table_csv"] = medium.table_csv;
  } else {
    const bool one_number = medium.loss_tangent || medium.conductivity;
    json["eps_r"] = one_number ? JsonValue(medium.eps_r[0]) : pair_json(medium.eps_r);
    if (medium.loss_tangent) json["loss_tangent"] = *medium.loss_tangent;
    if (medium.conductivity) json["conductivity_s_per_m"] = *medium.conductivity;
    json["mu_r"] = pair_json(medium.mu_r);
  }
}

void put_layer(const LayerChoice& layer, JsonValue& json) {
  if (layer.thickness_mm > 0.0) json["thickness_mm"] = layer.thickness_mm;
  put_medium(layer.medium, json);
}

JsonValue layers_json(const std::vector<LayerChoice>& layers) {
  JsonValue list;
  for (const LayerChoice& layer : layers) {
    JsonValue json;
    put_layer(layer, json);
    list.append(std::move(json));
  }
  return list;
}

JsonValue material_json(const MaterialChoice& material) {
  JsonValue json = {{"kind", material.kind}};
  if (material.layers.size() == 1) put_layer(material.layers.front(), json);
  if (material.layers.size() > 1) json["layers"] = layers_json(material.layers);
  if (material.resistance) json["resistance_ohm"] = *material.resistance;
  if (material.conductance) json["conductance_s"] = *material.conductance;
  json["roughness_rms_mm"] = material.roughness_mm;
  return json;
}

JsonValue resolved_case(const Case& c) {
  JsonValue json;
  json["title"] = c.title;
  json["target"] = target_json(c);
  for (const MaterialChoice& material : c.materials) json["materials"][material.name] = material_json(material);
  json["frequency"] = frequency_json(c.sweep);
  if (c.radar.positions.empty()) put_looks(c, json);
  if (!c.sweep.looks.front().far()) json["radar"] = radar_json(c);
  if (c.ground)
    json["ground"] = {{"height_m", c.ground->height}, {"material", c.ground->perfect() ? "pec" : c.ground->material->name}};
  json["tubes"] = tubes_json(c.tubes);
  if (c.tubes.mode == TubeMode::adaptive && c.tubes.clip)
    json["accuracy"] = {{"tolerance_db", c.tubes.tolerance_db}, {"model_share", c.tubes.model_share}};
  json["edges"] = edges_json(c.edges, c.wedges, !c.sweep.materials.empty());
  json["surfaces"] = {{"waves", use_json(c.surfaces.waves)}};
  json["output"] = {{"plots", c.plots}, {"netcdf", c.netcdf}};
  if (c.incoherent) json["output"]["incoherent"] = true;
  if (c.power) json["output"]["power_dbm"] = true;
  if (!c.image_looks.empty()) {
    json["output"]["image_look"] = c.image_looks;
    json["output"]["image_per_wavelength"] = c.image_per_wavelength;
  }
  return json;
}

}  // namespace

std::string resolved_case_json(const Case& c) { return json_text(resolved_case(c), 2); }

std::vector<std::pair<std::string, std::string>> numerical_keys(const Case& c) {
  std::vector<std::pair<std::string, std::string>> keys;
  const JsonValue json = resolved_case(c);
  for (std::size_t i = 0; i < json.names.size(); ++i) {
    const std::string& section = json.names[i];
    if (section == "title" || section == "output") continue;
    for (std::size_t j = 0; j < json.items[i].names.size(); ++j)
      keys.emplace_back(section + '.' + json.items[i].names[j], json_text(json.items[i].items[j], -1));
  }
  return keys;
}

}  // namespace raytube
