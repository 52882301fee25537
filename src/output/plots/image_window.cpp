#include "output/plots/image_window.h"

#include <algorithm>

namespace raytube {

namespace {

std::vector<double> hann_weights(double width, double cell) {
  std::vector<double> weights;  // of a cell and its neighbours to one side
  for (double x = 0.0; x < 0.5 * width; x += cell) weights.push_back(std::pow(std::cos(pi * x / width), 2));
  return weights;
}

// In place, along `count` cells that lie `step` apart, from `first` on.
void smooth_line(std::vector<ScatteringMatrix>& cells, std::size_t first, std::size_t step, std::size_t count,
                 const std::vector<double>& weights, std::vector<ScatteringMatrix>& line) {
  line.clear();
  for (std::size_t i = 0; i < count; ++i) line.push_back(cells[first + i * step]);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t reach = weights.size() - 1, begin = i > reach ? i - reach : 0, end = std::min(i + reach + 1, count);
    ScatteringMatrix sum;
    for (std::size_t j = begin; j < end; ++j)
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) sum.at(p, q) += weights[i > j ? i - j : j - i] * line[j].at(p, q);
    cells[first + i * step] = sum;
  }
}

}  // namespace

std::vector<ScatteringMatrix> seen_through_window(const ImageLattice& lattice, std::vector<ScatteringMatrix> cells,
                                                  double width) {
  std::vector<bool> empty;
  for (const ScatteringMatrix& s : cells) empty.push_back(largest_amplitude(s) == 0.0);
  const std::vector<double> weights_u = hann_weights(width, lattice.cell.x), weights_v = hann_weights(width, lattice.cell.y);
  std::vector<ScatteringMatrix> line;
  for (std::uint32_t row = 0; row < lattice.rows; ++row)
    smooth_line(cells, lattice.index({0, row}), 1, lattice.columns, weights_u, line);
  for (std::uint32_t column = 0; column < lattice.columns; ++column)
    smooth_line(cells, column, lattice.columns, lattice.rows, weights_v, line);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (empty[i]) cells[i] = {};
  return cells;
}

}  // namespace raytube
