// A table as look list, antenna pattern and result; what stands behind a byte 0 says how the result's columns are named.
#include <cmath>

#include "case/directions/looks_csv.h"
#include "case/directions/pattern_csv.h"
#include "output/compare/comparison.h"
#include "scratch.h"
#include "target.h"

namespace {

using namespace raytube;
using namespace raytube::fuzz;

void read_looks_of(const std::filesystem::path& file) {
  bool bistatic = false;
  for (const Look& look : read_looks_csv(file, bistatic))
    expect(std::isfinite(look.transmit.phi) && std::isfinite(look.receive.theta), "looks are finite");
}

void read_pattern_of(const std::filesystem::path& file) {
  AntennaPattern pattern;
  read_pattern_csv(file, pattern);
  expect(std::isfinite(pattern.amplitude(0.1, -0.2)), "an antenna's amplitude is finite");
}

// Whatever is compared with itself agrees, unless it is nothing.
void read_result_of(const std::filesystem::path& file, const std::string& names) {
  const ResultTable table = read_result_table(file, names.empty() ? ColumnMap() : parsed_column_map("--result-columns", names));
  if (table.rows.size() > 50) return;
  const Comparison comparison = compare_results(table, table, 20.0, true);
  expect(comparison.rows() <= table.rows.size(), "no row is compared twice");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const std::string bytes = text_of(data, size);
  const std::size_t end = bytes.find('\0');
  const std::filesystem::path file = folder.write("table.csv", bytes.substr(0, end));
  refuse_or([&] { read_looks_of(file); });
  refuse_or([&] { read_pattern_of(file); });
  refuse_or([&] { read_result_of(file, end == std::string::npos ? "" : bytes.substr(end + 1)); });
  return 0;
}
