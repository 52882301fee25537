#include <nlohmann/json.hpp>

#include "case/case.h"
#include "case/names.h"
#include "core/decimal.h"

namespace raytube {

namespace {

using Json = nlohmann::ordered_json;

Json one_or_list(const std::vector<double>& values) { return values.size() == 1 ? Json(values.front()) : Json(values); }

Json frequency_json(const Sweep& sweep) {
  std::vector<double> ghz;
  for (const double hertz : sweep.frequencies) ghz.push_back(hertz / 1e9);
  return {{"ghz", one_or_list(ghz)}};
}

Json tubes_json(const TubeOptions& tubes) {
  const bool adaptive = tubes.mode == TubeMode::adaptive;
  Json json = {{"mode", adaptive ? "adaptive" : "uniform"},
               {"per_wavelength", tubes.refines() ? tubes.max_per_wavelength : tubes.per_wavelength},
               {"max_bounces", tubes.max_bounces}};
  if (adaptive) json["clip"] = tubes.clip;
  if (adaptive && tubes.clip) json["curved"] = curved_name(tubes.curved);
  json["skip"] = tubes.skip;
  if (tubes.up) json["up"] = {tubes.up->x, tubes.up->y, tubes.up->z};
  return json;
}

Json edges_json(const EdgeOptions& edges, const WedgeOptions& wedges, bool has_materials) {
  Json json = {{"method", edge_method_name(edges.method)},
               {"order", edges.order},
               {"between", edges.interaction},
               {"receiver_shadow", edges.receiver_shadow},
               {"transition", transition_name(edges.transition)},
               {"thin_sheets", wedges.thin_plates},
               {"min_wedge_deg", decimal_degrees(wedges.min_wedge_angle)}};
  if (has_materials) json["materials"] = material_edge_name(edges.materials);
  if (edges.utd_range > 0.0) json["utd_range_m"] = edges.utd_range;
  return json;
}

Json vector_json(const dvec3& v) { return {v.x, v.y, v.z}; }

Json places_json(const std::vector<dvec3>& places) {
  Json list = Json::array();
  for (const dvec3& place : places) list.push_back(vector_json(place));
  return list;
}

Json radar_json(const Case& c) {
  Json json;
  const RadarChoice& radar = c.radar;
  if (radar.positions.empty()) json["range_m"] = radar.range_m;
  if (radar.positions.empty() && c.sweep.bistatic) json["receive_range_m"] = radar.receive_range_m;
  if (!radar.positions.empty()) json["position_m"] = places_json(radar.positions);
  if (!radar.receive_positions.empty()) json["receive_position_m"] = places_json(radar.receive_positions);
  json["aim_m"] = vector_json(c.sweep.radar.aim);
  if (!radar.beamwidth_deg.empty()) json["beamwidth_deg"] = one_or_list(radar.beamwidth_deg);
  if (!radar.pattern_csv.empty()) json["pattern_csv"] = radar.pattern_csv;
  return json;
}

void put_looks(const LookChoice& looks, Json& json) {
  if (!looks.looks_csv.empty())
    json["look"] = {{"looks_csv", looks.looks_csv}};
  else
    json["look"] = {{"theta_deg", one_or_list(looks.theta_deg)}, {"phi_deg", one_or_list(looks.phi_deg)}};
  if (!looks.rx_theta_deg.empty())
    json["receive"] = {{"theta_deg", one_or_list(looks.rx_theta_deg)}, {"phi_deg", one_or_list(looks.rx_phi_deg)}};
}

Json facets_json(const std::vector<MaterialPlaces::Facets>& facets) {
  Json json = Json::object();
  for (const auto& [first, last, material, place] : facets)
    json[material].push_back(first == last ? Json(first) : Json({first, last}));
  return json;
}

Json target_json(const Case& c) {
  Json json = {{"mesh", c.meshes.size() == 1 ? Json(c.meshes.front()) : Json(c.meshes)},
               {"unit", c.unit},
               {"material", c.places.elsewhere}};
  for (const auto& [name, material, place] : c.places.parts) json["parts"][name] = material;
  if (!c.places.facets.empty()) json["facets"] = facets_json(c.places.facets);
  return json;
}

void put_medium(const MediumChoice& medium, Json& json) {
  if (!medium.medium.empty()) {
    json["medium"] = medium.medium;
  } else if (!medium.table_csv.empty()) {
    json["table_csv"] = medium.table_csv;
  } else {
    const bool one_number = medium.loss_tangent || medium.conductivity;
    json["eps_r"] = one_number ? Json(medium.eps_r[0]) : Json(medium.eps_r);
    if (medium.loss_tangent) json["loss_tangent"] = *medium.loss_tangent;
    if (medium.conductivity) json["conductivity_s_per_m"] = *medium.conductivity;
    json["mu_r"] = medium.mu_r;
  }
}

void put_layer(const LayerChoice& layer, Json& json) {
  if (layer.thickness_mm > 0.0) json["thickness_mm"] = layer.thickness_mm;
  put_medium(layer.medium, json);
}

Json material_json(const MaterialChoice& material) {
  Json json = {{"kind", material.kind}};
  if (material.layers.size() == 1) put_layer(material.layers.front(), json);
  for (std::size_t i = 0; i < material.layers.size() && material.layers.size() > 1; ++i)
    put_layer(material.layers[i], json["layers"][i]);
  if (material.resistance) json["resistance_ohm"] = *material.resistance;
  if (material.conductance) json["conductance_s"] = *material.conductance;
  json["roughness_rms_mm"] = material.roughness_mm;
  return json;
}

Json resolved_case(const Case& c) {
  Json json;
  json["title"] = c.title;
  json["target"] = target_json(c);
  for (const MaterialChoice& material : c.materials) json["materials"][material.name] = material_json(material);
  json["frequency"] = frequency_json(c.sweep);
  if (c.radar.positions.empty()) put_looks(c.looks, json);
  if (!c.sweep.looks.front().far()) json["radar"] = radar_json(c);
  json["tubes"] = tubes_json(c.tubes);
  if (c.tubes.mode == TubeMode::adaptive && c.tubes.clip) json["accuracy"] = {{"tolerance_db", c.tubes.tolerance_db}};
  json["edges"] = edges_json(c.edges, c.wedges, !c.sweep.materials.empty());
  json["output"] = {{"plots", c.plots}};
  if (c.incoherent) json["output"]["incoherent"] = true;
  if (!c.image_looks.empty()) {
    json["output"]["image_look"] = c.image_looks;
    json["output"]["image_per_wavelength"] = c.image_per_wavelength;
  }
  return json;
}

std::string text_of(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string resolved_case_json(const Case& c) { return text_of(resolved_case(c), 2); }

std::vector<std::pair<std::string, std::string>> numerical_keys(const Case& c) {
  std::vector<std::pair<std::string, std::string>> keys;
  const Json json = resolved_case(c);
  for (const auto& section : json.items()) {
    if (section.key() == "title" || section.key() == "output") continue;
    for (const auto& entry : section.value().items())
      keys.emplace_back(section.key() + '.' + entry.key(), text_of(entry.value(), -1));
  }
  return keys;
}

}  // namespace raytube
