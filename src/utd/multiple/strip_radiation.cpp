#include "utd/multiple/strip_radiation.h"

#include <algorithm>

namespace raytube {

namespace {

// One wave at one wavenumber: its kernels are those of the batch from `first` on.
struct WaveKernels {
  const TreeWave& wave;
  const FaceProjection& projection;
  std::span<const StripRow> rows;
  const KernelBatch& batch;
  std::size_t first;
};

void find_phases(const StripLayout& strips, const LookVectors& look, double wavenumber, ComplexColumn& direct) {
  const EdgeLine& line = strips.tree.waves()[0].line;
  const dvec3 difference = wavenumber * (look.scattered - look.incident);
  const double start = glm::dot(difference, line.origin), step = glm::dot(difference, line.step);
  const std::span<const PanelPoint> points = strips.panels.points();
  direct.make_room(points.size());
  for (std::size_t first = 0; first < points.size(); first += lanes) {
    Reals angle{};
    const std::size_t width = std::min(lanes, points.size() - first);
    for (std::size_t i = 0; i < width; ++i) angle[i] = start + step * points[first + i].arc_length;
    const Complexes phasors = unit_phasors(angle);
    for (std::size_t i = 0; i < width; ++i) direct.set(first + i, points[first + i].weight * phasors[i]);
  }
}

// Sum over the strips of a direct wave, for unit fields of the incident wave.
Complex direct_sum(const WaveKernels& here, const ComplexColumn& kernels, const ComplexColumn& direct) {
  Complex total = 0.0;
  for (const StripRow& row : here.rows) {
    if (row.size == 0) continue;
    const ColumnView weights(direct, row.amplitude);
    const std::size_t kernel = here.first + row.kernel;
    total += row.alike ? sum(weights, row.size) * kernels[kernel] : sum_of_products(weights, {kernels, kernel}, row.size);
  }
  return total;
}

// Sums over the strips of a wave that another edge has started: per transmit polarisation, the hard current's share across the
// strips and along them.
PairSums arriving_sums(const WaveKernels& here, const std::array<ComplexColumn, 2>& arriving) {
  PairSums total{};
  for (const StripRow& row : here.rows) {
    if (row.size == 0) continue;
    const std::size_t kernel = here.first + row.kernel;
    const std::array<ColumnView, 2> weights{ColumnView(arriving[0], row.amplitude), ColumnView(arriving[1], row.amplitude)};
    const std::array<ColumnView, 2> kernels{ColumnView(here.batch.hard, kernel), ColumnView(here.batch.axial, kernel)};
    if (!row.alike) {
      const PairSums sums = sums_of_products(weights, kernels, row.size);
      for (int transmit = 0; transmit < 2; ++transmit)
        for (int part = 0; part < 2; ++part) total[transmit][part] += sums[transmit][part];
      continue;
    }
    for (int transmit = 0; transmit < 2; ++transmit) {
      const Complex weight = sum(weights[transmit], row.size);
      total[transmit][0] += weight * here.batch.hard[kernel];
      total[transmit][1] += weight * here.batch.axial[kernel];
    }
  }
  return total;
}

void radiate_direct(const WaveKernels& here, double cos_cone, const IncidentFields& incident, double share,
                    const ComplexColumn& direct, ScatteringMatrix& sum) {
  const FaceProjection& seen = here.projection;
  const Complex hard = direct_sum(here, here.batch.hard, direct), soft = direct_sum(here, here.batch.soft, direct),
                axial = cos_cone * direct_sum(here, here.batch.axial, direct);
  for (int transmit = 0; transmit < 2; ++transmit) {
    const double magnetic = share * incident.magnetic[transmit], electric = share * incident.electric[transmit];
    for (int receive = 0; receive < 2; ++receive)
      sum.at(receive, transmit) +=
          (seen.across[receive] * hard + seen.along[receive] * axial) * magnetic + seen.along[receive] * soft * electric;
  }
}

void radiate_arriving(const WaveKernels& here, const std::array<ComplexColumn, 2>& arriving, ScatteringMatrix& sum) {
  const FaceProjection& seen = here.projection;
  const PairSums sums = arriving_sums(here, arriving);
  for (int transmit = 0; transmit < 2; ++transmit) {
    const Complex hard = sums[transmit][0], axial = here.wave.wave.incidence.cos_cone * sums[transmit][1];
    for (int receive = 0; receive < 2; ++receive)
      sum.at(receive, transmit) += seen.across[receive] * hard + seen.along[receive] * axial;
  }
}

// The hard current arrives with the strips, of the soft one its component along them (incident_fields).
void pass_on_direct(const WaveKernels& here, const IncidentFields& incident, double share, StripAmplitudes& amplitudes) {
  for (int transmit = 0; transmit < 2; ++transmit) {
    const double hard = share * incident.magnetic[transmit], soft = share * incident.lying[transmit];
    for (const StripRow& row : here.rows)
      for (std::size_t i = 0; i < row.size; ++i) {
        const std::size_t kernel = here.first + row.kernel + (row.alike ? 0 : i);
        const Complex current = hard * here.batch.end[kernel] + soft * here.batch.soft_end[kernel];
        amplitudes.arriving[transmit].set(row.arriving + i, amplitudes.direct[row.amplitude + i] * current);
      }
  }
}

// In the product of field and length of edge the sine between strip and edge cancels: H dz = -(current) dz_before / 2.
void pass_on_arriving(const WaveKernels& here, std::array<ComplexColumn, 2>& arriving) {
  for (const StripRow& row : here.rows) {
    if (row.size == 0) continue;
    const std::size_t kernel = here.first + row.kernel;
    for (ComplexColumn& column : arriving) {
      const ColumnView amplitudes(column, row.amplitude);
      if (row.alike)
        scale(amplitudes, here.batch.end[kernel], row.size, column, row.arriving);
      else
        multiply(amplitudes, {here.batch.end, kernel}, row.size, column, row.arriving);
    }
  }
}

}  // namespace

void StripRadiation::add(const StripLayout& strips, const CurvedWaves& curved, const LookVectors& look,
                         std::span<const double> wavenumbers, const TreeShare& share,
                         std::span<const std::span<ScatteringMatrix>> sums) {
  kernels_.resize(std::max(kernels_.size(), sums.size()));
  for (ComplexColumn& column : amplitudes_.arriving) column.make_room(strips.arriving);
  for (std::size_t begin = 0; begin < wavenumbers.size(); begin += block) {
    const std::span<const double> here = wavenumbers.subspan(begin, std::min(block, wavenumbers.size() - begin));
    const auto is_curved = [&](std::size_t w) { return w < curved.size() && !curved[w].empty(); };
    for (std::size_t w = 0; w < sums.size(); ++w)
      if (!is_curved(w)) finder_.find(strips, w, here, kernels_[w]);
    for (std::size_t i = 0; i < here.size(); ++i) {
      find_phases(strips, look, here[i], amplitudes_.direct);
      for (std::size_t w = 0; w < sums.size(); ++w) {
        if (is_curved(w))
          add_curved(curved[w], strips.rows_of(strips.tree.waves()[w]), here[i], sums[w][begin + i]);
        else
          add_wave(strips, w, i, share, sums[w][begin + i]);
      }
    }
  }
}

void StripRadiation::add_curved(std::span<const StripPath> paths, std::span<const StripRow> rows, double wavenumber,
                                ScatteringMatrix& sum) const {
  std::size_t point = 0;
  for (const StripRow& row : rows)
    for (std::size_t i = 0; i < row.size; ++i) {
      const std::array<Complex, 2> arriving{amplitudes_.arriving[0][row.amplitude + i],
                                            amplitudes_.arriving[1][row.amplitude + i]};
      radiate(paths[point++], wavenumber, {arriving, {}, {}}, sum, sum);
    }
}

// The first wave and what corners mirror of it have their amplitudes from the incident wave, all others from the edge before.
void StripRadiation::add_wave(const StripLayout& strips, std::size_t wave, std::size_t in_block, const TreeShare& share,
                              ScatteringMatrix& sum) {
  const TreeWave& here = strips.tree.waves()[wave];
  const WaveFace& face = strips.faces[wave];
  const WaveKernels kernels{here, face.projection, strips.rows_of(here), kernels_[wave], in_block * face.kernels};
  const bool is_last = share.higher == 0.0 || wave + 1 == strips.tree.waves().size();
  const bool goes_on = here.wave.goes_on() && !is_last;
  if (here.direct) {
    const double counted = wave > 0 ? share.higher : share.first ? 1.0 : 0.0;
    const double cos_cone = strips.tree.waves()[0].wave.incidence.cos_cone;
    if (counted > 0.0) radiate_direct(kernels, cos_cone, strips.incident, counted, amplitudes_.direct, sum);
    if (goes_on) pass_on_direct(kernels, strips.incident, share.higher, amplitudes_);
  } else {
    radiate_arriving(kernels, amplitudes_.arriving, sum);
    if (goes_on) pass_on_arriving(kernels, amplitudes_.arriving);
  }
}

}  // namespace raytube
