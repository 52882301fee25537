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
    find_kernels(0, wavenumbers_[f]);
    bound_endless(f);
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
      find_kernels(0, wavenumbers_[f]);
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
    faces_.push_back({Strip(wedge.n, each.wave.incidence, half_cosine, tier_), projection(each.wave)});
  }
  arriving_at_.clear();
  std::size_t count = 0;
  for (const PanelPlacer::Row& row : placer_.rows()) {
    arriving_at_.push_back(count);
    count += row.size();
  }
  for (ComplexColumn& column : arriving_) column.resize(count);
  first_kernel_.resize(arriving_at_.size());
}

// The first strips have radiated, and their kernels are at hand.
void StripWalk::go_on(std::size_t frequency, double share) {
  excite_far_edges(share);
  for (std::size_t w = 1; w < tree_.waves().size(); ++w) {
    find_kernels(w, wavenumbers_[frequency]);
    radiate(w, frequency);
    if (tree_.waves()[w].wave.left > 1) pass_on(tree_.waves()[w]);
  }
}

void StripWalk::find_phases(double wavenumber) {
  const EdgeLine& line = tree_.waves()[0].line;
  const dvec3 difference = wavenumber * (look_.scattered - look_.incident);
  const double start = glm::dot(difference, line.origin), step = glm::dot(difference, line.step);
  const std::span<const PanelPoint> points = placer_.points();
  direct_.resize(points.size());
  for (std::size_t first = 0; first < points.size(); first += lanes) {
    Reals angle{};
    const std::size_t width = std::min(lanes, points.size() - first);
    for (std::size_t i = 0; i < width; ++i) angle[i] = start + step * points[first + i].place;
    const Complexes phasors = unit_phasors(angle);
    for (std::size_t i = 0; i < width; ++i) direct_.set(first + i, points[first + i].weight * phasors[i]);
  }
}

void StripWalk::find_kernels(std::size_t wave, double wavenumber) {
  const TreeWave& here = tree_.waves()[wave];
  const double scale = wavenumber * here.wave.incidence.sin_cone * here.wave.incidence.sin_cone;
  lengths_.clear();
  for (std::uint32_t b = here.first_bundle; b < here.end_bundle; ++b) {
    const StripBundle& bundle = tree_.bundles()[b];
    const PanelPlacer::Row& row = placer_.rows()[b];
    first_kernel_[b] = lengths_.size();
    const std::size_t count = row.size() == 0 ? 0 : alike(bundle) ? 1 : row.size();
    for (const PanelPoint& point : placer_.points().subspan(row.first, count))
      lengths_.push_back(bundle.edge ? scale * std::max(bundle.length_at(point.place), 0.0) : infinity);
  }
  faces_[wave].strip.at(lengths_, kernels_);
}

void StripWalk::bound_endless(std::size_t frequency) {
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

// Amplitudes of the first strips are direct_; of those that follow they are what arrived with the bundle before.
StripWalk::Row StripWalk::row(const TreeWave& wave, std::uint32_t bundle) const {
  const PanelPlacer::Row& points = placer_.rows()[bundle];
  Row result{points.first, first_kernel_[bundle], points.size(), alike(tree_.bundles()[bundle])};
  if (wave.parent != no_index) result.amplitude += arriving_at_[wave.parent] - placer_.rows()[wave.parent].first;
  return result;
}

Complex StripWalk::radiated(const TreeWave& wave, const ComplexColumn& amplitudes, const ComplexColumn& kernels) const {
  Complex total = 0.0;
  for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
    const Row at = row(wave, b);
    if (at.size == 0) continue;
    const ColumnPlace weights(amplitudes, at.amplitude);
    total += at.alike ? sum(weights, at.size) * kernels[at.kernel] : sum_of_products(weights, {kernels, at.kernel}, at.size);
  }
  return total;
}

void StripWalk::radiate_direct(std::size_t frequency) {
  const TreeWave& wave = tree_.waves()[0];
  const FaceIncidence& incidence = wave.wave.incidence;
  const Projection& seen = faces_[0].seen;
  const Complex hard = radiated(wave, direct_, kernels_.hard), soft = radiated(wave, direct_, kernels_.soft),
                axial = incidence.cos_cone * radiated(wave, direct_, kernels_.axial);
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
  for (int transmit = 0; transmit < 2; ++transmit) {
    const Complex hard = radiated(here, arriving_[transmit], kernels_.hard);
    const Complex axial = here.wave.incidence.cos_cone * radiated(here, arriving_[transmit], kernels_.axial);
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
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
      const Row at = row(wave, b);
      for (std::size_t i = 0; i < at.size; ++i) {
        const std::size_t kernel = at.kernel + (at.alike ? 0 : i);
        arriving_[transmit].set(arriving_at_[b] + i,
                                direct_[at.amplitude + i] * (hard * kernels_.end[kernel] + soft * kernels_.soft_end[kernel]));
      }
    }
  }
}

// In the product of field and length of edge the sine between strip and edge cancels: H dz = -(current) dz_before / 2.
void StripWalk::pass_on(const TreeWave& wave) {
  for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
    const Row at = row(wave, b);
    if (at.size == 0) continue;
    for (ComplexColumn& column : arriving_) {
      const ColumnPlace amplitudes(column, at.amplitude);
      if (at.alike)
        scale(amplitudes, kernels_.end[at.kernel], at.size, column, arriving_at_[b]);
      else
        multiply(amplitudes, {kernels_.end, at.kernel}, at.size, column, arriving_at_[b]);
    }
  }
}

}  // namespace raytube
