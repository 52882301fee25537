#include "solve/pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/threads.h"
#include "plan/phase_reference.h"
#include "plan/plan.h"
#include "solve/image.h"
#include "solve/look_solver.h"

namespace raytube {

namespace {

// As of the slices of currents.
constexpr double edge_pieces_to_a_wavelength = 16.0;

// Throws InputError for looks whose pieces have no one place, or do not tell of other frequencies.
void check_pieces(const Sweep& sweep, const SolveOptions& options, const std::optional<Ground>& ground) {
  if (sweep.bistatic) throw InputError("the pieces of bistatic looks have no one place; remove [receive], or compute the sweep");
  if (!sweep.looks.front().far())
    throw InputError("the pieces seen from a finite distance have no one place; remove [radar], or compute the sweep");
  if (ground && !ground->perfect())
    throw InputError(
        "what a medium reflects changes with angle and frequency, so that one look does not tell of others; write "
        "ground.material = \"pec\", or compute the sweep");
  if (!sweep.materials.empty())
    throw InputError("materials change with frequency, so that one does not tell of others; compute the sweep");
  if (options.edges.method == EdgeMethod::utd)
    throw InputError("edges.method \"utd\" adds up rays, which have no pieces; write \"fringe\" or \"none\"");
}

ImageLattice lattice_of_pieces(const SolvePlan& plan, double wavelength, double cell) {
  try {
    return image_cells(plan, 0, wavelength / cell);
  } catch (const InputError&) {
    throw InputError(
        fmt::format("the look sees no area of the target, or has too many pieces of {:.3g} m; take another look, or resolve it "
                    "more coarsely",
                    cell));
  }
}

// Cells of at least so many to the metre: none of them is held.
ImageLattice divided(ImageLattice lattice, double to_a_metre) {
  const auto times = static_cast<std::uint32_t>(std::max(1.0, std::ceil(to_a_metre * std::max(lattice.cell.x, lattice.cell.y))));
  lattice.cell /= times;
  lattice.columns *= times, lattice.rows *= times;
  return lattice;
}

}  // namespace

void scattering_pieces(const Target& target, const Sweep& sweep, std::size_t look, double frequency, const SolveOptions& options,
                       double cell, const PieceSink& sink, const std::optional<Ground>& ground) {
  check_pieces(sweep, options, ground);
  Sweep one = sweep;
  one.frequencies = {frequency}, one.looks = {sweep.looks[look]};
  const SolvePlan plan(target, one, options, ground);
  ImageLattice lattice = lattice_of_pieces(plan, wavelength(frequency), cell);
  lattice.corner -= lattice.project(target.mesh.center);
  const ImageLattice fine = divided(lattice, edge_pieces_to_a_wavelength / wavelength(frequency));
  const LookSolver solver(plan);
  for (std::size_t path = 0; path < plan.sweep.looks.size(); ++path) {  // one without ground
    const Complex factor = to_mesh_origin(target.mesh, plan.sweep.looks[path], frequency);
    std::optional<PathFactors> by_ground;
    std::optional<double> mirror;  // in recentred coordinates
    if (plan.ground) {
      const GroundReflections reflections = plan.reflections();
      by_ground = reflections.factors(path, 0);
      if (reflections.path(path).seen_by_ground) mirror = plan.ground->height - target.mesh.center.z;
    }
    const auto finish = [&](ScatteringPiece piece) {
      piece.place += target.mesh.center;
      if (by_ground) piece.s = (*by_ground)(piece.s);
      make_reciprocal(std::span(&piece.s, 1));
      piece.s *= factor;
      sink(piece);
    };
    Progress progress(options.progress);
    run_on_threads(plan.threads, [&] { solver.solve_pieces(path, lattice, fine, progress, finish, mirror); });
  }
}

}  // namespace raytube
