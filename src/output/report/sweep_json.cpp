#include "output/report/sweep_json.h"

#include <algorithm>
#include <cmath>

#include "imaging/sweep_grid.h"
#include "output/report/blocks.h"
#include "output/report/packed.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"
#include "output/tables/sweep_map.h"

namespace raytube {

namespace {

constexpr std::size_t most_values = 600'000;  // of two bytes: 1.6 MB of a page
constexpr std::size_t map_columns = 240, map_rows = 200;

double largest_level(const StoredResult& result, std::size_t row) {
  const ChannelErrors& sigma = result.sigma_dbsm[row];
  return std::max({sigma[0][0], sigma[0][1], sigma[1][0], sigma[1][1]});
}

// Of every `bucket` rows of a curve the strongest and the weakest.
std::vector<std::uint32_t> extremes(const StoredResult& result, const std::vector<std::size_t>& curve, std::size_t bucket) {
  std::vector<std::uint32_t> kept;
  for (std::size_t first = 0; first < curve.size(); first += bucket) {
    const auto begin = curve.begin() + std::ptrdiff_t(first),
               end = curve.begin() + std::ptrdiff_t(std::min(first + bucket, curve.size()));
    const auto [least, most] = std::minmax_element(
        begin, end, [&](std::size_t a, std::size_t b) { return largest_level(result, a) < largest_level(result, b); });
    kept.push_back(std::uint32_t(*least));
    if (*most != *least) kept.push_back(std::uint32_t(*most));
  }
  return kept;
}

std::vector<std::uint32_t> shown_rows(const StoredResult& result) {
  const std::size_t a_row = 12 + 4 * result.parts.size(), most = most_values / a_row;
  std::vector<std::uint32_t> rows;
  if (result.rows() <= most) {
    for (std::uint32_t row = 0; row < result.rows(); ++row) rows.push_back(row);
    return rows;
  }
  const std::size_t bucket = (2 * result.rows() + most - 1) / most;
  for (const CutRows& cut : plan_cuts(coordinates_of_rows(sweep_of(result))).cuts)
    for (const std::uint32_t row : extremes(result, cut.rows, bucket)) rows.push_back(row);
  std::ranges::sort(rows);
  return rows;
}

template <class LevelOf>
JsonValue channels_json(const std::vector<std::uint32_t>& rows, const LevelOf& level_of) {
  JsonValue channels;
  for (std::size_t channel = 0; channel < 4; ++channel) {
    std::vector<double> levels;
    for (const std::uint32_t row : rows) levels.push_back(level_of(row, channel / 2, channel % 2));
    channels.append(packed_levels(levels));
  }
  return channels;
}

JsonValue levels_json(const std::vector<std::uint32_t>& rows, const std::vector<ChannelErrors>& levels) {
  return channels_json(rows, [&](std::size_t row, std::size_t p, std::size_t q) { return levels[row][p][q]; });
}

JsonValue parts_json(const StoredResult& result, const std::vector<std::uint32_t>& rows) {
  JsonValue parts{std::vector<JsonValue>{}};
  for (const StoredPart& part : result.parts)
    parts.append(
        {{"label", part_label(part.name)}, {"sigma", channels_json(rows, [&](std::size_t row, std::size_t p, std::size_t q) {
                                              return sigma_dbsm(part.s[row].s[p][q]);
                                            })}});
  return parts;
}

// By transmit polarisation; null where there are none.
JsonValue incoherent_json(const StoredResult& result, const std::vector<std::uint32_t>& rows) {
  JsonValue json;
  for (std::size_t transmit = 0; transmit < 2 && !result.incoherent_m2.empty(); ++transmit) {
    std::vector<double> levels;
    for (const std::uint32_t row : rows) levels.push_back(10.0 * std::log10(result.incoherent_m2[row][transmit]));
    json.append(packed_levels(levels));
  }
  return json;
}

JsonValue looks_json(const StoredResult& result) {
  std::array<std::vector<double>, 4> angles;
  for (const StoredLook& look : result.looks) {
    const std::array<double, 4> values{look.phi_deg, look.theta_deg, look.rx_phi_deg, look.rx_theta_deg};
    for (std::size_t i = 0; i < 4; ++i) angles[i].push_back(values[i]);
  }
  return {{"phi", angles[0]}, {"theta", angles[1]}, {"rx_phi", angles[2]}, {"rx_theta", angles[3]}};
}

std::size_t strongest_row(const StoredResult& result) {
  std::size_t strongest = 0;
  for (std::size_t row = 1; row < result.rows(); ++row)
    if (largest_level(result, row) > largest_level(result, strongest)) strongest = row;
  return strongest;
}

JsonValue map_axis(const std::vector<double>& values, RowCoordinates::Quantity quantity, const Blocks& blocks,
                   const std::string& name) {
  const std::string label = axis_label(quantity);
  const EvenAxis axis = even_axis(values, name + ": " + label, quantity == RowCoordinates::frequency ? "GHz" : "degrees");
  JsonValue json = block_axis(axis.first, axis.step, blocks);
  json["label"] = label;
  return json;
}

}  // namespace

JsonValue sweep_json(const StoredResult& result) {
  const std::vector<std::uint32_t> rows = shown_rows(result);
  std::vector<double> ghz;
  for (const double hertz : result.frequency_hz) ghz.push_back(hertz / 1e9);
  return {{"ghz", ghz},
          {"looks", looks_json(result)},
          {"bistatic", result.bistatic},
          {"total", result.rows()},
          {"rows", packed_indices(rows)},
          {"sigma", levels_json(rows, result.sigma_dbsm)},
          {"error", levels_json(rows, result.err_db)},
          {"model", levels_json(rows, result.model_db)},
          {"parts", parts_json(result, rows)},
          {"incoherent", incoherent_json(result, rows)}};
}

JsonValue map_json(const StoredResult& result, const std::string& name) {
  const RowCoordinates coordinates = coordinates_of_rows(sweep_of(result));
  const std::optional<SweepMap> map = map_through(strongest_row(result), coordinates, plan_cuts(coordinates), 2);
  if (!map) return {};
  const Blocks up(map->y.size(), map_rows), across(map->x.size(), map_columns);
  BlockLevels levels(up, across);
  for (std::size_t i = 0; i < map->rows.size(); ++i) {
    const ChannelErrors& sigma = result.sigma_dbsm[map->rows[i]];
    levels.add(i / map->x.size(), i % map->x.size(), std::array{sigma[0][0], sigma[0][1], sigma[1][0], sigma[1][1]});
  }
  return {{"x", map_axis(map->x, map->across, across, name)},
          {"y", map_axis(map->y, map->up, up, name)},
          {"fixed", map->fixed},
          {"sigma", levels.json()}};
}

}  // namespace raytube
