// Bends of curved surfaces as rounded edges.
#pragma once

#include <span>
#include <vector>

#include "utd/surface/curved_target.h"
#include "utd/surface/local_look.h"
#include "utd/surface/strip_sum.h"

namespace raytube {

/// A piece of a rim: the mean of the noses of facets near by.
struct RimPiece {
  Nose nose;
  double length = 0.0;  // [m]
};

/// How long the facets of noses may be along a rim at `frequency` [Hz]: the power of two between wavelength / 8 and wavelength /
/// 4 that lies there [m], so that the frequencies of an octave share them.
double longest_nose(double frequency);

/// Those of a target at a wavenumber, short beside the wavelength as the facets of its noses are.
std::vector<RimPiece> rim_pieces(std::span<const Nose> noses, double wavenumber);

/// What rims add to the physical optics of their surfaces, and of how many lit pieces it is the sum.
CountedSum rim_scattering(const CurvedTarget& target, std::span<const RimPiece> pieces, LocalLook& look, double wavenumber,
                          StripPlaces* places);

}  // namespace raytube
