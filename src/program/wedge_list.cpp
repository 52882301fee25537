#include "program/wedge_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "output/tables/wedges_csv.h"
#include "output/vtk/wedges_vtp.h"
#include "program/work/results.h"
#include "utd/shadow/wedge_lines.h"

namespace raytube {

namespace {

bool wants_lines(const std::filesystem::path& file) { return file.extension() == ".vtp"; }

std::filesystem::path folder_of_wedges(const std::filesystem::path& file) {
  return folder_of_named_file("--wedges", file, wants_lines(file) ? wedges_vtp_head : wedges_csv_head);
}

}  // namespace

void check_wedges_file(const std::filesystem::path& file) {
  if (file.extension() != ".csv" && !wants_lines(file))
    throw InputError(
        fmt::format("--wedges {}: a list of wedges is a table or lines for ParaView; name a .csv or a .vtp", file.string()));
  folder_of_wedges(file);
}

void write_wedge_list(const std::filesystem::path& file, const TriangleMesh& mesh, std::span<const Wedge> wedges,
                      const Sweep& sweep) {
  NewResults results(folder_of_wedges(file));
  const std::vector<WedgeLine> lines =
      wedge_lines(mesh, wedges, sweep.looks.front(), wavelength(std::ranges::max(sweep.frequencies)));
  const std::filesystem::path written = results.folder() / file.filename();
  wants_lines(file) ? write_wedges_vtp(written, lines) : write_wedges_csv(written, lines);
  results.place({file.filename().string()});
}

}  // namespace raytube
