// How far apart rows of a sweep may lie so that the curve between them is known: what lobes ask for.
#pragma once

#include <span>
#include <vector>

#include "scene/sweep.h"

namespace raytube {

/// Those of the points that lie farthest out in one of many directions: few, but as wide as all of them to 5 per cent.
std::vector<dvec3> outermost_points(std::span<const dvec3> points);

/// Largest distance between two of the points [m].
double largest_extent(std::span<const dvec3> outermost);

/// k (r_hat(transmit) + r_hat(receive)) [rad/m]: the phase of what a point r sends back is that along r. For antennas at a finite
/// distance the directions count.
dvec3 scattering_vector(const Look& look, double frequency);

/// The most by which the phases of what two of the points send back turn against one another between two scattering vectors
/// [rad].
double phase_turn(std::span<const dvec3> outermost, const dvec3& from, const dvec3& to);

/// Lobes are resolved by rows between which the phases of no two points of the target turn by more than half a turn (two samples
/// a period: Shannon 1949). From the scattering vector it follows that monostatic steps are wavelength / (4 extent across the
/// line of sight) rad at most, bistatic ones, where one antenna moves, twice that; steps in frequency c / (4 extent along it).
inline constexpr double most_turn = pi;

/// A range profile is made of complex rows, which take half as many: its unambiguous range, c / (2 step), holds the extent along
/// the line of sight while no two points turn by more than a whole turn from row to row.
inline constexpr double most_turn_of_profile = 2.0 * pi;

/// With some room for the rounding of a step that is just that wide.
inline bool resolved(double turn, double most = most_turn) { return turn <= most * (1.0 + 1e-9); }

}  // namespace raytube
