#include "utd/strips.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

constexpr double hair =
    10 * along_edge;  // [rad]; above the limit for "exactly", and small enough for its own square not to count
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double same_length = 1e-13;  // relative; strips between parallel edges share their kernels

void add_product(FringeKernels& sum, const FringeKernels& kernels, Complex factor) {
  sum.soft += factor * kernels.soft;
  sum.hard += factor * kernels.hard;
  sum.axial += factor * kernels.axial;
}

bool alike(const StripBundle& bundle) {
  return !bundle.edge || std::abs(bundle.growth) * (bundle.to - bundle.from) < same_length * bundle.length_at(bundle.from);
}

}  // namespace

StripWalk::StripWalk(std::span<const Wedge> wedges, const Outlines& outlines, const LookVectors& look,
                     std::span<const double> frequencies, int order, TransitionTier tier)
    : wedges_(wedges),
      look_(look),
      order_(order),
      tier_(tier),
      tree_(wedges, outlines, look.incident, look.scattered),
      placer_(wavelength(*std::ranges::max_element(frequencies))) {
  for (const double frequency : frequencies) wavenumbers_.push_back(wavenumber(frequency));
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
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
    find_phases(wavenumbers_[f]);
    find_kernels(0, f);
    radiate_direct(f);
    if (!runs_along_edge) go_on(f, 1.0);
  }
  if (runs_along_edge) go_on_beside(wave, lit);
}

// A wave that runs exactly along an edge at the side of a face meets it over its whole length, and yet its strips never end
// there. Turned by a hair to either side they do; the limit of a vanishing turn is finite, and half of each counts.
void StripWalk::go_on_beside(const StripWave& wave, std::span<const LitInterval> lit) {
  const dvec3 aside = glm::cross(wedges_[wave.wedge].faces[wave.face].normal, wave.direction);
  for (const double turn : {-hair, hair}) {
    StripWave turned = wave;
    turned.direction = glm::normalize(wave.direction + turn * aside);
    grow(turned, lit);
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      find_phases(wavenumbers_[f]);
      find_kernels(0, f);
      go_on(f, 0.5);
    }
  }
}

// The tree, its points, and of its waves and bundles what all frequencies share.
void StripWalk::grow(const StripWave& wave, std::span<const LitInterval> lit) {
  tree_.grow(wave, lit);
  placer_.place(tree_, lit, wedges_[wave.wedge].length());
  faces_.clear();
  for (const TreeWave& each : tree_.waves()) {
    const Wedge& wedge = wedges_[each.wave.wedge];
    const double half_cosine = glance_half_cosine(wedge.faces[each.wave.face], each.wave.incidence, look_.scattered);
    faces_.push_back({Strip(wedge.n, each.wave.incidence, half_cosine, tier_), std::nullopt, projection(each.wave)});
    if (wedge.thickness() > 0.0)
      faces_.back().thin.emplace(wedge, each.wave.face, each.wave.incidence, half_cosine, look_.scattered,
                                 each.parent == no_index);
  }
  lay_out_rows();
}

// Amplitudes of the first strips are direct_; of those that follow they are what arrived with the bundle before.
void StripWalk::lay_out_rows() {
  rows_.clear();
  std::size_t count = 0;
  for (const TreeWave& wave : tree_.waves())
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
      const PanelPlacer::Row& points = placer_.rows()[b];
      std::size_t amplitude = points.first;
      if (wave.parent != no_index) amplitude += rows_[wave.parent].arriving - placer_.rows()[wave.parent].first;
      rows_.push_back({amplitude, count, 0, points.size(), alike(tree_.bundles()[b])});
      count += points.size();
    }
  for (ComplexColumn& column : arriving_) column.make_room(count);
}

std::span<const StripWalk::Row> StripWalk::rows(const TreeWave& wave) const {
  return std::span(rows_).subspan(wave.first_bundle, wave.end_bundle - wave.first_bundle);
}

// The first strips have radiated, and their kernels are at hand.
void StripWalk::go_on(std::size_t frequency, double share) {
  excite_far_edges(share);
  for (std::size_t w = 1; w < tree_.waves().size(); ++w) {
    find_kernels(w, frequency);
    radiate(w, frequency);
    if (tree_.waves()[w].wave.goes_on()) pass_on(tree_.waves()[w]);
  }
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

// The thickness of a sheet changes what is left of an endless strip once its pole is bounded.
void StripWalk::find_kernels(std::size_t wave, std::size_t frequency) {
  const TreeWave& here = tree_.waves()[wave];
  const double scale = wavenumbers_[frequency] * here.wave.incidence.sin_cone * here.wave.incidence.sin_cone;
  lengths_.clear();
  for (std::uint32_t b = here.first_bundle; b < here.end_bundle; ++b) {
    const StripBundle& bundle = tree_.bundles()[b];
    Row& row = rows_[b];
    row.kernel = lengths_.size();
    const std::size_t count = row.alike ? std::min<std::size_t>(row.size, 1) : row.size;
    for (const PanelPoint& point : placer_.points().subspan(placer_.rows()[b].first, count))
      lengths_.push_back(bundle.edge ? scale * std::max(bundle.length_at(point.place), 0.0) : infinity);
  }
  faces_[wave].strip.at(lengths_, kernels_);
  if (wave == 0) bound_endless(frequency);
  if (faces_[wave].thin) count_thickness(faces_[wave], wavenumbers_[frequency]);
}

void StripWalk::count_thickness(const Face& face, double wavenumber) {
  const FringeKernels endless = face.strip.endless().current;
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    StripKernels kernels = kernels_[i];
    face.thin->correct(kernels, endless, wavenumber, lengths_[i]);
    kernels_.set(i, kernels);
  }
}

void StripWalk::bound_endless(std::size_t frequency) {
  if (std::ranges::none_of(lengths_, [](double length) { return std::isinf(length); })) return;
  const StripWave& wave = tree_.waves()[0].wave;
  const Wedge& wedge = wedges_[wave.wedge];
  const WedgeFace& face = wedge.faces[wave.face];
  const SplitKernels endless = split_kernels(wedge.n, wave.incidence, glance_half_cosine(face, wave.incidence, look_.scattered));
  if (!endless.active) return;
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    if (!std::isinf(lengths_[i])) continue;
    const WindowedPole window = windowed_pole(endless.angle, wavenumbers_[frequency], face.width);
    FringeKernels current = endless.regular;
    add_product(current, endless.pole, window.value);
    kernels_.set(i, {current, 0.0, 0.0});
    if (window.touched) sums_.windowed[frequency] = true;
  }
}

StripWalk::Projection StripWalk::projection(const StripWave& wave) const {
  Projection result;
  for (int receive = 0; receive < 2; ++receive) {
    const double across = glm::dot(look_.receive[receive], wedges_[wave.wedge].faces[wave.face].into_face);
    const double along = glm::dot(look_.receive[receive], wave.incidence.tangent) / wave.incidence.sin_cone;
    result.across[receive] = wave.sign * across / (2 * pi * wave.incidence.sin_cone);
    result.along[receive] = wave.sign * along / (2 * pi * wave.incidence.sin_cone);
  }
  return result;
}

Complex StripWalk::radiated_direct(const ComplexColumn& kernels) const {
  Complex total = 0.0;
  for (const Row& row : rows(tree_.waves()[0])) {
    if (row.size == 0) continue;
    const ColumnPlace weights(direct_, row.amplitude);
    total += row.alike ? sum(weights, row.size) * kernels[row.kernel] : sum_of_products(weights, {kernels, row.kernel}, row.size);
  }
  return total;
}

// Per transmit polarisation, the hard current's share across the strips and along them.
PairSums StripWalk::radiated(const TreeWave& wave) const {
  PairSums total{};
  for (const Row& row : rows(wave)) {
    if (row.size == 0) continue;
    const std::array<ColumnPlace, 2> weights{ColumnPlace(arriving_[0], row.amplitude), ColumnPlace(arriving_[1], row.amplitude)};
    const std::array<ColumnPlace, 2> kernels{ColumnPlace(kernels_.hard, row.kernel), ColumnPlace(kernels_.axial, row.kernel)};
    if (!row.alike) {
      const PairSums sums = sums_of_products(weights, kernels, row.size);
      for (int transmit = 0; transmit < 2; ++transmit)
        for (int part = 0; part < 2; ++part) total[transmit][part] += sums[transmit][part];
      continue;
    }
    for (int transmit = 0; transmit < 2; ++transmit) {
      const Complex weight = sum(weights[transmit], row.size);
      total[transmit][0] += weight * kernels_.hard[row.kernel];
      total[transmit][1] += weight * kernels_.axial[row.kernel];
    }
  }
  return total;
}

void StripWalk::radiate_direct(std::size_t frequency) {
  const TreeWave& wave = tree_.waves()[0];
  const FaceIncidence& incidence = wave.wave.incidence;
  const Projection& seen = faces_[0].seen;
  const Complex hard = radiated_direct(kernels_.hard), soft = radiated_direct(kernels_.soft),
                axial = incidence.cos_cone * radiated_direct(kernels_.axial);
  for (int transmit = 0; transmit < 2; ++transmit) {
    const double magnetic = glm::dot(look_.magnetic[transmit], incidence.tangent);
    const double electric = glm::dot(look_.electric[transmit], incidence.tangent);
    for (int receive = 0; receive < 2; ++receive)
      sums_.first[frequency].at(receive, transmit) +=
          (seen.across[receive] * hard + seen.along[receive] * axial) * magnetic + seen.along[receive] * soft * electric;
  }
}

void StripWalk::radiate(std::size_t wave, std::size_t frequency) {
  const TreeWave& here = tree_.waves()[wave];
  const Projection& seen = faces_[wave].seen;
  const PairSums sums = radiated(here);
  for (int transmit = 0; transmit < 2; ++transmit) {
    const Complex hard = sums[transmit][0], axial = here.wave.incidence.cos_cone * sums[transmit][1];
    for (int receive = 0; receive < 2; ++receive)
      sums_.higher[frequency].at(receive, transmit) += seen.across[receive] * hard + seen.along[receive] * axial;
  }
}

// The hard current arrives with the strips. The soft one flows along the edge; what arrives of it is its component along the
// strips, of the part of the wave whose E lies in the face. The rest is in the plane of incidence: where it grazes, its current
// is that which the hard waves from the other edges take away again, so that passing it on would count it twice.
void StripWalk::excite_far_edges(double share) {
  const TreeWave& wave = tree_.waves()[0];
  const FaceIncidence& incidence = wave.wave.incidence;
  const dvec3 across = glm::cross(wedges_[wave.wave.wedge].faces[wave.wave.face].normal, look_.incident);
  const double squared = glm::dot(across, across);
  const double lying = squared > 0.0 ? glm::dot(across, incidence.tangent) * incidence.cos_cone / squared : 0.0;
  for (int transmit = 0; transmit < 2; ++transmit) {
    const double hard = share * glm::dot(look_.magnetic[transmit], incidence.tangent);
    const double soft = share * glm::dot(look_.electric[transmit], across) * lying;
    for (const Row& row : rows(wave))
      for (std::size_t i = 0; i < row.size; ++i) {
        const std::size_t kernel = row.kernel + (row.alike ? 0 : i);
        const Complex current = hard * kernels_.end[kernel] + soft * kernels_.soft_end[kernel];
        arriving_[transmit].set(row.arriving + i, direct_[row.amplitude + i] * current);
      }
  }
}

// In the product of field and length of edge the sine between strip and edge cancels: H dz = -(current) dz_before / 2.
void StripWalk::pass_on(const TreeWave& wave) {
  for (const Row& row : rows(wave)) {
    if (row.size == 0) continue;
    for (ComplexColumn& column : arriving_) {
      const ColumnPlace amplitudes(column, row.amplitude);
      if (row.alike)
        scale(amplitudes, kernels_.end[row.kernel], row.size, column, row.arriving);
      else
        multiply(amplitudes, {kernels_.end, row.kernel}, row.size, column, row.arriving);
    }
  }
}

}  // namespace raytube
