#include "utd/multiple/strip_wave_kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void add_product(FringeKernels& sum, const FringeKernels& kernels, Complex factor) {
  sum.soft += factor * kernels.soft;
  sum.hard += factor * kernels.hard;
  sum.axial += factor * kernels.axial;
}

void bound_untruncated(const ForwardPole& pole, std::size_t per_wavenumber, std::span<const double> wavenumbers,
                       std::span<const double> lengths, KernelBatch& kernels) {
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (!std::isinf(lengths[i])) continue;
    FringeKernels current = pole.kernels.regular;
    add_product(current, pole.kernels.pole, pole.at(wavenumbers[i / per_wavenumber]).value);
    kernels.set(i, {current, 0.0, 0.0});
  }
}

void count_thickness(const WaveFace& face, std::span<const double> wavenumbers, std::span<const double> lengths,
                     KernelBatch& batch) {
  const FringeKernels untruncated = face.strip.untruncated().current;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    StripKernels kernels = batch[i];
    face.thin->correct(kernels, untruncated, wavenumbers[i / face.kernels], lengths[i]);
    batch.set(i, kernels);
  }
}

// Fades the soft current that strips hardly longer than `fading_length` pass on.
void fade_soft_ends(double fading_length, std::span<const double> lengths, KernelBatch& kernels) {
  for (std::size_t first = 0; first < lengths.size(); first += lanes) {
    Reals length{};
    const std::size_t width = std::min(lanes, lengths.size() - first);
    if (std::ranges::min(lengths.subspan(first, width)) > whole_length * fading_length) continue;
    for (std::size_t i = 0; i < width; ++i) length[i] = lengths[first + i] / fading_length;
    const Reals share = one_minus_exp(length);
    for (std::size_t i = 0; i < width; ++i) kernels.soft_end.set(first + i, share[i] * kernels.soft_end[first + i]);
  }
}

}  // namespace

// The thickness of a plate changes what is left of a semi-infinite strip once its pole is bounded.
void StripWaveKernels::find(const StripLayout& strips, std::size_t wave, std::span<const double> wavenumbers, bool in_parts,
                            WaveKernelBatch& kernels) {
  const TreeWave& here = strips.tree.waves()[wave];
  const WaveFace& face = strips.faces[wave];
  find_lengths(strips, wave, wavenumbers);
  KernelBatch& whole = kernels.whole;
  face.strip.at(lengths_, whole);
  if (wave == 0 && strips.forward_pole) bound_untruncated(*strips.forward_pole, face.kernels, wavenumbers, lengths_, whole);
  if (face.thin) count_thickness(face, wavenumbers, lengths_, whole);
  if (here.direct) fade_soft_ends(strips.fading_length, lengths_, whole);
  if (in_parts) find_parts(face, wavenumbers, kernels);
  if (here.wave.mirrors > 0) keep_mirrored_part(face, wavenumbers, in_parts, kernels);
}

void StripWaveKernels::find_parts(const WaveFace& face, std::span<const double> wavenumbers, WaveKernelBatch& kernels) {
  face.strip.start_parts(lengths_, kernels.start);
  if (face.thin) count_thickness(face, wavenumbers, lengths_, kernels.start);
  kernels.end.set_difference(kernels.whole, kernels.start, lengths_.size());
}

void StripWaveKernels::find_lengths(const StripLayout& strips, std::size_t wave, std::span<const double> wavenumbers) {
  const TreeWave& here = strips.tree.waves()[wave];
  const bool mirrored = here.wave.mirrors > 0;
  for (std::vector<double>* each : {&lengths_, &behind_, &detours_}) each->clear();
  for (const double k : wavenumbers) {
    const double scale = k * here.wave.incidence.sin_cone * here.wave.incidence.sin_cone;
    for (std::uint32_t b = here.first_bundle; b < here.end_bundle; ++b) {
      const StripBundle& bundle = strips.tree.bundles()[b];
      const StripRow& row = strips.rows[b];
      const std::size_t count = row.alike ? std::min<std::size_t>(row.size, 1) : row.size;
      const std::span<const PanelPoint> points = strips.panels.points().subspan(strips.panels.ranges()[b].first, count);
      const std::size_t first = lengths_.size();
      if (bundle.edge)
        for (const PanelPoint& point : points) lengths_.push_back(scale * std::max(bundle.length_at(point.arc_length), 0.0));
      else
        lengths_.resize(first + count, infinity);
      if (!mirrored) continue;
      for (std::size_t i = 0; i < count; ++i) {
        behind_.push_back(scale * std::max(here.behind.at(points[i].arc_length), 0.0));
        detours_.push_back(k * here.detour.at(points[i].arc_length));
        lengths_[first + i] += behind_.back();
      }
    }
  }
}

// Seen from the image of the source, the current from the corner on. A semi-infinite one, over a smooth crease, is left out: the
// surface that stands at the corner does not go on for ever. What has the phase of the edge cancels but for the local part, which
// is gone where its path differs from that of the corner.
void StripWaveKernels::keep_mirrored_part(const WaveFace& face, std::span<const double> wavenumbers, bool in_parts,
                                          WaveKernelBatch& kernels) {
  face.strip.at(behind_, shorter_);
  if (face.thin) count_thickness(face, wavenumbers, behind_, shorter_);
  kernels.whole.set_difference(kernels.whole, shorter_, lengths_.size());
  turn(kernels.whole);
  if (!in_parts) return;
  turn(kernels.end);
  kernels.start.set_difference(kernels.whole, kernels.end, lengths_.size());
}

void StripWaveKernels::turn(KernelBatch& kernels) const {
  for (std::size_t first = 0; first < lengths_.size(); first += lanes) {
    Reals angle{};
    const std::size_t width = std::min(lanes, lengths_.size() - first);
    for (std::size_t i = 0; i < width; ++i) angle[i] = detours_[first + i];
    Complexes turn = unit_phasors(angle);
    for (std::size_t i = 0; i < width; ++i)
      if (std::isinf(lengths_[first + i])) turn.set(i, 0.0);
    for (ComplexColumn* column : {&kernels.soft, &kernels.hard, &kernels.axial, &kernels.end, &kernels.soft_end}) {
      Complexes turned{};
      add_products(turned, load(*column, first), turn);
      store(turned, *column, first);
    }
  }
}

bool is_windowed(const StripLayout& strips, double wavenumber) {
  return strips.forward_pole && strips.forward_pole->at(wavenumber).touched;
}

}  // namespace raytube
