#include "jobs/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <vector>

#include "core/csv_reader.h"
#include "core/decimal.h"
#include "core/error.h"
#include "output/tables/stored.h"
#include "solve/image.h"
#include "solve/memory.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr double nothing_said = std::numeric_limits<double>::infinity();
constexpr double bytes_per_thread = 4e6;       // stacks, buffers of the allocator, of tiles and of Embree
constexpr double bytes_per_triangle = 1000.0;  // of a target and its plan
constexpr double journal_bytes = 6e6;          // looks that wait to be kept, and their records
constexpr double bytes_per_cell = 80.0;        // of an image: its sum, and a little for its pictures
constexpr double bytes_per_angle = 100.0;      // of a case: the value, and what run.json says of it

// The number behind a word in a file of "word number" lines.
double number_after(const fs::path& file, const std::string& word) {
  std::ifstream in(file);
  double value = 0.0;
  for (std::string name; in >> name; in.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
    if (name == word && in >> value) return value;
  return 0.0;
}

std::optional<double> number_in(const fs::path& file) {
  std::string text;
  std::ifstream(file) >> text;
  return parsed_number(text);  // "max" is none
}

struct Held {
  double resident, virtual_size;
};

Held held_now() {
  double pages = 0.0, resident = 0.0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
  return {resident * page, pages * page};
}

// The files in which a control group says what it may have, has, and could give back at once: caches of files.
struct GroupFiles {
  fs::path root;
  const char *most, *used, *cache;
};
const GroupFiles version_1{"/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_cache"};
const GroupFiles version_2{"/sys/fs/cgroup", "memory.max", "memory.current", "file"};

// Free under the limits of a group and of those it is part of. In a container the root is its own group.
double free_in_group(const GroupFiles& files, const std::string& path) {
  double least = nothing_said;
  for (fs::path at = path;; at = at.parent_path()) {
    const fs::path group = files.root / at.relative_path();
    const std::optional<double> most = number_in(group / files.most), used = number_in(group / files.used);
    if (most && used) least = std::min(least, std::max(0.0, *most - *used + number_after(group / "memory.stat", files.cache)));
    if (!at.has_relative_path()) return least;
  }
}

// Lines of /proc/self/cgroup are number:controllers:path, "0::path" for version 2.
double free_in_control_groups() {
  double least = nothing_said;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (line.starts_with("0::")) least = std::min(least, free_in_group(version_2, line.substr(3)));
    if (const std::size_t at = line.find(":memory:"); at != std::string::npos)
      least = std::min(least, free_in_group(version_1, line.substr(at + 8)));
  }
  return least;
}

double image_bytes(const SolvePlan& plan, const Case& c) {
  double most = 0.0;
  for (const std::size_t look : c.image_looks) {
    const ImageLattice cells = image_cells(plan, look, c.image_per_wavelength);
    most = std::max(most, bytes_per_cell * static_cast<double>(cells.columns) * cells.rows);
  }
  return most;
}

// All that the run holds.
std::vector<MemoryPart> parts_of(const SolvePlan& plan, const Case& c) {
  const auto values = static_cast<double>(c.looks.theta_deg.size() + c.looks.phi_deg.size() + c.looks.rx_theta_deg.size() +
                                          c.looks.rx_phi_deg.size() + c.sweep.frequencies.size());
  std::vector<MemoryPart> parts = estimate_memory(plan);
  if (c.netcdf)
    parts.push_back({"netCDF file", MemoryOf::rows,
                     stored_bytes_per_row(plan.tell_parts ? plan.columns() : 0) * static_cast<double>(c.sweep.rows())});
  parts.push_back({"image", MemoryOf::image, image_bytes(plan, c)});
  parts.push_back({"threads", MemoryOf::looks, plan.threads * bytes_per_thread});
  parts.push_back({"program and target", MemoryOf::program, held_now().resident});
  parts.push_back({"journal", MemoryOf::program, journal_bytes});
  if (c.motion && plan.sweep.looks.size() < c.sweep.looks.size())  // times of a case that moves, side by side
    parts.push_back({"targets of other times", MemoryOf::looks,
                     (std::min<double>(plan.threads, static_cast<double>(c.times())) - 1.0) * bytes_per_triangle *
                         static_cast<double>(plan.target.mesh.triangles.size())});
  parts.push_back({"lists of the case", MemoryOf::program, values * bytes_per_angle});
  return parts;
}

// What would fit: by that which takes most, threads before rows.
std::string remedy(const std::vector<MemoryPart>& parts, const Case& c, const SolvePlan& plan, double available) {
  const double rows = bytes_of(parts, MemoryOf::rows), image = bytes_of(parts, MemoryOf::image),
               looks = bytes_of(parts, MemoryOf::looks), program = bytes_of(parts, MemoryOf::program);
  const bool most_for_looks = looks > std::max(rows, image);
  if (most_for_looks && plan.threads > 1) {
    const double fit = std::floor(plan.threads * (available - rows - image - program) / looks);
    if (fit >= 1.0) return fmt::format("--threads {} would fit", fit);
  }
  if (image > rows) {
    const double share = std::max(0.0, available - rows - looks - program) / image;
    return share > 0.0 ? fmt::format("output.image_per_wavelength = {} would fit",
                                     rounded_down_text(c.image_per_wavelength * std::sqrt(share)))
                       : "leave out output.image_look";
  }
  if (most_for_looks) {
    const auto count = static_cast<double>(c.sweep.frequencies.size());
    const double fit = std::floor(count * (available - image - program) / (rows + looks));
    return fit >= 1.0 ? fmt::format("split the sweep: {:.0f} of its {:.0f} frequencies would fit", fit, count)
                      : "split the sweep";
  }
  const double fit = std::floor(std::max(0.0, available - image - looks - program) / rows * static_cast<double>(c.sweep.rows()));
  const std::string split =
      fit < 1.0 ? "split the sweep"
                : fmt::format("split the sweep: {:.0f} of its {} rows (looks times frequencies) would fit", fit, c.sweep.rows());
  return split + (plan.tell_parts ? ", more without --parts" : "");
}

}  // namespace

std::string memory_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.3g} MB", bytes / 1e6) : fmt::format("{:.3g} GB", bytes / 1e9);
}

MemoryOfRun memory_of_run(const SolvePlan& plan, const Case& c) {
  const std::vector<MemoryPart> parts = parts_of(plan, c);
  const double helping = bytes_of(parts, MemoryOf::looks) + bytes_of(parts, MemoryOf::program);
  return {helping + bytes_of(parts, MemoryOf::rows) + bytes_of(parts, MemoryOf::image), helping};
}

double memory_to_be_had() {
  const Held now = held_now();
  const double available = number_after("/proc/meminfo", "MemAvailable:") * 1024.0;
  double free = std::min(free_in_control_groups(), available > 0.0 ? available : std::numeric_limits<double>::infinity());
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    free = std::min(free, std::max(0.0, static_cast<double>(limit.rlim_cur) - now.virtual_size));
  return now.resident + free;
}

void require_memory(double bytes, const std::string& place, const std::string& what, const std::string& remedy) {
  if (const double available = memory_to_be_had(); bytes > available)
    throw InputError(fmt::format("{}: {} would take about {} of memory, and there are {}; {}", place, what, memory_text(bytes),
                                 memory_text(available), remedy));
}

void check_memory(const SolvePlan& plan, const Case& c, double kept) {
  std::vector<MemoryPart> parts = parts_of(plan, c);
  parts.push_back({"earlier results", MemoryOf::rows, kept});
  double bytes = 0.0;
  for (const MemoryPart& part : parts) bytes += part.bytes;
  require_memory(bytes, c.file.string(), "the run", remedy(parts, c, plan, memory_to_be_had()));
}

}  // namespace raytube
