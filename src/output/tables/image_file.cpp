#include "output/tables/image_file.h"

#include <algorithm>

#include "core/csv_reader.h"
#include "core/text.h"
#include "output/netcdf/netcdf_file.h"

namespace raytube {

bool is_image_file(const std::filesystem::path& file, const ColumnMap& map) {
  const std::string ending = lower_case(file.extension().string());
  if (ending == ".exr") return true;
  if (ending == ".nc") return netcdf_dimension(file, "cross_range_m") > 0;
  if (ending == ".json" || ending == ".h5") return false;
  std::vector<std::string> names;
  const CsvReader reader(file, "give the path of a readable table");
  for (const std::string& column : reader.columns()) names.push_back(lower_case(column));
  for (const ColumnChoice& choice : map) names.push_back(choice.ours);
  const auto has = [&](const char* name) { return std::ranges::find(names, name) != names.end(); };
  const bool has_key =
      std::ranges::any_of(std::array{"freq_hz", "freq_ghz", "theta_deg", "phi_deg", "rx_theta_deg", "rx_phi_deg"}, has);
  return (has("u_m") && has("v_m")) || (has("cross_range_m") && has("range_m")) || (has("col") && has("row")) ||
         (has("x") && has("y") && !has_key);
}

}  // namespace raytube
