#include "output/tables/image_csv.h"

#include <fmt/format.h>

#include "core/decimal.h"
#include "output/files/files.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr const char* image_conventions =
    "# S of one look by the cells of its launch rectangle as seen from the transmitter: columns along u to the right, rows "
    "along\n"
    "# v upwards, both from 0. u_m, v_m: the middle of a cell, counted from the origin of the mesh's coordinates.\n"
    "# The cells add up to S of this look and frequency in rcs.csv. Light is in the cell it set out from, at all its bounces; "
    "an\n"
    "# edge, with the currents that begin at it, in the cells where it is seen.\n"
    "# Time factor exp(+j omega t); a wave travels as exp(-j k r). Phase reference: the origin of the mesh's coordinates.\n"
    "# Scattering amplitude S_pq [m], p receive, q transmit; sigma_pq = 4 pi |S_pq|^2; dBsm is 10 log10(sigma / 1 m^2).\n";

std::string look_note(const Sweep& sweep, const LookImage& image) {
  const auto text = [](const Direction& d) {
    return fmt::format("theta {} phi {}", number_text(decimal_degrees(d.theta)), number_text(decimal_degrees(d.phi)));
  };
  const Look& look = sweep.looks[image.look];
  return fmt::format("# Look {}, {} deg to the transmitter, {} deg to the receiver; {} Hz.\n", image.look, text(look.transmit),
                     text(look.receive), number_text(image.frequency)) +
         fmt::format("# {} columns of {} m along u = {}, {} rows of {} m along v = {}.\n", image.lattice.columns,
                     number_text(image.lattice.cell.x), vector_text(image.lattice.u_hat), image.lattice.rows,
                     number_text(image.lattice.cell.y), vector_text(image.lattice.v_hat));
}

std::string perspective_note(const ImageLattice& lattice) {
  if (lattice.curvature == 0.0) return {};
  return fmt::format(
      "# Perspective from {} m before the middle of the target, {} m: u and v are drawn to scale there, and\n"
      "# count from where the origin of the mesh's coordinates is seen.\n",
      number_text(1.0 / lattice.curvature), vector_text(lattice.middle_of_target));
}

std::string image_columns() {
  std::string names = "row,col,u_m,v_m";
  for (const char* channel : channel_names) names += fmt::format(",re_{0},im_{0}", channel);
  for (const char* channel : channel_names) names += fmt::format(",sigma_{}_dbsm", channel);
  for (const char* channel : channel_names) names += fmt::format(",phase_{}_rad", channel);
  return names + '\n';
}

double phase(Complex value) { return std::atan2(value.imag() + 0.0, value.real() + 0.0); }  // never that of a negative zero

std::string row_text(const glm::uvec2& at, const dvec2& middle, const ScatteringMatrix& s) {
  std::string line = fmt::format("{},{},{},{}", at.y, at.x, number_text(middle.x), number_text(middle.y));
  const auto each = [&](auto text_of) {
    for (int channel = 0; channel < 4; ++channel) line += ',' + text_of(s.at(channel / 2, channel % 2));
  };
  each([](Complex value) { return number_text(value.real()) + ',' + number_text(value.imag()); });
  // They follow from S: short.
  each([](Complex value) { return fmt::format("{:.2f}", sigma_dbsm(value)); });
  each([](Complex value) { return fmt::format("{:.4f}", phase(value)); });
  return line + '\n';
}

}  // namespace

void write_image_csv(const std::filesystem::path& file, const Sweep& sweep, const LookImage& image) {
  OutputFile out(file);
  out.write(image_conventions + look_note(sweep, image) + perspective_note(image.lattice) + image_columns());
  for (std::uint32_t row = 0; row < image.lattice.rows; ++row)
    for (std::uint32_t column = 0; column < image.lattice.columns; ++column) {
      const glm::uvec2 at(column, row);
      out.write(row_text(at, image.lattice.middle(at), image.cells[image.lattice.index(at)]));
    }
  out.commit();
}

}  // namespace raytube
