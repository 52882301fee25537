#include "output/products/read_centres_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "core/csv_reader.h"
#include "core/error.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr const char* remedy = "run raytube centres again, or delete the file";

std::optional<double> number_after(const std::string& line, std::string_view words) {
  const std::size_t at = line.find(words);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + words.size();
  return parsed_number(line.substr(begin, line.find_first_of(", ", begin) - begin));
}

// What the first comment line says of the look.
StoredCentres look_of_head(const std::filesystem::path& file) {
  std::string line;
  std::ifstream in(file);
  std::getline(in, line);
  const auto theta = number_after(line, "# Scattering centres of the look theta "), phi = number_after(line, ", phi "),
             frequency = number_after(line, " degrees at "), side = number_after(line, "resolved to cubes of ");
  if (!theta || !phi || !frequency || !side)
    throw InputError(fmt::format("{}: does not begin as raytube centres writes it; {}", file.string(), remedy));
  return {.theta_deg = *theta, .phi_deg = *phi, .frequency = *frequency, .side = *side, .centres = {}, .s = {}};
}

class CentresReader {
 public:
  explicit CentresReader(const std::filesystem::path& file) : file_(file), reader_(file, remedy) {}

  bool next() { return reader_.next(); }
  bool is_rest() const { return text("centre") == "rest"; }
  const std::string& text(const std::string& name) const { return reader_.cell(column(name)); }
  double number(const std::string& name) const { return reader_.finite_number(column(name), remedy); }

  ScatteringMatrix amplitudes() const {
    ScatteringMatrix s;
    for (std::size_t i = 0; i < channel_names.size(); ++i)
      s.s[i / 2][i % 2] = {number(fmt::format("re_{}", channel_names[i])), number(fmt::format("im_{}", channel_names[i]))};
    return s;
  }

  StoredCentre centre() const {
    return {{number("x_m"), number("y_m"), number("z_m")},
            amplitudes(),
            text("mechanism"),
            text("part"),
            number("persistence_ghz"),
            number("persistence_azimuth_deg"),
            number("persistence_elevation_deg")};
  }

 private:
  std::size_t column(const std::string& name) const {
    const std::vector<std::string>& names = reader_.columns();
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw InputError(fmt::format("{}: has no column {}; {}", file_.string(), name, remedy));
    return static_cast<std::size_t>(found - names.begin());
  }

  std::filesystem::path file_;
  CsvReader reader_;
};

}  // namespace

StoredCentres read_centres_csv(const std::filesystem::path& file) {
  StoredCentres found = look_of_head(file);
  for (CentresReader reader(file); reader.next();) {
    found.s += reader.amplitudes();
    if (!reader.is_rest()) found.centres.push_back(reader.centre());
  }
  return found;
}

}  // namespace raytube
