#include "solve/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.h"
#include "core/error.h"
#include "sbr/beams/current_map.h"
#include "solve/parts.h"

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

// Coordinates of the solver count from the centre of the mesh.
ImageLattice recentred(ImageLattice lattice, const TriangleMesh& mesh) {
  lattice.corner -= lattice.place(mesh.center);
  return lattice;
}

// Within a cell each, with a share of S by length.
void add_cut_up(const ImageEdge& piece, const ImageLattice& lattice, std::vector<ImageEdge>& pieces) {
  const std::vector<double> shares = lattice.crossings(piece.begin, piece.end);
  const dvec3 way = piece.end - piece.begin;
  for (std::size_t i = 1; i < shares.size(); ++i) {
    ScatteringMatrix part = piece.s;
    pieces.push_back({piece.begin + shares[i - 1] * way, piece.begin + shares[i] * way, part *= shares[i] - shares[i - 1]});
  }
}

std::vector<ImageEdge> edge_pieces(const Target& target, const Sweep& sweep, const SolveOptions& options, const Look& look,
                                   std::size_t frequency, const ImageLattice& lattice, const TubeSums& tubes) {
  if (options.edges.method != EdgeMethod::fringe) return {};
  const EdgeSets edges(edge_setup(target, sweep, options));
  std::vector<ImageEdge> pieces;
  if (edges_count(edges, options)) pieces = edges.pieces(look, frequency, lattice);
  for (const ImageEdge& piece : edges.interaction_pieces(look, frequency, interaction_tolerance(tubes, options)))
    add_cut_up(piece, lattice, pieces);
  return pieces;
}

// To the phase reference and the coordinates of the mesh, with the symmetry of a monostatic look.
void finish(LookImage& image, const Target& target, const Sweep& sweep) {
  const Complex factor = to_mesh_origin(target.mesh, sweep.looks[image.look], image.frequency);
  for (ImageEdge& piece : image.edges) {
    piece.begin += target.mesh.center;
    piece.end += target.mesh.center;
    if (!sweep.bistatic) make_reciprocal(std::span(&piece.s, 1));
    piece.s *= factor;
  }
  for (std::vector<ScatteringMatrix>* parts : {&image.cells, &image.triangles}) {
    if (!sweep.bistatic) make_reciprocal(*parts);
    for (ScatteringMatrix& s : *parts) s *= factor;
  }
}

LookImage image_of(const Target& target, const Sweep& sweep, const SolveOptions& options, std::size_t index,
                   const ImageLattice& cells) {
  const std::size_t f = image_frequency(sweep);
  const ImageLattice lattice = recentred(cells, target.mesh);
  CurrentMap map(target.faces, lattice, f, wavenumber(sweep.frequencies[f]));
  const std::optional<SmoothSurfaces> smooth = smooth_surfaces(target, sweep, options.tubes);
  Progress progress(options.progress);
  const Look& look = sweep.looks[index];
  const TubeSums tubes = sbr_scattering(target.tracer, target.faces, smooth ? &*smooth : nullptr, target.convexity, look,
                                        sweep.frequencies, options.tubes, progress, 1.0, sweep.radar, sweep.materials, &map);
  LookImage image{index, sweep.frequencies[f], cells, map.take_cells(), map.take_triangles(), {}};
  image.edges = edge_pieces(target, sweep, options, look, f, lattice, tubes);
  for (const ImageEdge& piece : image.edges)
    image.cells[lattice.index(lattice.at(lattice.place(0.5 * (piece.begin + piece.end))))] += piece.s;
  finish(image, target, sweep);
  return image;
}

}  // namespace

std::size_t image_frequency(const Sweep& sweep) { return sweep.frequencies.size() / 2; }

ImageLattice image_cells(const Target& target, const Sweep& sweep, const SolveOptions& options, std::size_t look,
                         double per_wavelength) {
  if (!all_far(sweep))
    throw InputError("output.image_look: images from a finite distance are not in this version; remove [radar]");
  const double length = wavelength(sweep.frequencies.at(image_frequency(sweep)));
  const double across = 2.0 * target.mesh.radius;
  const bool too_many = across * per_wavelength / length > most_across;
  const LaunchGrid cells = launch_grid(target.mesh, sweep.looks.at(look).transmit, length,
                                       too_many ? most_across * length / across : per_wavelength, options.tubes.up);
  if (cells.cells() == 0)
    throw InputError(fmt::format(
        "output.image_look: look {} sees no area of the target, so there is nothing to divide; choose another", look));
  if (too_many || static_cast<double>(cells.cells()) > most_cells)
    throw InputError(fmt::format(
        "output.image_per_wavelength: {:.6g} cells per wavelength are more than {:.0f} in look {}; {} would fit", per_wavelength,
        most_cells, look, rounded_down_text(std::min(densest_image(cells, length), most_across * length / across))));
  ImageLattice lattice = image_lattice(cells);
  lattice.corner += lattice.place(target.mesh.center);
  return lattice;
}

LookImage image_of_look(const Target& target, const Sweep& sweep, const SolveOptions& options, std::size_t look,
                        double per_wavelength) {
  check(sweep, options);
  if (options.edges.method == EdgeMethod::utd)
    throw InputError("output.image_look: edges.method \"utd\" adds up rays, not currents; write \"fringe\" or \"none\"");
  if (options.edges.materials != MaterialEdgeMethod::none)
    throw InputError(
        "output.image_look: the heuristic of edges.materials has no place in an image; write edges.materials = \"none\"");
  check_materials(target.mesh, sweep);
  const ImageLattice cells = image_cells(target, sweep, options, look, per_wavelength);
  LookImage image;
  run_on_threads(options.threads, [&] { image = image_of(target, sweep, options, look, cells); });
  return image;
}

}  // namespace raytube
