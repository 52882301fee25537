#include "output/report/imaging_json.h"

#include "output/report/blocks.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr std::size_t most_ranges = 500, most_looks = 200, most_across = 240;

JsonValue axis_direction(const dvec3& v) { return std::vector<double>{v.x, v.y, v.z}; }

double level_of_amplitude(double metres) { return sigma_dbsm(Complex(metres)); }

// What the errors of a look come to at one range, of VV and HH the larger.
JsonValue error_levels(const std::vector<ChannelErrors>& errors, const Blocks& looks) {
  std::vector<double> levels(looks.count(), level_of_amplitude(0.0));
  for (std::size_t look = 0; look < errors.size(); ++look)
    levels[looks.of(look)] =
        std::max(levels[looks.of(look)], level_of_amplitude(std::max(errors[look][0][0], errors[look][1][1])));
  JsonValue json{std::vector<double>{}};
  for (const double level : levels) json.append(std::isfinite(level) ? JsonValue(level) : JsonValue());
  return json;
}

}  // namespace

JsonValue profiles_json(const RangeProfiles& profiles, std::size_t looks, const Window& window) {
  const Blocks slow(looks, most_looks), fast(profiles.range.count, most_ranges);
  BlockLevels levels(slow, fast);
  for (std::size_t i = 0; i < profiles.s.size(); ++i)
    levels.add(i / profiles.range.count, i % profiles.range.count, profiles.s[i]);
  return {{"range", block_axis(profiles.range.first, profiles.range.step, fast)},
          {"looks_a_block", slow.size},
          {"blocks", slow.count()},
          {"resolution", profiles.limits.resolution},
          {"unambiguous", profiles.limits.unambiguous},
          {"window", name_of(window)},
          {"model", error_levels(profiles.model, slow)},
          {"sigma", levels.json()}};
}

JsonValue isar_json(const IsarImage& image, const Window& window) {
  const EvenGrid& grid = image.grid;
  const Blocks slow(grid.count[0], most_across), fast(grid.count[1], most_across);
  BlockLevels levels(slow, fast);
  for (std::size_t i = 0; i < image.s.size(); ++i)
    levels.add(i / (grid.count[1] * grid.count[2]), i / grid.count[2] % grid.count[1], image.s[i]);
  return {{"range", block_axis(image.coordinate(0, 0), grid.step[0], slow)},
          {"cross", block_axis(image.coordinate(1, 0), grid.step[1], fast)},
          {"range_axis", axis_direction(image.axes[0].direction)},
          {"cross_axis", axis_direction(image.axes[1].direction)},
          {"range_resolution", image.axes[0].resolution},
          {"cross_resolution", image.axes[1].resolution},
          {"in_space", image.axes.size() > 2},
          {"window", name_of(window)},
          {"sigma", levels.json()}};
}

}  // namespace raytube
