#include "case/directions/pattern_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/csv_reader.h"
#include "core/error.h"

namespace raytube {

namespace {

constexpr double highest_db = 60.0;  // over the axis

}  // namespace

void read_pattern_csv(const std::filesystem::path& file, AntennaPattern& pattern) {
  const std::string remedy = "radar.pattern_csv must name a readable CSV file with the header angle_deg,azimuth_db,elevation_db";
  CsvReader reader(file, remedy);
  if (reader.columns() != std::vector<std::string>{"angle_deg", "azimuth_db", "elevation_db"})
    throw InputError(fmt::format("{}: the header must be \"angle_deg,azimuth_db,elevation_db\"", file.string()));
  while (reader.next()) {
    const double degrees = reader.finite_number(0, "write angles off the axis in degrees"), angle = degrees * degree;
    if (std::abs(degrees) > 360.0)
      throw InputError(fmt::format("{}: angle_deg must lie in -360 to 360 degrees (found {})", reader.location(), degrees));
    if (!pattern.azimuth.angles.empty() && angle <= pattern.azimuth.angles.back())
      throw InputError(reader.location() + ": angle_deg must ascend; sort the rows and drop repeated ones");
    pattern.azimuth.angles.push_back(angle);
    pattern.azimuth.levels.push_back(reader.finite_number(1, "write the level relative to the axis in dB"));
    pattern.elevation.levels.push_back(reader.finite_number(2, "write the level relative to the axis in dB"));
  }
  if (pattern.azimuth.angles.size() < 2)
    throw InputError(file.string() + ": an antenna pattern needs at least two rows; add what was measured off the axis");
  pattern.elevation.angles = pattern.azimuth.angles;
  for (const PatternCut* cut : {&pattern.azimuth, &pattern.elevation})
    if (std::abs(cut->level(0.0)) > 0.01 || std::ranges::max(cut->levels) > highest_db)
      throw InputError(fmt::format(
          "{}: levels are relative to the axis, 0 dB at 0 degrees and nowhere above {} dB; subtract the gain on the axis",
          file.string(), highest_db));
}

}  // namespace raytube
