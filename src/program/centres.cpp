// raytube centres: a look of a case -> the places that it scatters from.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/read_case.h"
#include "jobs/centres_of_look.h"
#include "output/imaging/centres_plot.h"
#include "output/products/centres_csv.h"
#include "output/products/centres_netcdf.h"
#include "output/tables/csv.h"
#include "program/products.h"
#include "program/work/interrupt.h"

namespace raytube {

namespace {

const ProductNames centre_names = {{{"centres.png", "centres.svg"}, {"centres.csv", "centres.ply", "by_part.csv"}}, "centres.nc"};

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

void draw_centres(const std::filesystem::path& folder, const ProductSource& source, const LookCentres& centres) {
  const std::string look = fmt::format("scattering centres of θ = {:g}°, φ = {:g}° at {:g} GHz", centres.direction.theta / degree,
                                       centres.direction.phi / degree, centres.frequency * 1e-9);
  const std::string trouble =
      plot_centres(folder, {source.title, look}, centres.found, axes_of_look(centres.direction), source.lines());
  if (!trouble.empty()) warn("no picture of the centres: " + trouble);
}

}  // namespace

void centres_command(const Request& request) {
  const ProductRequest& asked = request.product;
  const ProductSource source =
      product_source(request, [&](const ProductSource& unsolved) { check_products(request, unsolved, centre_names); });
  const LookCentres centres = centres_of_look(*source.target, *source.of_case, {request.look, asked.centres, asked.resolution},
                                              request.threads, [](double) { return !InterruptFlag::raised(); });
  if (!request.quiet) fmt::print("{}", centres_text(centres.found, centres.s));
  const CentreLook look{centres.direction, centres.frequency, centres.side};
  const auto part_of = [&mesh = source.target->mesh](std::uint32_t triangle) {
    return mesh.part_names[mesh.triangle_part[triangle]];
  };
  const auto write_files = [&](const std::filesystem::path& folder) {
    write_centres_csv(folder / "centres.csv", centres.found, look, part_of);
    write_centres_ply(folder / "centres.ply", centres.found);
    write_by_part_csv(folder / "by_part.csv", centres.pieces, look, part_of);
    stop_if_interrupted();
    draw_centres(folder, source, centres);
  };
  write_products(request, source, centre_names, {write_files, [&](const std::filesystem::path& file) {
                                                   write_centres_netcdf(file, source.result, centres.found, look, part_of);
                                                 }});
}

}  // namespace raytube
