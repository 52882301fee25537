#include "jobs/centres_of_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/error.h"
#include "imaging/direct.h"
#include "jobs/solvable.h"
#include "plan/mechanism.h"
#include "solve/pieces.h"

namespace raytube {

namespace {

constexpr double sides_to_a_target = 60.0, fewest_sides = 8.0, wavelengths_to_a_side = 2.0;

// What the case's own band resolves, which its rows are rebuilt over, if that tells parts of the target from each other. No less
// than what narrow bands and angles resolve.
double usual_side(const Target& target, std::span<const double> frequencies, double wavelength) {
  const auto [lowest, highest] = std::ranges::minmax(frequencies);
  const double size = 2.0 * target.mesh.radius, cell = 0.5 * speed_of_light / (highest - lowest);
  return std::max(fewest_sides * cell < size ? cell : size / sides_to_a_target, wavelengths_to_a_side * wavelength);
}

LookCentres found_centres(const Target& target, const Case& c, const CentresAsked& asked, int threads,
                          const std::function<bool(double)>& progress) {
  require_look(c, asked.look);
  if (const double extent = 2.0 * target.mesh.radius; asked.resolution > extent)
    throw InputError(
        fmt::format("a resolution of {:g} m is wider than the target, {:.3g} m; ask for a finer one", asked.resolution, extent));
  const std::vector<double>& frequencies = c.sweep.frequencies;
  LookCentres result{.found = {},
                     .pieces = {},
                     .s = {},
                     .direction = c.sweep.looks[asked.look].transmit,
                     .frequency = frequencies[middle_index(frequencies.size())],
                     .side = asked.resolution};
  const double length = wavelength(result.frequency);
  if (result.side == 0.0) result.side = usual_side(target, frequencies, length);
  SolveOptions options{c.tubes, c.edges, c.surfaces, threads};
  options.progress = progress;
  scattering_pieces(
      target, c.sweep, asked.look, result.frequency, options, result.side / pieces_to_a_cell,
      [&](const ScatteringPiece& piece) {
        result.pieces.push_back(piece);
        result.s += piece.s;
      },
      c.ground);
  result.found = scattering_centres(result.pieces, axes_of_look(result.direction),
                                    {asked.count, result.side, length, piece_names(mechanism_list())});
  return result;
}

}  // namespace

LookCentres centres_of_look(const Target& target, const Case& c, const CentresAsked& asked, int threads,
                            const std::function<bool(double)>& progress) {
  return naming_the_case(c, [&] { return found_centres(target, c, asked, threads, progress); });
}

}  // namespace raytube
