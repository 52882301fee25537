#include <nlohmann/json.hpp>

#include "case/case.h"
#include "case/names.h"
#include "decimal.h"

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
  Json json = {
      {"mode", adaptive ? "adaptive" : "uniform"}, {"per_wavelength", tubes.per_wavelength}, {"max_bounces", tubes.max_bounces}};
  if (adaptive) json["clip"] = tubes.clip;
  if (adaptive && tubes.clip) json["curved"] = curved_name(tubes.curved);
  json["skip"] = tubes.skip;
  if (tubes.up) json["up"] = {tubes.up->x, tubes.up->y, tubes.up->z};
  return json;
}

Json edges_json(const EdgeOptions& edges) {
  Json json = {{"method", edge_method_name(edges.method)},
               {"order", edges.order},
               {"between", edges.between},
               {"receiver_shadow", edges.receiver_shadow},
               {"transition", transition_name(edges.transition)},
               {"thin_sheets", edges.thin_sheets},
               {"min_wedge_deg", decimal_degrees(edges.min_wedge_angle)}};
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

Json resolved_case(const Case& c) {
  Json json;
  json["title"] = c.title;
  json["target"] = {{"mesh", c.mesh}, {"unit", c.unit}, {"material", "pec"}};
  json["frequency"] = frequency_json(c.sweep);
  if (c.radar.positions.empty()) put_looks(c.looks, json);
  if (!c.sweep.looks.front().far()) json["radar"] = radar_json(c);
  json["tubes"] = tubes_json(c.tubes);
  if (c.tubes.mode == TubeMode::adaptive && c.tubes.clip) json["accuracy"] = {{"tolerance_db", c.tubes.tolerance_db}};
  json["edges"] = edges_json(c.edges);
  json["output"] = {{"plots", c.plots}};
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
