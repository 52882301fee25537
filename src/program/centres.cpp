// raytube centres: a look of a case -> the places that it scatters from.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/ordered_json.h"
#include "jobs/centres_of_look.h"
#include "output/products/centres_csv.h"
#include "output/products/centres_netcdf.h"
#include "output/tables/csv.h"
#include "program/products.h"

namespace raytube {

namespace {

constexpr const char* centres_examples =
    R"(Takes everything that scatters at the middle frequency to pieces and finds the strongest places: their amplitude in each
channel, their mechanism, and the band and angles over which they persist. Writes centres.csv, centres.png, centres.ply and
by_part.csv.

Examples:
  raytube centres cases/trihedral/case.toml --look 20
  raytube centres case.toml -n 20 --resolution 0.05 -o centres)";

struct CentresRequest {
  RunOptions run;
  CentresAsked centres;
  bool json = false;
};

double relative_db(const ScatteringMatrix& s, const ScatteringMatrix& rest, int p) {
  return 20.0 * std::log10(std::abs(s.at(p, p) - rest.at(p, p)) / std::abs(s.at(p, p)));
}

std::string centres_text(const ScatteringCentres& found, const ScatteringMatrix& s) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(found.centres.size(), 10); ++i) {
    const ScatteringCentre& centre = found.centres[i];
    text += fmt::format("{:>4} {:>9.2f} dBsm VV {:>9.2f} dBsm HH  ({:.4g}, {:.4g}, {:.4g}) m  {}\n", i + 1,
                        sigma_dbsm(centre.s.vv()), sigma_dbsm(centre.s.hh()), centre.place.x + 0.0, centre.place.y + 0.0,
                        centre.place.z + 0.0, found.mechanism_of(centre));
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
                               {"mechanism", look.found.mechanism_of(centre)},
                               {"sigma_dbsm", levels(centre.s)}});
  return text_of_json(json, 2) + '\n';
}

void make_centres(const CentresRequest& asked) {
  Product product{.names = {{"centres.png", "centres.svg"}, {"centres.csv", "centres.ply", "by_part.csv", "centres.nc"}},
                  .netcdf = "centres.nc",
                  .from_pieces = true,
                  .json = asked.json};
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
    const double middle = frequencies[middle_index(frequencies.size())];
    centres = centres_of_look(*source.target, *source.of_case, asked.centres, asked.run.work.threads,
                              progress_of_pieces(asked.run.work.quiet, asked.centres.look, middle));
    return asked.json ? centres_json(centres) : centres_text(centres.found, centres.s);
  };
  product.write_files = [&](const std::filesystem::path& folder) {
    write_centres_csv(folder / "centres.csv", centres.found, look(), part_of, source.title);
    write_centres_ply(folder / "centres.ply", centres.found);
    write_by_part_csv(folder / "by_part.csv", centres.pieces, centres.found.mechanisms, look(), part_of);
  };
  product.write_netcdf = [&](const std::filesystem::path& file) {
    write_centres_netcdf(file, source.result, centres.found, look(), part_of, source.lines());
  };
  product.drawn = "centres.csv";
  make_product(asked.run, product);
}

}  // namespace

CLI::App& add_centres(CommandLine& line) {
  const auto asked = std::make_shared<CentresRequest>();
  CLI::App& centres = add_command(line, "centres", "Scattering centres of a look", centres_examples);
  add_case_options(centres, asked->run.input);
  add_value(centres, "--look I", asked->centres.look, "Direction, counted from 0; default 0", whole_number(0, 1000000000));
  add_value(centres, "-n,--count N", asked->centres.count, "Maximum number of centres; default 50", whole_number(1, 1000));
  add_value(centres, "--resolution M", asked->centres.resolution,
            "Resolution of the places [m]; default that of the case's band, or a sixtieth of the target",
            number_between(least_length, most_length));
  add_output_option(centres, asked->run.output, "Folder for the results, or FILE.nc; default <case folder>/out");
  add_machine_options(line, centres, asked->run.work);
  add_quiet_option(centres, asked->run.work.quiet, "summary");
  add_json_option(centres, asked->json);
  return set_action(line, centres, [asked] { make_centres(*asked); });
}

}  // namespace raytube
