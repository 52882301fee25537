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

const KernelBatch& part_of(const WaveKernelBatch& kernels, StripPart part) {
  if (part == StripPart::whole) return kernels.whole;
  return part == StripPart::start ? kernels.start : kernels.end;
}

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
    ComplexColumn& arriving = amplitudes.arriving[transmit];
    for (const StripRow& row : here.rows) {
      if (row.size == 0) continue;
      const std::size_t kernel = here.first + row.kernel;
      const ColumnView direct(amplitudes.direct, row.amplitude);
      if (row.alike)
        scale(direct, hard * here.batch.end[kernel] + soft * here.batch.soft_end[kernel], row.size, arriving, row.arriving);
      else
        multiply_by_sum(direct, {hard, {here.batch.end, kernel}}, {soft, {here.batch.soft_end, kernel}}, row.size, arriving,
                        row.arriving);
    }
  }
}

// The sine between strip and edge cancels in the product of field and length of edge: H dz = -(current) dz_before / 2.
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

StripStart start_of(const IncidentFields& incident, Complex phase, double path) {
  StripStart result{{}, {}, {}, path};
  for (int t = 0; t < 2; ++t) {
    result.magnetic[t] = incident.magnetic[t] * phase;
    result.electric[t] = incident.electric[t] * phase;
    result.lying[t] = incident.lying[t] * phase;
  }
  return result;
}

// Where the first strips start of which this one comes.
dvec3 first_point(const StripLayout& strips, std::size_t wave, const ArrivedPath& path) {
  const EdgeLine &first = strips.tree.waves()[0].line, &here = strips.tree.waves()[wave].line;
  return first.at(glm::dot(path.path.start - here.origin, here.step) / glm::dot(here.step, here.step));
}

// By their paths, as if those changed evenly along the strip, and all that starts at its end stood there.
void add_pieces(const dvec3& first, const ArrivedPath& arrived, const StripStart& start, StripBins& bins) {
  const StripPath& path = arrived.path;
  PathBins paths(bins.nodes(), one_piece(bins.nodes().front()));
  radiate(path, 0, start, paths, paths);
  for (std::size_t bin = 0; bin < paths.size(); ++bin) {
    const double way = path.end_path() != 0.0 ? (paths.middle(bin) - start.path) / path.end_path() : 0.0;
    const dvec3 last = glm::mix(path.start, path.end, std::clamp(way, 0.0, 1.0));
    const dvec3 place = bins.pieces->place.at(first, last, paths.middle(bin));
    bins.pieces->curved.push_back({place, place, paths.at(bin, 0)});
  }
}

}  // namespace

void StripRadiation::add(const StripLayout& strips, const CurvedWaves& curved, const LookVectors& look, const TreeShare& share,
                         StripBins& bins) {
  const std::size_t waves = share.higher > 0.0 ? strips.tree.waves().size() : 1;
  const auto is_curved = [&](std::size_t w) { return w < curved.size() && !curved[w].empty(); };
  groups_.find(strips, waves, bins);
  for (std::size_t begin = 0; begin < bins.nodes().size(); begin += block) {
    const std::span<const double> here = bins.nodes().subspan(begin, std::min(block, bins.nodes().size() - begin));
    for (std::size_t i = 0; i < here.size(); ++i) {
      for (ComplexColumn& column : amplitudes_[i].arriving) column.make_room(strips.arriving);
      find_phases(strips, look, here[i], amplitudes_[i].direct);
    }
    for (std::size_t w = 0; w < waves; ++w) {
      if (!is_curved(w) && !strips.faces[w].as_before) finder_.find(strips, w, here, groups_.splits(w), kernels_);
      for (std::size_t node = begin; node < begin + here.size(); ++node) {
        if (is_curved(w))
          add_curved(strips, w, curved[w], node, bins);
        else
          add_wave(strips, w, node, share, bins.of(w));
      }
    }
  }
}

void StripRadiation::add_curved(const StripLayout& strips, std::size_t wave, std::span<const ArrivedPath> paths, std::size_t node,
                                StripBins& bins) const {
  const TreeWave& here = strips.tree.waves()[wave];
  const StripAmplitudes& before = amplitudes_[node % block];
  auto each = paths.begin();
  for (const StripRow& row : strips.rows_of(here))
    for (std::size_t i = row.amplitude; i < row.amplitude + row.size; i += (each++)->points) {
      const StripStart start =
          here.direct ? start_of(strips.incident, sum({before.direct, i}, each->points), each->start_path)
                      : StripStart{{sum({before.arriving[0], i}, each->points), sum({before.arriving[1], i}, each->points)},
                                   {},
                                   {},
                                   each->start_path};
      if (bins.pieces)
        add_pieces(first_point(strips, wave, *each), *each, start, bins);
      else
        radiate(each->path, node, start, bins.of(wave), bins.higher);
    }
}

// The first wave and what corners mirror of it have their amplitudes from the incident wave, all others from the edge before.
void StripRadiation::add_wave(const StripLayout& strips, std::size_t wave, std::size_t node, const TreeShare& share,
                              PathBins& bins) {
  const TreeWave& here = strips.tree.waves()[wave];
  const WaveFace& face = strips.faces[wave];
  const std::size_t first = node % block * face.kernels;
  StripAmplitudes& amplitudes = amplitudes_[node % block];
  const double cos_cone = strips.tree.waves()[0].wave.incidence.cos_cone;
  const double counted = !here.direct ? 1.0 : wave > 0 ? share.higher : share.first ? 1.0 : 0.0;
  for (const StripGroup& group : groups_.of(wave)) {
    if (counted == 0.0) break;
    const WaveKernels kernels{here, face.projection, groups_.rows(group), part_of(kernels_, group.part), first};
    ScatteringMatrix& sum = bins.at(group.bin, node);
    if (here.direct)
      radiate_direct(kernels, cos_cone, strips.incident, counted, amplitudes.direct, sum);
    else
      radiate_arriving(kernels, amplitudes.arriving, sum);
  }
  const bool is_last = share.higher == 0.0 || wave + 1 == strips.tree.waves().size();
  if (!here.wave.goes_on() || is_last) return;
  const WaveKernels kernels{here, face.projection, strips.rows_of(here), kernels_.whole, first};
  if (here.direct)
    pass_on_direct(kernels, strips.incident, share.higher, amplitudes);
  else
    pass_on_arriving(kernels, amplitudes.arriving);
}

}  // namespace raytube
