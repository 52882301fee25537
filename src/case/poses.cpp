#include "case/poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "case/text/values.h"
#include "core/csv_reader.h"
#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

constexpr double unit_rounding = 1e-3;  // of a quaternion's length, as tables round it
constexpr double least_along = 0.2588;  // of neighbours: the cosine of half of 150 degrees

const std::vector<std::string> pose_columns = {"time_s", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};

// Appends a line of a table: seconds, metres and, where it turns, the four parts of a unit quaternion. Throws InputError, which
// begins with `where`.
void append_pose(const std::vector<double>& line, const std::string& where, std::vector<PoseSample>& poses) {
  PoseSample sample{line[0], {line[1], line[2], line[3]}};
  if (!poses.empty() && sample.time <= poses.back().time)
    throw InputError(where + ": times must ascend; sort the poses and drop repeated ones");
  if (line.size() == pose_columns.size()) {
    double length = 0.0, along = 0.0;
    for (std::size_t i = 0; i < 4; ++i) length = std::hypot(length, line[4 + i]);
    if (std::abs(length - 1.0) > unit_rounding)
      throw InputError(
          fmt::format("{}: qw, qx, qy, qz must make a unit quaternion (its length is {:.6g}); divide them by it", where, length));
    for (std::size_t i = 0; i < 4; ++i) {
      sample.turn[i] = line[4 + i] / length;
      along += sample.turn[i] * (poses.empty() ? 0.0 : poses.back().turn[i]);
    }
    if (!poses.empty() && std::abs(along) < least_along)
      throw InputError(
          where +
          ": is turned by more than 150 degrees against the pose before, so that the way there is not told; add one between");
    if (along < 0.0)  // of the two quaternions that stand for one turn, the one nearer to the pose before
      for (double& part : sample.turn) part = -part;
  }
  poses.push_back(sample);
}

}  // namespace

std::vector<PoseSample> read_poses_csv(const std::filesystem::path& file, const std::string& key, bool may_turn) {
  const std::size_t most_columns = may_turn ? pose_columns.size() : 4;
  const std::string header = joined(std::span(pose_columns).first(most_columns), ",");
  CsvReader reader(file, key + " must name a readable CSV file with the header " + header);
  const std::size_t columns = reader.columns().size();
  if ((columns != 4 && columns != most_columns) ||
      !std::equal(reader.columns().begin(), reader.columns().end(), pose_columns.begin()))
    throw InputError(fmt::format("{}: the header must be \"{}\"{}", file.string(), header,
                                 may_turn ? ", or the first four of these where nothing turns" : ""));
  std::vector<PoseSample> poses;
  while (reader.next()) {
    std::vector<double> line;
    for (std::size_t i = 0; i < columns; ++i)
      line.push_back(reader.finite_number(i, "write seconds, metres and the parts of a unit quaternion"));
    append_pose(line, reader.location(), poses);
  }
  if (poses.size() < 2) throw InputError(file.string() + ": a table of poses needs at least two rows");
  return poses;
}

std::vector<PoseSample> read_pose_list(const CaseValue& value, const std::string& key) {
  std::vector<PoseSample> poses;
  const std::string form =
      fmt::format("{} must be a list of at least two poses [{}], or the first four of these", key, joined(pose_columns, ", "));
  if (value.kind != CaseValue::Kind::list || value.items.size() < 2) reject(value, form);
  for (const CaseValue& item : value.items) {
    if (item.kind != CaseValue::Kind::list || (item.items.size() != 4 && item.items.size() != pose_columns.size()) ||
        item.items.size() != value.items.front().items.size())
      reject(item, form);
    std::vector<double> line;
    for (const CaseValue& number : item.items) line.push_back(read_number(number, key));
    append_pose(line, item.location, poses);
  }
  return poses;
}

}  // namespace raytube
