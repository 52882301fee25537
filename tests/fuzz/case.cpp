// A case file, and overrides: the bytes up to the first 0 are the file, those between further ones are given with --set.
#include <vector>

#include "case/read_case.h"
#include "case/resolved_case.h"
#include "point_source/source_case.h"
#include "scratch.h"
#include "target.h"

namespace {

using namespace raytube;
using namespace raytube::fuzz;

// What cases of the corpus name beside them.
struct CaseFolder : Folder {
  CaseFolder() {
    write("looks.csv", "theta_deg,phi_deg\n90,0\n90,1\n");
    write("bistatic.csv", "theta_deg,phi_deg,rx_theta_deg,rx_phi_deg\n90,0,90,1\n");
    write("glass.csv", "freq_ghz,eps_real,eps_loss\n1,4,0.1\n100,5,0.2\n");
    write("horn.csv", "angle_deg,azimuth_db,elevation_db\n-90,-30,-30\n0,0,0\n90,-30,-30\n");
  }
};

std::vector<std::string> parts_of(const std::string& bytes) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= bytes.size(); at = parts.back().size() + at + 1)
    parts.push_back(bytes.substr(at, bytes.find('\0', at) - at));
  return parts;
}

void read_whole_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const Case c = read_case(file, overrides);
  expect(c.sweep.rows() > 0, "a case has rows");
  if (c.sweep.rows() < 1000) expect(!resolved_case_json(c).empty(), "a case can be written down");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const CaseFolder folder;
  std::vector<std::string> overrides = parts_of(text_of(data, size));
  const std::filesystem::path file = folder.write("case.toml", overrides.front());
  overrides.erase(overrides.begin());
  refuse_or([&] { read_whole_case(file, overrides); });
  refuse_or([&] { read_source_case(file, overrides); });
  return 0;
}
