// Fringe current of one strip of a face, from the edge to where the face ends: integrals in closed form. Derived in
// docs/theory/edges.md. Exact on a half plane; on a wedge the current is the uniform (Kouyoumjian-Pathak) one for the
// length of the strip, and what that lacks close to the edge is added as if the strip went on to infinity.
// Notation in multiple_diffraction.h; xi = k sin(beta') x, x the distance across the face; X = xi at the end.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "math/complex_columns.h"
#include "math/erfc_ray.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

/// Least cos(g/2) of an observer along the strip itself, where the kernels have a removable 0/0. At this distance the digits lost
/// to it (1e-16/h) and the change of the kernels (h) are both small; the moment is then parallel to s and radiates no more than
/// h.
inline constexpr double half_cosine_floor = 2e-5;

/// The electrical length from which on 1 - e^{-x} is 1 to the bit.
inline constexpr double whole_length = 40.0;

/// One strip: integrals over the fringe current for unit E or eta H along the edge, as FringeKernels are for an untruncated one,
/// and half the fringe current at the end, with the phase of what radiates from there: H_fr(X) e^{jX mu} / 2 of the hard current
/// and, over cos(beta'), the part of the soft one that flows along the strip.
struct StripKernels {
  FringeKernels current;
  Complex end, soft_end;
};

/// The kernels of many strips, as StripKernels are of one.
struct KernelBatch {
  ComplexColumn soft, hard, axial, end, soft_end;

  /// For `size` strips; never less than there is.
  void make_room(std::size_t size);
  StripKernels operator[](std::size_t i) const { return {{soft[i], hard[i], axial[i]}, end[i], soft_end[i]}; }
  void set(std::size_t i, const StripKernels& kernels);
  /// The first `count` currents become those of a less those of b; either may be this one.
  void set_difference(const KernelBatch& a, const KernelBatch& b, std::size_t count);
};

/// Everything about a strip but its electrical length.
class Strip {
 public:
  /// For a wedge with the exterior angle n pi; `half_cosine` is h of the observer (grazing_half_cosine).
  Strip(double n, FaceIncidence incidence, double half_cosine);

  /// Kernels for every length X; infinity gives those of the untruncated strip. What a length gives is independent of the others.
  void at(std::span<const double> lengths, KernelBatch& batch) const;

  /// The current along the strip, each per dX where it radiates with the phase of its place, as the kernels G_h, G_x and G_s
  /// count it, at r = sqrt(2X); of G_x and G_s r times that, which is finite at the edge.
  struct Currents {
    Complexes hard, axial, soft;
  };
  Currents currents(const Reals& root) const;

  /// What is added close to the edge as if the strip went on to infinity, by 1 - e^{-X} of the strip's end: G_s, G_h, G_x.
  FringeKernels local_part() const {
    return {local_.soft, local_.hard, local_.axial + (1 - 2 * half_cosine_ * half_cosine_) * local_.hard};
  }

  /// Those of a semi-infinite strip, with nothing at its end.
  StripKernels untruncated() const;

  /// What of the currents of every length X has the phase of the strip's start: all that is not proportional to e^{-jX(1 - mu)}.
  /// As 1/h where the two parts all but cancel.
  void start_parts(std::span<const double> lengths, KernelBatch& batch) const;

 private:
  /// A diffracted wave on the face: B e^{j xi cos(beta)} erfc(e^{j pi/4} sqrt(2 xi) c), c = |cos(beta/2)|.
  struct Term {
    double strength;  // B
    double distance;  // c, 0 on the boundary of the incident or reflected wave
    double slope;     // dc/dphi'
  };
  /// What all terms of a block share: r = sqrt(2X), x = rh, W(x), e^{-jx^2} and erf(e^{j pi/4} x) / x.
  struct Observer;
  struct Sums;
  static Term term(double n, double source, int sign);
  void set_grazing(double n, bool own_face);
  void find_local_part(double n, const FaceIncidence& incidence);
  double local_step(double n, bool lit) const;
  double total_strength() const;
  Observer observer(const Reals& length) const;
  static Complexes soft_phase(const Observer& at);
  void add(const Term& term, const Observer& at, Sums& sum) const;
  void add_local(const Reals& length, Sums& sum) const;
  Sums sums(const Reals& length) const;
  void finite_at(std::span<const double> lengths, KernelBatch& batch) const;

  std::array<Term, 2> terms_{};
  int term_count_ = 2;
  double half_cosine_;
  bool has_local_part_ = false;
  struct {
    double soft = 0.0, hard = 0.0, axial = 0.0;
  } local_;  // exact minus uniform current of the untruncated strip
};

}  // namespace raytube
