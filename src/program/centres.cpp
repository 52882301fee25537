// raytube centres: a look of a case -> the places that it scatters from.
#include "imaging/centres.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/read_case.h"
#include "core/error.h"
#include "output/products/centres_csv.h"
#include "output/tables/csv.h"
#include "program/products.h"
#include "scene/sampling.h"
#include "solve/pieces.h"

namespace raytube {

namespace {

const ResultNames centre_names = {{}, {"centres.csv", "centres.ply", "by_part.csv"}};

constexpr double sides_to_a_target = 60.0, wavelengths_to_a_side = 2.0;

// A sixtieth of the target, but no less than what narrow bands and angles resolve.
double usual_side(const ProductSource& source, double wavelength) {
  return std::max(2.0 * source.target->mesh.radius / sides_to_a_target, wavelengths_to_a_side * wavelength);
}

LookAxes axes_of(const Direction& direction) {
  const SphericalBasis basis = spherical_basis(direction);
  return {-basis.radial, basis.phi_hat, -basis.theta_hat};
}

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

}  // namespace

void centres_command(const Request& request) {
  const ProductRequest& asked = request.product;
  const ProductSource source = unsolved_case(request);
  const Case& c = *source.of_case;
  check_output(product_folder(request), centre_names, input_files(c));
  if (request.look >= c.sweep.looks.size())
    throw InputError(fmt::format("{}: --look {}: the case has {} look{}, counted from 0", source.name, request.look,
                                 c.sweep.looks.size(), c.sweep.looks.size() == 1 ? "" : "s"));
  const Direction direction = c.sweep.looks[request.look].transmit;
  const double length = wavelength(c.sweep.frequencies[middle_index(c.sweep.frequencies.size())]);
  const double side = asked.resolution > 0.0 ? asked.resolution : usual_side(source, length);
  std::vector<ScatteringPiece> pieces;
  ScatteringMatrix s;
  pieces_of_look(request, source, request.look, side / pieces_to_a_cell, [&](const ScatteringPiece& piece) {
    pieces.push_back(piece);
    s += piece.s;
  });
  const ScatteringCentres found = scattering_centres(pieces, axes_of(direction), {asked.centres, side, length});
  if (!request.quiet) fmt::print("{}", centres_text(found, s));
  write_products(request, source, centre_names, [&](const std::filesystem::path& folder) {
    const CentreLook look{direction, speed_of_light / length, side};
    const auto part_of = [&mesh = source.target->mesh](std::uint32_t triangle) {
      return mesh.part_names[mesh.triangle_part[triangle]];
    };
    write_centres_csv(folder / "centres.csv", found, look, part_of);
    write_centres_ply(folder / "centres.ply", found);
    write_by_part_csv(folder / "by_part.csv", pieces, look, part_of);
  });
}

}  // namespace raytube
