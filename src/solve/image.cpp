#include "solve/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.h"
#include "core/error.h"
#include "core/threads.h"
#include "plan/phase_reference.h"
#include "sbr/beams/current_map.h"
#include "solve/look_solver.h"

namespace raytube {

namespace {

constexpr double most_across = 1e5, most_cells = 4e6;  // a table of a gigabyte

// Of cells per wavelength, with one cell along each side for what is rounded up: (u d + 1) (v d + 1) = most_cells for the sides
// u, v in wavelengths, in the form that loses no digits where u + v is large.
double densest_image(const LaunchGrid& grid, double wavelength) {
  const double u = grid.columns * grid.du / wavelength, v = grid.rows * grid.dv / wavelength;
  const double rest = most_cells - 1.0;
  return 2.0 * rest / (u + v + std::sqrt((u + v) * (u + v) + 4.0 * u * v * rest));
}

// A launch grid has 10^6 cells along its longer side at most.
double most_per_wavelength(const SolvePlan& plan, const Look& look, double wavelength) {
  const TriangleMesh& mesh = plan.target.mesh;
  return look.far() ? most_across * wavelength / (2.0 * mesh.radius)
                    : 1e-6 * most_across * densest_grid(mesh, look, wavelength, plan.tubes.up);
}

// Coordinates of the solver count from the centre of the mesh.
ImageLattice recentred(ImageLattice lattice, const TriangleMesh& mesh) {
  lattice.corner -= lattice.project(mesh.center);
  lattice.middle_of_target = dvec3(0.0);
  return lattice;
}

// To the phase reference and the coordinates of the mesh, with the symmetry of a monostatic look.
void finish(LookImage& image, const SolvePlan& plan) {
  const TriangleMesh& mesh = plan.target.mesh;
  const Complex factor = to_mesh_origin(mesh, plan.sweep.looks[image.look], image.frequency);
  for (ImageEdge& piece : image.edges) {
    piece.begin += mesh.center;
    piece.end += mesh.center;
    if (!plan.sweep.bistatic) make_reciprocal(std::span(&piece.s, 1));
    piece.s *= factor;
  }
  for (std::vector<ScatteringMatrix>* parts : {&image.cells, &image.triangles}) {
    if (!plan.sweep.bistatic) make_reciprocal(*parts);
    for (ScatteringMatrix& s : *parts) s *= factor;
  }
}

LookImage image_of(const SolvePlan& plan, std::size_t index, const ImageLattice& cells, Progress& progress) {
  const std::size_t frequency_index = image_frequency(plan.sweep);
  const ImageLattice lattice = recentred(cells, plan.target.mesh);
  LookImage image{index, plan.sweep.frequencies[frequency_index], cells, {}, {}, {}};
  LookSolver(plan).solve_image(index, frequency_index, lattice, progress, image);
  for (const ImageEdge& piece : image.edges)
    image.cells[lattice.index(lattice.at(lattice.project(0.5 * (piece.begin + piece.end))))] += piece.s;
  finish(image, plan);
  return image;
}

}  // namespace

std::size_t image_frequency(const Sweep& sweep) { return sweep.frequencies.size() / 2; }

ImageLattice image_cells(const SolvePlan& plan, std::size_t look, double per_wavelength) {
  const Sweep& sweep = plan.sweep;
  const double length = wavelength(sweep.frequencies.at(image_frequency(sweep)));
  const double most = most_per_wavelength(plan, sweep.looks.at(look), length);
  const bool too_many = per_wavelength > most;
  const LaunchGrid cells =
      grid_of_look(plan.target.mesh, sweep.looks[look], length, std::min(per_wavelength, most), plan.tubes.up);
  if (cells.cells() == 0)
    throw InputError(fmt::format(
        "output.image_look: look {} sees no area of the target, so there is nothing to divide; choose another", look));
  if (too_many || static_cast<double>(cells.cells()) > most_cells)
    throw InputError(
        fmt::format("output.image_per_wavelength: {:.6g} cells per wavelength are more than {:.0f} in look {}; {} would fit",
                    per_wavelength, most_cells, look, rounded_down_text(std::min(densest_image(cells, length), most))));
  ImageLattice lattice = image_lattice(cells);
  lattice.middle_of_target = plan.target.mesh.center;
  lattice.corner += lattice.project(plan.target.mesh.center);
  return lattice;
}

LookImage image_of_look(const SolvePlan& plan, std::size_t look, double per_wavelength,
                        const std::function<bool(double)>& callback) {
  if (plan.rays())
    throw InputError("output.image_look: edges.method \"utd\" adds up rays, not currents; write \"fringe\" or \"none\"");
  if (plan.edges.materials != MaterialEdgeMethod::none)
    throw InputError(
        "output.image_look: the heuristic of edges.materials is not available in images; write edges.materials = \"none\"");
  const ImageLattice cells = image_cells(plan, look, per_wavelength);
  Progress progress(callback);
  LookImage image;
  run_on_threads(plan.threads, [&] { image = image_of(plan, look, cells, progress); });
  return image;
}

LookImage image_of_look(const Target& target, const Sweep& sweep, const SolveOptions& options, std::size_t look,
                        double per_wavelength) {
  return image_of_look(SolvePlan(target, sweep, options), look, per_wavelength, options.progress);
}

}  // namespace raytube
