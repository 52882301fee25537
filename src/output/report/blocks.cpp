#include "output/report/blocks.h"

#include <limits>

#include "output/report/packed.h"
#include "output/tables/csv.h"

namespace raytube {

JsonValue block_axis(double first, double step, const Blocks& blocks) {
  const double size = static_cast<double>(blocks.size) * step, middle = first + 0.5 * (size - step);
  return {{"first", middle}, {"last", middle + size * static_cast<double>(blocks.count() - 1)}, {"count", blocks.count()}};
}

BlockLevels::BlockLevels(const Blocks& slow, const Blocks& fast) : slow_(slow), fast_(fast) {
  for (std::vector<double>& levels : levels_)
    levels.assign(slow.count() * fast.count(), -std::numeric_limits<double>::infinity());
}

void BlockLevels::add(std::size_t slow, std::size_t fast, const std::array<double, 4>& sigma_dbsm) {
  const std::size_t at = slow_.of(slow) * fast_.count() + fast_.of(fast);
  for (std::size_t channel = 0; channel < 4; ++channel)
    levels_[channel][at] = std::max(levels_[channel][at], sigma_dbsm[channel]);
}

void BlockLevels::add(std::size_t slow, std::size_t fast, const ScatteringMatrix& s) {
  add(slow, fast, std::array{sigma_dbsm(s.vv()), sigma_dbsm(s.vh()), sigma_dbsm(s.hv()), sigma_dbsm(s.hh())});
}

JsonValue BlockLevels::json() const {
  JsonValue channels;
  for (const std::vector<double>& levels : levels_) channels.append(packed_levels(levels));
  return channels;
}

}  // namespace raytube
