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
double most_per_wavelength(const TriangleMesh& mesh, const Look& look, double wavelength, const std::optional<dvec3>& up) {
  return look.far() ? most_across * wavelength / (2.0 * mesh.radius)
                    : 1e-6 * most_across * densest_grid(mesh, look, wavelength, up);
}

// Coordinates of the solver count from the centre of the mesh.
ImageLattice recentred(ImageLattice lattice, const TriangleMesh& mesh) {
  lattice.corner -= lattice.project(mesh.center);
  lattice.middle_of_target = dvec3(0.0);
  return lattice;
}

void make_image_reciprocal(LookImage& image) {
  for (ImageEdge& piece : image.edges) make_reciprocal(std::span(&piece.s, 1));
  make_reciprocal(image.cells), make_reciprocal(image.triangles);
}

// To the phase reference and the coordinates of the mesh.
void refer_to_origin(LookImage& image, const SolvePlan& plan) {
  const TriangleMesh& mesh = plan.target.mesh;
  const Complex factor = to_mesh_origin(mesh, plan.sweep.looks[image.look], image.frequency);
  for (ImageEdge& piece : image.edges) piece.begin += mesh.center, piece.end += mesh.center, piece.s *= factor;
  for (std::vector<ScatteringMatrix>* parts : {&image.cells, &image.triangles})
    for (ScatteringMatrix& s : *parts) s *= factor;
}

// Of a look that is computed, in cells of the lattice, which is recentred.
LookImage computed_image(const LookSolver& solver, const SolvePlan& plan, std::size_t look, const ImageLattice& lattice,
                         Progress& progress) {
  const std::size_t frequency_index = image_frequency(plan.sweep);
  LookImage image{look, plan.sweep.frequencies[frequency_index], lattice, {}, {}, {}};
  solver.solve_image(look, frequency_index, lattice, progress, image);
  for (const ImageEdge& piece : image.edges)
    image.cells[lattice.index(lattice.at(lattice.project(0.5 * (piece.begin + piece.end))))] += piece.s;
  if (!plan.sweep.bistatic) make_image_reciprocal(image);
  refer_to_origin(image, plan);
  return image;
}

// --- over ground ---

// What looks are lit by way of the ground is seen at its mirror image, in cells of the straight look. Lattices are recentred.

double height_of_ground(const SolvePlan& plan) { return plan.ground->height - plan.target.mesh.center.z; }

// The mirror image of a place on a lattice, at the depth of the middle of the target.
dvec3 mirrored(const ImageLattice& lattice, const dvec2& at, double height) {
  const dvec3 point = at.x * lattice.u_hat + at.y * lattice.v_hat;
  return {point.x, point.y, 2.0 * height - point.z};
}

// Its lines are those of the mirrored one where both are seen from afar.
ImageLattice lattice_by_ground(const SolvePlan& plan, const Look& look, const ImageLattice& seen) {
  const LaunchGrid grid = grid_of_look(plan.target.mesh, look, plan.target.mesh.radius, 1.0, plan.tubes.up);
  ImageLattice lattice = image_lattice(grid);
  const dvec2 line = lattice.project(mirrored(seen, seen.corner, height_of_ground(plan))), low = lattice.corner;
  const dvec2 high = low + dvec2(grid.columns, grid.rows) * lattice.cell;
  lattice.cell = seen.cell;
  lattice.corner = line + glm::floor((low - line) / seen.cell) * seen.cell;
  const dvec2 cells = glm::max(glm::ceil((high - lattice.corner) / seen.cell), dvec2(1.0));
  lattice.columns = static_cast<std::uint32_t>(cells.x), lattice.rows = static_cast<std::uint32_t>(cells.y);
  return lattice;
}

// Shares S of a cell out between the cells between whose middles it is seen: in perspective cells are of other sizes.
void add_mirrored(const ImageLattice& lattice, const glm::uvec2& cell, const ScatteringMatrix& s, double height,
                  LookImage& image) {
  constexpr double rounding = 1e-13;  // of a cell: what lies on its middle is in it alone
  const ImageLattice& seen = image.lattice;
  const dvec2 middle = seen.project(mirrored(lattice, lattice.middle(cell), height));
  const dvec2 at = (middle - seen.corner) / seen.cell - 0.5, low = glm::floor(at + rounding);
  const dvec2 high = glm::max(at - low, dvec2(0.0));
  for (const double u : {0.0, 1.0})
    for (const double v : {0.0, 1.0}) {
      const double share = (u == 0.0 ? 1.0 - high.x : high.x) * (v == 0.0 ? 1.0 - high.y : high.y);
      ScatteringMatrix part = s;
      if (share > rounding)
        image.cells[seen.index(seen.at(seen.corner + (low + dvec2(u, v) + 0.5) * seen.cell))] += part *= share;
    }
}

// The share of one path.
void add_path(const LookSolver& solver, const SolvePlan& plan, std::size_t path, Progress& progress, LookImage& image) {
  const GroundReflections reflections = plan.reflections();
  const PathFactors factors = reflections.factors(path, image_frequency(plan.sweep));
  const bool by_ground = reflections.path(path).lit_by_ground;
  const ImageLattice lattice = by_ground ? lattice_by_ground(plan, plan.sweep.looks[path], image.lattice) : image.lattice;
  const LookImage part = computed_image(solver, plan, path, lattice, progress);
  for (std::uint32_t row = 0; row < lattice.rows; ++row)
    for (std::uint32_t column = 0; column < lattice.columns; ++column) {
      const std::size_t cell = lattice.index({column, row});
      const ScatteringMatrix s = factors(part.cells[cell]);
      by_ground ? add_mirrored(lattice, {column, row}, s, height_of_ground(plan), image) : void(image.cells[cell] += s);
    }
  for (std::size_t i = 0; i < part.triangles.size(); ++i) image.triangles[i] += factors(part.triangles[i]);
  for (const ImageEdge& piece : part.edges) image.edges.push_back({piece.begin, piece.end, factors(piece.s)});
}

LookImage image_over_ground(const SolvePlan& plan, std::size_t look, const ImageLattice& seen,
                            const std::function<bool(double)>& callback) {
  const std::size_t paths = plan.reflections().paths_of_a_look();
  LookImage image{look, plan.sweep.frequencies[image_frequency(plan.sweep)], seen, {}, {}, {}};
  image.cells.resize(seen.cells()), image.triangles.resize(plan.target.mesh.triangles.size());
  const LookSolver solver(plan);
  for (std::size_t path = 0; path < paths; ++path) {
    const auto told = [&](double done) { return callback((static_cast<double>(path) + done) / static_cast<double>(paths)); };
    Progress progress(callback ? told : std::function<bool(double)>());
    add_path(solver, plan, look * paths + path, progress, image);
  }
  if (!plan.asked.bistatic) make_image_reciprocal(image);
  return image;
}

LookImage image_of(const SolvePlan& plan, std::size_t look, const ImageLattice& cells,
                   const std::function<bool(double)>& callback) {
  const ImageLattice lattice = recentred(cells, plan.target.mesh);
  Progress progress(callback);
  LookImage image = plan.ground ? image_over_ground(plan, look, lattice, callback)
                                : computed_image(LookSolver(plan), plan, look, lattice, progress);
  image.lattice = cells;
  return image;
}

// The outline of what is seen over a medium: the target and, below it, its mirror image, as over a conductor.
TriangleMesh with_mirror_image(const SolvePlan& plan, const Look& look) {
  TriangleMesh mesh;
  mesh.vertices = plan.target.mesh.vertices, mesh.center = plan.target.mesh.center, mesh.radius = plan.target.mesh.radius;
  const double plane = plan.ground->height - mesh.center.z;
  for (const dvec3& vertex : plan.target.mesh.vertices) mesh.vertices.push_back({vertex.x, vertex.y, 2.0 * plane - vertex.z});
  if (!look.far() && !stands_in_front(mesh, look.transmitter().point() - mesh.center))
    throw InputError(
        "output.image_look: the antenna sees the mirror image of the target farther than 45 degrees beside the target; move it "
        "away, or leave out output.image_look");
  return mesh;
}

}  // namespace

std::size_t image_frequency(const Sweep& sweep) { return sweep.frequencies.size() / 2; }

ImageLattice image_cells(const SolvePlan& plan, std::size_t look, double per_wavelength) {
  const Sweep& sweep = plan.asked;
  std::optional<TriangleMesh> both;
  if (plan.ground && !plan.ground->perfect()) both = with_mirror_image(plan, sweep.looks.at(look));
  const TriangleMesh& mesh = both ? *both : plan.target.mesh;
  const double length = wavelength(sweep.frequencies.at(image_frequency(sweep)));
  const double most = most_per_wavelength(mesh, sweep.looks.at(look), length, plan.tubes.up);
  const bool too_many = per_wavelength > most;
  const LaunchGrid cells = grid_of_look(mesh, sweep.looks[look], length, std::min(per_wavelength, most), plan.tubes.up);
  if (cells.cells() == 0)
    throw InputError(fmt::format(
        "output.image_look: look {} sees no area of the target, so there is nothing to divide; choose another", look));
  if (too_many || static_cast<double>(cells.cells()) > most_cells)
    throw InputError(
        fmt::format("output.image_per_wavelength: {:.6g} cells per wavelength are more than {:.0f} in look {}; {} would fit",
                    per_wavelength, most_cells, look, rounded_down_text(std::min(densest_image(cells, length), most))));
  ImageLattice lattice = image_lattice(cells);
  lattice.middle_of_target = mesh.center;
  lattice.corner += lattice.project(mesh.center);
  return lattice;
}

LookImage image_of_look(const SolvePlan& plan, std::size_t look, double per_wavelength,
                        const std::function<bool(double)>& callback) {
  if (plan.rays())
    throw InputError("output.image_look: edges.method \"utd\" adds up rays, not currents; write \"fringe\" or \"none\"");
  const ImageLattice cells = image_cells(plan, look, per_wavelength);
  LookImage image;
  run_on_threads(plan.threads, [&] { image = image_of(plan, look, cells, callback); });
  return image;
}

LookImage image_of_look(const Target& target, const Sweep& sweep, const SolveOptions& options, std::size_t look,
                        double per_wavelength) {
  return image_of_look(SolvePlan(target, sweep, options), look, per_wavelength, options.progress);
}

}  // namespace raytube
