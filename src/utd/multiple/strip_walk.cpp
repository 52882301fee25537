#include "utd/multiple/strip_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

constexpr double hair =
    10 * along_edge;  // [rad]; above the limit for "exactly", and small enough for its own square not to count
constexpr double infinity = std::numeric_limits<double>::infinity();
// Where a wave of the tree runs along an edge, with a sine below `alongside`, strips shorter than up to this electrical length
// are a tip that passes no soft current on.
constexpr double longest_tip = 1.0 / 30, alongside = 0.1;
constexpr double same_length = 1e-13;  // relative; strips between parallel edges share their kernels

void add_product(FringeKernels& sum, const FringeKernels& kernels, Complex factor) {
  sum.soft += factor * kernels.soft;
  sum.hard += factor * kernels.hard;
  sum.axial += factor * kernels.axial;
}

std::vector<double> wavenumbers_of(std::span<const double> frequencies) {
  std::vector<double> result;
  for (const double frequency : frequencies) result.push_back(wavenumber(frequency));
  return result;
}

template <class Factor>
ScatteringMatrix scaled(ScatteringMatrix matrix, Factor factor) {
  for (auto& row : matrix.s)
    for (Complex& value : row) value *= factor;
  return matrix;
}

bool alike(const TreeWave& wave, const StripBundle& bundle) {
  const double growth = std::max({std::abs(bundle.growth), std::abs(wave.behind.growth), std::abs(wave.detour.growth)});
  return !bundle.edge || growth * (bundle.to - bundle.from) < same_length * bundle.length_at(bundle.from);
}

void multiply(ComplexColumn& column, std::size_t i, Complex factor) { column.set(i, factor * column[i]); }

}  // namespace

StripWalk::StripWalk(std::span<const Wedge> wedges, const Outlines& outlines, const LookVectors& look,
                     std::span<const double> frequencies, int order, TransitionTier tier, bool continue_by_images)
    : wedges_(wedges),
      look_(look),
      band_(wavenumbers_of(frequencies)),
      order_(order),
      tier_(tier),
      tree_(wedges, outlines, look.incident, look.scattered, continue_by_images),
      placer_(wavelength(*std::ranges::max_element(frequencies))) {
  sums_.first.resize(frequencies.size());
  sums_.higher.resize(frequencies.size());
  sums_.windowed.resize(frequencies.size());
}

void StripWalk::add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
  for (int face = 0; face < 2; ++face) {
    const FaceIncidence& arriving = incidence.faces[face];
    if (arriving.sin_cone <= sin_cone_floor) continue;  // along the edge: strips of no width
    start(first_wave(wedges_, index, face, arriving, look_.incident, order_), lit);
  }
}

void StripWalk::start(const StripWave& wave, std::span<const LitInterval> lit) {
  grow(wave, lit);
  const bool runs_along_edge = tree_.runs_along_edge();
  add_tree({true, runs_along_edge ? 0.0 : 1.0});
  if (runs_along_edge) start_beside(wave, lit);
}

// A wave that runs exactly along an edge at the side of a face meets it over its whole length, and yet its strips never end
// there. Turned by a hair to either side they do; the limit of a vanishing turn is finite, and half of each counts.
void StripWalk::start_beside(const StripWave& wave, std::span<const LitInterval> lit) {
  const dvec3 aside = glm::cross(wedges_[wave.wedge].faces[wave.face].normal, wave.direction);
  for (const double turn : {-hair, hair}) {
    StripWave turned = wave;
    turned.direction = glm::normalize(wave.direction + turn * aside);
    grow(turned, lit);
    add_tree({false, 0.5});
  }
}

// Of many frequencies a few are computed and the others interpolated, but not where the kernels are rough or change with k in
// ways of their own.
void StripWalk::add_tree(const Part& part) {
  if (tree_.bundles().empty()) return;
  note_windows();
  find_paths();
  const auto is_thin = [](const Face& face) { return face.thin.has_value(); };
  const bool smooth = tier_ == TransitionTier::exact && std::ranges::none_of(faces_, is_thin);
  const double half_span = std::ranges::max_element(paths_, {}, &PathRange::half)->half();
  if (const ChebyshevNodes* nodes = smooth ? band_.nodes_of_fresnel(half_span) : nullptr)
    interpolate(*nodes, part);
  else
    radiate_at(band_.wavenumbers(), part, [&](std::size_t wave, std::size_t f) -> ScatteringMatrix& {
      return wave == 0 ? sums_.first[f] : sums_.higher[f];
    });
}

void StripWalk::interpolate(const ChebyshevNodes& nodes, const Part& part) {
  const std::size_t waves = part.higher > 0.0 ? tree_.waves().size() : 1;
  samples_.resize(std::max(samples_.size(), waves));
  for (std::size_t w = 0; w < waves; ++w) samples_[w].assign(nodes.at.size(), {});
  radiate_at(nodes.at, part, [&](std::size_t wave, std::size_t n) -> ScatteringMatrix& { return samples_[wave][n]; });
  for (std::size_t w = 0; w < waves; ++w)
    for (std::size_t n = 0; n < nodes.at.size(); ++n)
      samples_[w][n] = scaled(samples_[w][n], std::polar(1.0, -nodes.at[n] * paths_[w].middle()));
  for (std::size_t w = part.first ? 0 : 1; w < waves; ++w) add_samples(nodes, w, w == 0 ? sums_.first : sums_.higher);
}

void StripWalk::add_samples(const ChebyshevNodes& nodes, std::size_t wave, std::vector<ScatteringMatrix>& sums) const {
  auto weight = nodes.weights.begin();
  for (std::size_t f = 0; f < sums.size(); ++f) {
    ScatteringMatrix value;
    for (const ScatteringMatrix& sample : samples_[wave]) value += scaled(sample, *weight++);
    sums[f] += scaled(value, std::polar(1.0, band_.wavenumbers()[f] * paths_[wave].middle()));
  }
}

// sum_of(wave, i): where S of a wave at wavenumbers[i] goes.
template <class SumOf>
void StripWalk::radiate_at(std::span<const double> wavenumbers, const Part& part, SumOf sum_of) {
  const std::size_t waves = part.higher > 0.0 ? tree_.waves().size() : 1;
  kernels_.resize(std::max(kernels_.size(), waves));
  for (std::size_t begin = 0; begin < wavenumbers.size(); begin += block) {
    const std::span<const double> here = wavenumbers.subspan(begin, std::min(block, wavenumbers.size() - begin));
    for (std::size_t w = 0; w < waves; ++w) find_kernels(w, here);
    for (std::size_t place = 0; place < here.size(); ++place) {
      find_phases(here[place]);
      if (part.first) radiate_direct(0, place, 1.0, sum_of(0, begin + place));
      if (waves > 1) excite_far_edges(0, place, part.higher);
      for (std::size_t w = 1; w < waves; ++w) radiate_higher(w, place, part.higher, sum_of(w, begin + place));
    }
  }
}

void StripWalk::radiate_higher(std::size_t wave, std::size_t place, double share, ScatteringMatrix& sum) {
  const bool goes_on = tree_.waves()[wave].wave.goes_on();
  if (tree_.waves()[wave].direct) {
    radiate_direct(wave, place, share, sum);
    if (goes_on) excite_far_edges(wave, place, share);
  } else {
    radiate(wave, place, sum);
    if (goes_on) pass_on(wave, place);
  }
}

// Along a strip the phase changes by its length times (s . sigma - 1), and where it ends the next ones start.
void StripWalk::find_paths() {
  const EdgeLine& line = tree_.waves()[0].line;
  paths_.clear();
  from_ends_.resize(tree_.bundles().size());
  to_ends_.resize(tree_.bundles().size());
  for (const TreeWave& wave : tree_.waves()) {
    const auto start = [&](double place) {
      if (wave.parent == no_index) return glm::dot(look_.scattered - look_.incident, line.at(place));
      const StripBundle& before = tree_.bundles()[wave.parent];
      const double share = before.to > before.from ? (place - before.from) / (before.to - before.from) : 0.0;
      return from_ends_[wave.parent] + share * (to_ends_[wave.parent] - from_ends_[wave.parent]);
    };
    PathRange& range = paths_.emplace_back(PathRange{infinity, -infinity});
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
      const StripBundle& bundle = tree_.bundles()[b];
      const double change = bundle.edge ? glm::dot(look_.scattered, wave.wave.direction) - 1.0 : 0.0;
      from_ends_[b] = start(bundle.from) + change * bundle.length_at(bundle.from);
      to_ends_[b] = start(bundle.to) + change * bundle.length_at(bundle.to);
      range.include({start(bundle.from), start(bundle.to), from_ends_[b], to_ends_[b]});
    }
  }
}

// The tree, its points, and of its waves and bundles what all frequencies share.
void StripWalk::grow(const StripWave& wave, std::span<const LitInterval> lit) {
  tree_.grow(wave, lit);
  tip_ = tip();
  placer_.place(tree_, lit, wedges_[wave.wedge].length());
  faces_.clear();
  for (const TreeWave& each : tree_.waves()) {
    const Wedge& wedge = wedges_[each.wave.source];
    const double half_cosine = grazing_half_cosine(each.wave.across, each.wave.incidence, look_.scattered);
    faces_.push_back({Strip(wedge.n, each.wave.incidence, half_cosine, tier_), std::nullopt, projection(each.wave)});
    if (wedge.thickness() > 0.0)
      faces_.back().thin.emplace(wedge, each.wave.source_face, each.wave.incidence, half_cosine, look_.scattered, each.direct);
  }
  lay_out_rows();
}

// Amplitudes of the first strips are direct_; of those that follow they are what arrived with the bundle before. Mirrored ones
// have those of the strips they continue.
void StripWalk::lay_out_rows() {
  rows_.clear();
  std::size_t count = 0;
  for (const TreeWave& wave : tree_.waves())
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
      const PanelPlacer::Row& points = placer_.rows()[b];
      std::size_t amplitude = points.first;
      if (wave.parent != no_index) {
        const Row& before = rows_[wave.parent];
        amplitude += (wave.wave.mirrors > 0 ? before.amplitude : before.arriving) - placer_.rows()[wave.parent].first;
      }
      rows_.push_back({amplitude, count, 0, points.size(), alike(wave, tree_.bundles()[b])});
      count += points.size();
    }
  for (ComplexColumn& column : arriving_) column.make_room(count);
}

std::span<const StripWalk::Row> StripWalk::rows(const TreeWave& wave) const {
  return std::span(rows_).subspan(wave.first_bundle, wave.end_bundle - wave.first_bundle);
}

void StripWalk::find_phases(double wavenumber) {
  const EdgeLine& line = tree_.waves()[0].line;
  const dvec3 difference = wavenumber * (look_.scattered - look_.incident);
  const double start = glm::dot(difference, line.origin), step = glm::dot(difference, line.step);
  const std::span<const PanelPoint> points = placer_.points();
  direct_.make_room(points.size());
  for (std::size_t first = 0; first < points.size(); first += lanes) {
    Reals angle{};
    const std::size_t width = std::min(lanes, points.size() - first);
    for (std::size_t i = 0; i < width; ++i) angle[i] = start + step * points[first + i].place;
    const Complexes phasors = unit_phasors(angle);
    for (std::size_t i = 0; i < width; ++i) direct_.set(first + i, points[first + i].weight * phasors[i]);
  }
}

void StripWalk::find_lengths(std::size_t wave, std::span<const double> wavenumbers) {
  const TreeWave& here = tree_.waves()[wave];
  for (std::vector<double>* each : {&lengths_, &behind_, &detours_}) each->clear();
  for (const double k : wavenumbers) {
    const std::size_t first = lengths_.size();
    const double scale = k * here.wave.incidence.sin_cone * here.wave.incidence.sin_cone;
    for (std::uint32_t b = here.first_bundle; b < here.end_bundle; ++b) {
      const StripBundle& bundle = tree_.bundles()[b];
      Row& row = rows_[b];
      row.kernel = lengths_.size() - first;
      const std::size_t count = row.alike ? std::min<std::size_t>(row.size, 1) : row.size;
      for (const PanelPoint& point : placer_.points().subspan(placer_.rows()[b].first, count)) {
        behind_.push_back(scale * here.behind.at(point.place));
        detours_.push_back(k * here.detour.at(point.place));
        lengths_.push_back(bundle.edge ? behind_.back() + scale * std::max(bundle.length_at(point.place), 0.0) : infinity);
      }
    }
  }
  kernels_[wave].stride = lengths_.size() / wavenumbers.size();
}

// The thickness of a sheet changes what is left of an endless strip once its pole is bounded.
void StripWalk::find_kernels(std::size_t wave, std::span<const double> wavenumbers) {
  find_lengths(wave, wavenumbers);
  KernelBatch& batch = kernels_[wave].batch;
  faces_[wave].strip.at(lengths_, batch);
  if (wave == 0) bound_untruncated(wavenumbers);
  if (faces_[wave].thin) count_thickness(wave, wavenumbers, lengths_, batch);
  if (tree_.waves()[wave].direct && tip_ > 0.0) fade_soft_ends(batch);
  if (tree_.waves()[wave].wave.mirrors > 0) keep_mirrored_part(wave, wavenumbers);
}

// The soft current is singular at its edge: a strip next to a corner, hardly longer than nothing, hands on the more the shorter
// it is. What starts there lies the closer to the next edge the smaller its sine delta, and S grew as 1 / root(delta). A tip
// grows from none at delta = `alongside`, so that nothing jumps.
double StripWalk::tip() const {
  double sine = alongside;
  for (const TreeWave& wave : tree_.waves().subspan(1)) sine = std::min(sine, wave.wave.incidence.sin_cone);
  return longest_tip * (1 - sine / alongside) * (1 - sine / alongside);
}

void StripWalk::fade_soft_ends(KernelBatch& batch) {
  for (std::size_t first = 0; first < lengths_.size(); first += lanes) {
    Reals length{};
    const std::size_t width = std::min(lanes, lengths_.size() - first);
    for (std::size_t i = 0; i < width; ++i) length[i] = lengths_[first + i] / tip_;
    const Reals share = one_minus_exp(length);
    for (std::size_t i = 0; i < width; ++i) multiply(batch.soft_end, first + i, share[i]);
  }
}

// Seen from the image of the source, the current from the fold on. One that runs for ever, over a smooth crease, is left out: the
// fold's own surface does not go on for ever.
void StripWalk::keep_mirrored_part(std::size_t wave, std::span<const double> wavenumbers) {
  KernelBatch& batch = kernels_[wave].batch;
  faces_[wave].strip.at(behind_, shorter_);
  if (faces_[wave].thin) count_thickness(wave, wavenumbers, behind_, shorter_);
  batch.subtract_currents(shorter_, lengths_.size());
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    const Complex turn = std::isinf(lengths_[i]) ? 0.0 : std::polar(1.0, detours_[i]);
    for (ComplexColumn* column : {&batch.soft, &batch.hard, &batch.axial, &batch.end, &batch.soft_end})
      multiply(*column, i, turn);
  }
}

void StripWalk::count_thickness(std::size_t wave, std::span<const double> wavenumbers, std::span<const double> lengths,
                                KernelBatch& batch) {
  const FringeKernels untruncated = faces_[wave].strip.untruncated().current;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    StripKernels kernels = batch[i];
    faces_[wave].thin->correct(kernels, untruncated, wavenumbers[i / kernels_[wave].stride], lengths[i]);
    batch.set(i, kernels);
  }
}

bool StripWalk::is_semi_infinite(const TreeWave& wave) const {
  for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b)
    if (!tree_.bundles()[b].edge && rows_[b].size > 0) return true;
  return false;
}

SplitKernels StripWalk::split_untruncated() const {
  const StripWave& wave = tree_.waves()[0].wave;
  const Wedge& wedge = wedges_[wave.wedge];
  return split_kernels(wedge.n, wave.incidence, grazing_half_cosine(wedge.faces[wave.face], wave.incidence, look_.scattered));
}

void StripWalk::bound_untruncated(std::span<const double> wavenumbers) {
  if (!is_semi_infinite(tree_.waves()[0])) return;
  const SplitKernels untruncated = split_untruncated();
  if (!untruncated.active) return;
  const StripWave& wave = tree_.waves()[0].wave;
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    if (!std::isinf(lengths_[i])) continue;
    const double k = wavenumbers[i / kernels_[0].stride];
    FringeKernels current = untruncated.regular;
    add_product(current, untruncated.pole, windowed_pole(untruncated.angle, k, wedges_[wave.wedge].faces[wave.face].width).value);
    kernels_[0].batch.set(i, {current, 0.0, 0.0});
  }
}

void StripWalk::note_windows() {
  if (!is_semi_infinite(tree_.waves()[0])) return;
  const SplitKernels untruncated = split_untruncated();
  if (!untruncated.active) return;
  const StripWave& wave = tree_.waves()[0].wave;
  for (std::size_t f = 0; f < sums_.windowed.size(); ++f)
    if (windowed_pole(untruncated.angle, band_.wavenumbers()[f], wedges_[wave.wedge].faces[wave.face].width).touched)
      sums_.windowed[f] = true;
}

StripWalk::Projection StripWalk::projection(const StripWave& wave) const {
  Projection result;
  for (int receive = 0; receive < 2; ++receive) {
    const double across = glm::dot(look_.receive[receive], wave.across);
    const double along = glm::dot(look_.receive[receive], wave.incidence.tangent) / wave.incidence.sin_cone;
    result.across[receive] = wave.sign * across / (2 * pi * wave.incidence.sin_cone);
    result.along[receive] = wave.sign * along / (2 * pi * wave.incidence.sin_cone);
  }
  return result;
}

Complex StripWalk::radiated_direct(std::size_t wave, const ComplexColumn& kernels, std::size_t place) const {
  Complex total = 0.0;
  const std::size_t shift = place * kernels_[wave].stride;
  for (const Row& row : rows(tree_.waves()[wave])) {
    if (row.size == 0) continue;
    const ColumnPlace weights(direct_, row.amplitude);
    const std::size_t kernel = shift + row.kernel;
    total += row.alike ? sum(weights, row.size) * kernels[kernel] : sum_of_products(weights, {kernels, kernel}, row.size);
  }
  return total;
}

// Per transmit polarisation, the hard current's share across the strips and along them.
PairSums StripWalk::radiated(std::size_t wave, std::size_t place) const {
  PairSums total{};
  const auto& [batch, stride] = kernels_[wave];
  for (const Row& row : rows(tree_.waves()[wave])) {
    if (row.size == 0) continue;
    const std::size_t kernel = place * stride + row.kernel;
    const std::array<ColumnPlace, 2> weights{ColumnPlace(arriving_[0], row.amplitude), ColumnPlace(arriving_[1], row.amplitude)};
    const std::array<ColumnPlace, 2> kernels{ColumnPlace(batch.hard, kernel), ColumnPlace(batch.axial, kernel)};
    if (!row.alike) {
      const PairSums sums = sums_of_products(weights, kernels, row.size);
      for (int transmit = 0; transmit < 2; ++transmit)
        for (int part = 0; part < 2; ++part) total[transmit][part] += sums[transmit][part];
      continue;
    }
    for (int transmit = 0; transmit < 2; ++transmit) {
      const Complex weight = sum(weights[transmit], row.size);
      total[transmit][0] += weight * batch.hard[kernel];
      total[transmit][1] += weight * batch.axial[kernel];
    }
  }
  return total;
}

void StripWalk::radiate_direct(std::size_t wave, std::size_t place, double share, ScatteringMatrix& sum) const {
  const FaceIncidence& incidence = tree_.waves()[0].wave.incidence;
  const Projection& seen = faces_[wave].seen;
  const KernelBatch& batch = kernels_[wave].batch;
  const Complex hard = radiated_direct(wave, batch.hard, place), soft = radiated_direct(wave, batch.soft, place),
                axial = incidence.cos_cone * radiated_direct(wave, batch.axial, place);
  for (int transmit = 0; transmit < 2; ++transmit) {
    const double magnetic = share * glm::dot(look_.magnetic[transmit], incidence.tangent);
    const double electric = share * glm::dot(look_.electric[transmit], incidence.tangent);
    for (int receive = 0; receive < 2; ++receive)
      sum.at(receive, transmit) +=
          (seen.across[receive] * hard + seen.along[receive] * axial) * magnetic + seen.along[receive] * soft * electric;
  }
}

void StripWalk::radiate(std::size_t wave, std::size_t place, ScatteringMatrix& sum) const {
  const TreeWave& here = tree_.waves()[wave];
  const Projection& seen = faces_[wave].seen;
  const PairSums sums = radiated(wave, place);
  for (int transmit = 0; transmit < 2; ++transmit) {
    const Complex hard = sums[transmit][0], axial = here.wave.incidence.cos_cone * sums[transmit][1];
    for (int receive = 0; receive < 2; ++receive)
      sum.at(receive, transmit) += seen.across[receive] * hard + seen.along[receive] * axial;
  }
}

// The hard current arrives with the strips. The soft one flows along the edge; what arrives of it is its component along the
// strips, of the part of the wave whose E lies in the face. The rest is in the plane of incidence: where it grazes, its current
// is that which the hard waves from the other edges take away again, so that passing it on would count it twice.
void StripWalk::excite_far_edges(std::size_t wave, std::size_t place, double share) {
  const auto& [batch, stride] = kernels_[wave];
  const StripWave& first = tree_.waves()[0].wave;
  const FaceIncidence& incidence = first.incidence;
  const dvec3 across = glm::cross(wedges_[first.wedge].faces[first.face].normal, look_.incident);
  const double squared = glm::dot(across, across);
  const double lying = squared > 0.0 ? glm::dot(across, incidence.tangent) * incidence.cos_cone / squared : 0.0;
  for (int transmit = 0; transmit < 2; ++transmit) {
    const double hard = share * glm::dot(look_.magnetic[transmit], incidence.tangent);
    const double soft = share * glm::dot(look_.electric[transmit], across) * lying;
    for (const Row& row : rows(tree_.waves()[wave]))
      for (std::size_t i = 0; i < row.size; ++i) {
        const std::size_t kernel = place * stride + row.kernel + (row.alike ? 0 : i);
        const Complex current = hard * batch.end[kernel] + soft * batch.soft_end[kernel];
        arriving_[transmit].set(row.arriving + i, direct_[row.amplitude + i] * current);
      }
  }
}

// In the product of field and length of edge the sine between strip and edge cancels: H dz = -(current) dz_before / 2.
void StripWalk::pass_on(std::size_t wave, std::size_t place) {
  const auto& [batch, stride] = kernels_[wave];
  for (const Row& row : rows(tree_.waves()[wave])) {
    if (row.size == 0) continue;
    const std::size_t kernel = place * stride + row.kernel;
    for (ComplexColumn& column : arriving_) {
      const ColumnPlace amplitudes(column, row.amplitude);
      if (row.alike)
        scale(amplitudes, batch.end[kernel], row.size, column, row.arriving);
      else
        multiply(amplitudes, {batch.end, kernel}, row.size, column, row.arriving);
    }
  }
}

}  // namespace raytube
