#include "output/tables/read_image_csv.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "core/csv_reader.h"
#include "core/error.h"

namespace raytube {

namespace {

constexpr const char* image_remedy = "make it again with raytube run";

// The comment line on columns and rows, as write_image_csv has it; false for another line.
bool take_lattice(const std::string& line, ImageLattice& lattice) {
  dvec3 &u = lattice.u_hat, &v = lattice.v_hat;
  return std::sscanf(line.c_str(), "# %u columns of %lf m along u = (%lf, %lf, %lf), %u rows of %lf m along v = (%lf, %lf, %lf)",
                     &lattice.columns, &lattice.cell.x, &u.x, &u.y, &u.z, &lattice.rows, &lattice.cell.y, &v.x, &v.y, &v.z) == 10;
}

// The comment line of a look from a finite distance.
void take_perspective(const std::string& line, ImageLattice& lattice) {
  dvec3& at = lattice.middle_of_target;
  double distance = 0.0;
  if (std::sscanf(line.c_str(), "# Perspective from %lf m before the middle of the target, (%lf, %lf, %lf)", &distance, &at.x,
                  &at.y, &at.z) == 4)
    lattice.curvature = 1.0 / distance;
}

ImageLattice lattice_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  ImageLattice lattice;
  bool known = false;
  for (std::string line; std::getline(in, line) && line.starts_with('#'); take_perspective(line, lattice))
    if (take_lattice(line, lattice)) known = true;
  if (known) return lattice;
  throw InputError(fmt::format("{}: does not say its columns and rows; {}", file.string(), image_remedy));
}

// The same rectangle, or a little more, in larger cells.
ImageLattice coarser(const ImageLattice& fine, std::uint32_t side) {
  ImageLattice lattice = fine;
  lattice.columns = (fine.columns + side - 1) / side;
  lattice.rows = (fine.rows + side - 1) / side;
  lattice.cell *= static_cast<double>(side);
  return lattice;
}

}  // namespace

LookImage read_image_csv(const std::filesystem::path& file, std::uint32_t most_across) {
  const ImageLattice fine = lattice_of(file);
  const std::uint32_t side = (std::max({fine.columns, fine.rows, 1u}) + most_across - 1) / most_across;
  LookImage image;
  image.lattice = coarser(fine, side);
  image.cells.resize(image.lattice.cells());
  CsvReader reader(file, image_remedy);
  constexpr std::size_t columns = 12;  // row, col, u_m, v_m, re and im of four channels
  for (bool first = true; reader.next(); first = false) {
    const auto number = [&](std::size_t column) { return reader.finite_number(column, image_remedy); };
    if (reader.columns().size() < columns || !(number(0) < fine.rows) || !(number(1) < fine.columns))
      throw InputError(fmt::format("{}: is no cell of this image; {}", reader.location(), image_remedy));
    if (first) image.lattice.corner = dvec2(number(2), number(3)) - 0.5 * fine.cell;
    const glm::uvec2 at(static_cast<std::uint32_t>(number(1)) / side, static_cast<std::uint32_t>(number(0)) / side);
    ScatteringMatrix& s = image.cells[image.lattice.index(at)];
    for (std::size_t channel = 0; channel < 4; ++channel)
      s.s[channel / 2][channel % 2] += Complex(number(4 + 2 * channel), number(5 + 2 * channel));
  }
  return image;
}

}  // namespace raytube
