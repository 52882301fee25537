// Reflection and transmission by plane layers.
#pragma once

#include <span>

#include "core/field.h"

namespace raytube {

/// A passive medium at one frequency, relative to vacuum: eps' - j eps'', mu' - j mu'' with losses not below zero (e^{+j omega
/// t}).
struct Medium {
  Complex permittivity = 1.0;  // eps_r
  Complex permeability = 1.0;  // mu_r
};

/// A plane layer of one medium.
struct Layer {
  Medium medium;           // at one frequency
  double thickness = 0.0;  // [m]
};

/// Ratios of electric fields at a plane met from vacuum: with t = d x n / |d x n|, n towards the source and d, d_r and d the
/// directions of the incident, the reflected and the transmitted wave,
///   E_r = reflected.te (E.t) t + reflected.tm (E.(d x t)) (d_r x t),   E_t = transmitted.te (E.t) t + transmitted.tm (E.(d x t))
///   (d x t).
/// A perfect conductor has -1, +1, 0, 0. `transmitted` is the wave in vacuum behind a sheet, zero behind all else.
struct SurfaceResponse {
  /// The ratios of both polarisations.
  struct Polarised {
    Complex te, tm;  // E across the plane of incidence; E in it
  };
  Polarised reflected, transmitted;  // of the electric field
};

/// A half-space of one medium. `cosine` is that of the angle of incidence, 0 < cosine <= 1, here and below.
SurfaceResponse half_space_response(const Medium& medium, double cosine);

/// Layers on a perfect conductor, the outermost first; phases at the outer face. No layer: the conductor.
SurfaceResponse coated_response(std::span<const Layer> layers, double wavenumber, double cosine);

/// Layers in vacuum, the first one met first; phases at the plane in the middle of them: those of a wave that is neither delayed
/// nor reflected are 1 and 0.
SurfaceResponse sheet_response(std::span<const Layer> layers, double wavenumber, double cosine);

/// A sheet without thickness in which E along it drives an electric current, E = resistance J [ohm], and H along it a magnetic
/// one, H = conductance M [S] (Senior & Volakis 1995, sections 2.5.1 and 2.5.2). Infinite: there is no such current.
SurfaceResponse thin_sheet_response(double resistance, double conductance, double cosine);

}  // namespace raytube
