// raytube centres: a look of a case -> the places that it scatters from.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "case/read_case.h"
#include "core/ordered_json.h"
#include "jobs/centres_of_look.h"
#include "output/products/centres_csv.h"
#include "output/products/centres_netcdf.h"
#include "output/tables/csv.h"
#include "program/products.h"

namespace raytube {

namespace {

double relative_db(const ScatteringMatrix& s, const ScatteringMatrix& rest, int p) {
  return 20.0 * std::log10(std::abs(s.at(p, p) - rest.at(p, p)) / std::abs(s.at(p, p)));
}

std::string centres_text(const ScatteringCentres& found, const ScatteringMatrix& s) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(found.centres.size(), 10); ++i) {
    const ScatteringCentre& centre = found.centres[i];
    text += fmt::format("{:>4} {:>9.2f} dBsm VV {:>9.2f} dBsm HH  ({:.4g}, {:.4g}, {:.4g}) m  {}\n", i + 1,
                        sigma_dbsm(centre.s.vv()), sigma_dbsm(centre.s.hh()), centre.place.x + 0.0, centre.place.y + 0.0,
                        centre.place.z + 0.0, scattering_mechanisms[centre.mechanism()]);
  }
  if (found.centres.size() > 10) text += fmt::format("     and {} more in centres.csv\n", found.centres.size() - 10);
  return text + fmt::format("look               VV {:.2f} dBsm, HH {:.2f} dBsm; all {} centres together {:+.2f} dB, {:+.2f} dB\n",
                            sigma_dbsm(s.vv()), sigma_dbsm(s.hh()), found.centres.size(), relative_db(s, found.rest, 0),
                            relative_db(s, found.rest, 1));
}

std::string centres_json(const LookCentres& look) {
  const auto levels = [](const ScatteringMatrix& s) {
    Json json;
    for (int c = 0; c < 4; ++c) {
      const double level = sigma_dbsm(s.at(c / 2, c % 2));
      json[channel_names[static_cast<std::size_t>(c)]] = std::isfinite(level) ? Json(level) : nullptr;
    }
    return json;
  };
  Json json = {{"frequency_hz", look.frequency},         {"theta_deg", look.direction.theta / degree},
               {"phi_deg", look.direction.phi / degree}, {"resolution_m", look.side},
               {"sigma_dbsm", levels(look.s)},           {"centres", Json::array()}};
  for (const ScatteringCentre& centre : look.found.centres)
    json["centres"].push_back({{"place_m", {centre.place.x, centre.place.y, centre.place.z}},
                               {"mechanism", scattering_mechanisms[centre.mechanism()]},
                               {"sigma_dbsm", levels(centre.s)}});
  return text_of_json(json, 2) + '\n';
}

}  // namespace

void centres_command(const Request& request) {
  const ProductRequest& asked = request.product;
  Product product{.names = {{"centres.png", "centres.svg"}, {"centres.csv", "centres.ply", "by_part.csv", "centres.nc"}},
                  .netcdf = "centres.nc"};
  ProductSource& source = product.source;
  LookCentres centres;
  const auto look = [&] { return CentreLook{centres.direction, centres.frequency, centres.side}; };
  const auto part_of = [&](std::uint32_t triangle) {
    const TriangleMesh& mesh = source.target->mesh;
    return mesh.part_names[mesh.triangle_part[triangle]];
  };
  product.check = [] {};
  product.make = [&] {
    const std::vector<double>& frequencies = source.of_case->sweep.frequencies;
    centres = centres_of_look(*source.target, *source.of_case, {request.look, asked.centres, asked.resolution}, request.threads,
                              progress_of_pieces(request, request.look, frequencies[middle_index(frequencies.size())]));
    return request.json ? centres_json(centres) : centres_text(centres.found, centres.s);
  };
  product.write_files = [&](const std::filesystem::path& folder) {
    write_centres_csv(folder / "centres.csv", centres.found, look(), part_of, source.title);
    write_centres_ply(folder / "centres.ply", centres.found);
    write_by_part_csv(folder / "by_part.csv", centres.pieces, look(), part_of);
  };
  product.write_netcdf = [&](const std::filesystem::path& file) {
    write_centres_netcdf(file, source.result, centres.found, look(), part_of, source.lines());
  };
  product.drawn = "centres.csv";
  make_product(request, product);
}

}  // namespace raytube
