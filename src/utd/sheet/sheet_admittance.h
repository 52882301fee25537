// Edges of thin material plates. A plate is two sheets in its middle plane that do not see one another, one of electric and one
// of magnetic currents, which together answer a plane wave as the plate does; where the plate ends, so do they. Derived in
// docs/theory/material_edges.md.
//
// Notation in the files of this folder; k = 1 and eta = 1 in formulas, e^{j omega t}:
//   x, t            in the sheet: away from its edge, and along the edge, x_f x n_f
//   b, sin_cone     the waves go as e^{j b z} along the edge, b = -s' . t on Keller's cone; sin_cone^2 = 1 - b^2
//   c, nu           e^{jcx} of the incident field, e^{j nu x} in a moment: cosines towards source and observer, over sin_cone
//   s               (1 - a^2)^{1/2}, a = c, nu or any other wave along x
//   C, D            curl and divergence of the sheet's current: two scalar problems, tied at the edge by two constants
//   y               admittance of the sheet, y(a2) at a2 = a^2 + b^2: current over the tangential field of its side
// Formulas are of the electric sheet; the magnetic one is its dual: E -> H, H -> -E, J -> M, M -> -J, and eps <-> mu.
//
//   sheet_admittance   the two sheets that stand for a plate
//   split_function     Wiener-Hopf factors of 2 s + y and 2 + s y
//   sheet_half_plane   the current of a sheet that ends, for waves that come from outside and along it
//   sheet_edges        S of the edges of a target: first order, and what runs over sheets from edge to edge
#pragma once

#include <algorithm>
#include <array>
#include <functional>

#include "scene/material.h"

namespace raytube {

/// One sheet. Curl currents have the admittance y = constant + (normal + slope) a2, where `normal` is due to polarisation across
/// the sheet, those with divergence have `divergence`, one number for all waves.
struct SheetAdmittance {
  Complex constant, normal, slope, divergence;
  /// How far the end face of the plate moves the edge outwards, over the wavenumber [m], for the currents across the edge and for
  /// polarisation across the sheet.
  Complex end_face = 0.0, normal_end_face = 0.0;
  /// What the plate has exactly, curl and divergence, at the cosine of the angle of incidence.
  std::function<std::array<Complex, 2>(double)> exact;

  /// There is no current worth the name.
  bool empty() const { return std::max({std::abs(constant), std::abs(normal), std::abs(divergence)}) < 1e-10; }
};

/// A plate at one frequency.
struct SheetPair {
  SheetAdmittance electric, magnetic;
  double slowest = 1.0;        // no wave that the plate guides has a larger wavenumber, over k
  double current_share = 1.0;  // how much of its edge currents counts: those of thick plates fade out
};

/// SheetPair::share of a material that transmits.
double sheet_share(const Material& material, std::size_t frequency, double wavenumber);

/// The sheets of a material that transmits. Fitted at normal and at grazing incidence; the polynomial must not follow the exact
/// admittance further, which grows like an exponential for evanescent waves and has no split functions. Valid for k d |n| up to
/// about 2.5, from where on the share falls; it is none at 4. Layers that are not symmetric are taken as the mean of both sides.
SheetPair sheet_pair(const Material& material, std::size_t frequency, double wavenumber);

/// How far the end face of a layer moves the edge for the field across it, over kd; first order in kd: the static field at the
/// end face, uniform over the thickness. `ratio` is the medium's permittivity for currents across the edge, and the inverse for
/// polarisation across the layer.
Complex end_face_shift(Complex ratio);

}  // namespace raytube
