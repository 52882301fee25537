// What the asymptotic physics leaves out, by name, and how large it may be in one row.
//
// Every omission has an estimate in metres of |S|, made of lengths, counts and amplitudes that are there already:
//   target_features.h   corners, edges without currents, creases of curved surfaces: found once for a target and a wavelength
//   look_features.h     which of them a look lights, with what phases
//   omissions.h         the estimates of a row, from these and from the amplitudes of its mechanisms
// Sources and constants, and how well they hold: docs/theory/model_uncertainty.md.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/field.h"
#include "uncertainty/look_features.h"

namespace raytube {

enum class Omission {
  corners,          // no tip diffraction, and edge currents of half their strength at the corners they run into
  edge_orders,      // diffraction at further edges
  edges,            // edges that have no currents of their own
  interaction,      // edge-face interaction: further edges and reflections of a path, or all of it
  cavities,         // waves that were reflected often, as if every face were a mirror that is lit evenly
  smooth_surfaces,  // creeping and travelling waves, and what starts at shadow boundaries
  focusing,         // waves that were inside of solids, or of shells of sheets, and meet where geometrical optics says little
  facets,           // flat facets that stand for curvature
  cut_tubes,        // bounces that were not followed
  small_target      // a target, or what there is of it, below a wavelength
};
inline constexpr std::size_t omissions = 10;

/// How an omission is called in files, what it is, and what makes it less.
struct OmissionText {
  const char* name;
  const char* what;
  const char* remedy;
};
const OmissionText& text_of(Omission omission);

/// Estimates [m] of what is missing in |S_pq|, by omission.
using OmissionErrors = std::array<ChannelErrors, omissions>;

/// What a row is made of, and how.
struct RowEvidence {
  double facets = 0.0;                          // FacetDents::relative_error
  double rim_dent = 0.0;                        // [m]
  double half_extent = 0.0;                     // half of the target's longest dimension [m]
  std::span<const ScatteringMatrix> bounces{};  // PO currents of bounce 1, 2, ... [m]
  std::span<const double> met{};                // TubeSums::met: power of the waves that met surfaces, by bounce [m^2]
  PenumbraShares penumbras{};                   // of a wave that is reflected more than once
  ScatteringMatrix inside{};                    // of `bounces`: of waves that were inside of solids
  double left_solids = 0.0;                     // their power as they leave: area times squared amplitude [m^2]
  ScatteringMatrix edges{}, higher{}, interaction{}, surface_waves{};
  bool has_interaction = false;    // edge-face interaction was computed
  bool has_surface_waves = false;  // waves over curved surfaces were computed
  double left_out = 0.0;           // of it, for the sake of its budget [m]
  int edge_order = 3;              // edges in a row that a current passes; 0: there are no edge currents
  double truncated = 0.0;          // area across the wave times squared amplitude of truncated tubes [m^2]
  double wavelength = 0.0;         // [m]

  ScatteringMatrix total() const;
  /// Of the power that met the target: that which meets a second surface, and a third one, 0 ... 2.
  double reflected_share() const;
};

/// Valid for plane waves; reciprocal if `look` is.
OmissionErrors estimate_omissions(const LookFeatures& look, const RowEvidence& row);

/// The root of the sum of their squares.
ChannelErrors root_sum_square(std::span<const ChannelErrors> errors);

}  // namespace raytube
