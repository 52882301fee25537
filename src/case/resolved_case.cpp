#include "case/resolved_case.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "case/data/case_keys.h"
#include "case/data/names.h"
#include "core/decimal.h"
#include "core/ordered_json.h"

namespace raytube {

namespace {

Json one_or_list(const std::vector<double>& values) { return values.size() == 1 ? Json(values.front()) : Json(values); }

Json frequency_json(const Sweep& sweep) {
  std::vector<double> ghz;
  for (const double hertz : sweep.frequencies) ghz.push_back(hertz / 1e9);
  return {{"ghz", one_or_list(ghz)}};
}

Json vector_json(const dvec3& v) { return std::vector<double>{v.x, v.y, v.z}; }

Json scalar_json(bool value, const CaseKey&) { return value; }
Json scalar_json(int value, const CaseKey&) { return value; }
Json scalar_json(double value, const CaseKey& key) { return key.factor == degree ? decimal_degrees(value) : value; }
Json scalar_json(const std::vector<std::size_t>& numbers, const CaseKey&) { return numbers; }
Json scalar_json(const std::optional<dvec3>& vector, const CaseKey&) { return vector_json(*vector); }

Json scalar_json(const Use& use, const CaseKey&) {
  if (use.forced()) return true;
  if (use.possible()) return "auto";
  return false;
}

template <class Choice>
requires std::is_enum_v<Choice> Json scalar_json(Choice choice, const CaseKey&) { return word_of(choice); }

void put_scalar_keys(const Case& c, Json& json) {
  visit_case_keys(c, [&](const CaseKey& key, const auto& member) {
    const std::size_t dot = key.name.find('.');
    if (key.shown) json[key.name.substr(0, dot)][key.name.substr(dot + 1)] = scalar_json(member, key);
  });
}

Json vectors_json(const std::vector<dvec3>& vectors) {
  Json list;
  for (const dvec3& vector : vectors) list.push_back(vector_json(vector));
  return list;
}

Json radar_json(const Case& c) {
  Json json;
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
Json look_list_json(const Case& c) {
  Json json;
  const std::size_t turns = std::max<std::size_t>(c.radar.turntable_deg.size(), 1);
  const std::size_t looks = c.looks_at_a_time();
  for (std::size_t i = 0; i < looks; i += turns) {
    const Look& look = c.sweep.looks[i];
    json["theta_deg"].push_back(decimal_degrees(look.transmit.theta));
    json["phi_deg"].push_back(decimal_degrees(look.transmit.phi + look.turn));
    if (!c.sweep.bistatic) continue;
    json["rx_theta_deg"].push_back(decimal_degrees(look.receive.theta));
    json["rx_phi_deg"].push_back(decimal_degrees(look.receive.phi + look.turn));
  }
  return json;
}

void put_looks(const Case& c, Json& json) {
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

Json body_json(const BodyMotion& body, const Motion& motion) {
  Json json = Json::object();
  if (!body.parts.empty()) json["parts"] = body.parts;
  if (body.on != no_body) json["on"] = motion.bodies[body.on].name;
  if (body.turning) {
    json["axis"] = vector_json(body.turning->axis);
    json["through_m"] = vector_json(body.turning->through);
    json["deg_per_s"] = decimal_degrees(body.turning->rate);
    json["angle_deg"] = decimal_degrees(body.turning->angle);
  }
  if (!body.poses_csv.empty()) json["poses_csv"] = body.poses_csv;
  if (body.poses_csv.empty())
    for (const auto& [time, at, turn] : body.poses)
      json["poses"].push_back(std::vector{time, at.x, at.y, at.z, turn[0], turn[1], turn[2], turn[3]});
  json["velocity_m_per_s"] = vector_json(body.velocity);
  return json;
}

Json motion_json(const MotionChoice& choice) {
  Json json;
  if (choice.pulses > 0)
    json["pulses"] = {{"start_s", choice.start_s}, {"interval_s", choice.interval_s}, {"count", choice.pulses}};
  else
    json["times_s"] = one_or_list(choice.times_s);
  json["retrace"] = retrace_words[choice.retrace ? 0 : 1];
  json["reference_s"] = choice.motion.reference;
  if (choice.radar && choice.radar->poses_csv.empty()) json["radar"]["velocity_m_per_s"] = vector_json(choice.radar->velocity);
  if (choice.radar && !choice.radar->poses_csv.empty()) json["radar"]["track_csv"] = choice.radar->poses_csv;
  if (choice.radar) json["radar"]["aim_moves"] = choice.aim_moves;
  for (const BodyMotion& body : choice.motion.bodies) json["bodies"][body.name] = body_json(body, choice.motion);
  return json;
}

Json facets_json(const std::vector<MaterialAssignment::Facets>& facets) {
  Json json;
  for (const auto& [first, last, material, location] : facets)
    json[material].push_back(first == last ? Json(first) : Json(std::vector<std::uint64_t>{first, last}));
  return json;
}

Json target_json(const Case& c) {
  Json json = {{"mesh", c.meshes.size() == 1 ? Json(c.meshes.front()) : Json(c.meshes)},
               {"unit", c.unit},
               {"material", c.assignment.elsewhere}};
  for (const auto& [name, material, location] : c.assignment.parts) json["parts"][name] = material;
  if (!c.assignment.facets.empty()) json["facets"] = facets_json(c.assignment.facets);
  return json;
}

Json pair_json(const std::array<double, 2>& pair) { return std::vector<double>{pair[0], pair[1]}; }

void put_medium(const MediumChoice& medium, Json& json) {
  if (!medium.medium.empty()) {
    json["medium"] = medium.medium;
  } else if (!medium.table_csv.empty()) {
    json["table_csv"] = medium.table_csv;
  } else {
    const bool one_number = medium.loss_tangent || medium.conductivity;
    json["eps_r"] = one_number ? Json(medium.eps_r[0]) : pair_json(medium.eps_r);
    if (medium.loss_tangent) json["loss_tangent"] = *medium.loss_tangent;
    if (medium.conductivity) json["conductivity_s_per_m"] = *medium.conductivity;
    json["mu_r"] = pair_json(medium.mu_r);
  }
}

void put_layer(const LayerChoice& layer, Json& json) {
  if (layer.thickness_mm > 0.0) json["thickness_mm"] = layer.thickness_mm;
  put_medium(layer.medium, json);
}

Json layers_json(const std::vector<LayerChoice>& layers) {
  Json list;
  for (const LayerChoice& layer : layers) {
    Json json;
    put_layer(layer, json);
    list.push_back(std::move(json));
  }
  return list;
}

Json material_json(const MaterialChoice& material) {
  Json json = {{"kind", material.kind}};
  if (material.layers.size() == 1) put_layer(material.layers.front(), json);
  if (material.layers.size() > 1) json["layers"] = layers_json(material.layers);
  if (material.resistance) json["resistance_ohm"] = *material.resistance;
  if (material.conductance) json["conductance_s"] = *material.conductance;
  json["roughness_rms_mm"] = material.roughness_mm;
  return json;
}

}  // namespace

Json resolved_case(const Case& c) {
  Json json;
  json["title"] = c.title;
  json["target"] = target_json(c);
  for (const MaterialChoice& material : c.materials) json["materials"][material.name] = material_json(material);
  json["frequency"] = frequency_json(c.sweep);
  if (c.radar.positions.empty()) put_looks(c, json);
  if (!c.sweep.looks.front().far()) json["radar"] = radar_json(c);
  if (c.ground)
    json["ground"] = {{"height_m", c.ground->height}, {"material", c.ground->perfect() ? "pec" : c.ground->material->name}};
  if (c.motion) json["motion"] = motion_json(*c.motion);
  put_scalar_keys(c, json);
  return json;
}

std::string resolved_case_json(const Case& c) { return text_of_json(resolved_case(c), 2); }

std::vector<std::pair<std::string, std::string>> numerical_keys(const Json& resolved) {
  std::vector<std::pair<std::string, std::string>> keys;
  for (const auto& [section, members] : resolved.items()) {
    if (section == "title" || section == "output") continue;
    for (const auto& [key, value] : members.items()) keys.emplace_back(section + '.' + key, text_of_json(value));
  }
  return keys;
}

std::vector<std::pair<std::string, std::string>> numerical_keys(const Case& c) { return numerical_keys(resolved_case(c)); }

}  // namespace raytube
