// The constants of the model uncertainty, each with its ground. What is fitted is fitted by bench/calibrate_uncertainty.py, on
// bodies that do not judge it (docs/theory/model_uncertainty.md); what has a closed form stands where it is used.
#pragma once

#include "core/field.h"

namespace raytube::uncertainty {

// Fitted: waves of corners and orders of edges on plates of 1 to 3.6 wavelengths, the exact method of moments.
inline constexpr double corner_amplitude = 0.06;    // of a sharp corner, over the wavelength
inline constexpr double untruncated_corners = 1.5;  // the same at first order: faces are taken as endless
inline constexpr double edge_amplitude = 1.2;       // of an edge without currents, over its length in phase / 2 pi
inline constexpr double second_order = 0.5;         // at first order: what the next one adds, over the first
// The next term of a series over the last one that is computed, of orders of edges and of edge-face interaction.
inline constexpr double next_term = 0.3;

// Fitted: on spheres of ka 5 to 50 by Mie's series, without and with waves over surfaces.
inline constexpr double boundary_amplitude = 2.5;  // of a shadow boundary, over LookFeatures::shadow_boundaries
inline constexpr double wave_error = 0.15;         // where waves run on: of that
inline constexpr double tight_wave_error = 1.0;    // and of tight bends, by which they are rough
// Twice as strong as a shadow boundary. Only rims of the almond are known: no set of the project calibrates it.
inline constexpr double rim_amplitude = 2.0 * boundary_amplitude;

// Chords of circles and ellipses of even and uneven chords (CoarseBodies): what a bent one is off, over a flat one and its
// turning to the power of 3/2; 1.2 in the place of 0.31 covers surfaces of two curvatures and triangles of any shape.
inline constexpr double bent_share = 1.2;
inline constexpr double most_facet_error = 2.0;  // two fields of the same size in opposite phase

// Share of the currents of an edge that is missing.
inline constexpr double material_share = 0.6;        // beside materials, of their strength (dielectric and absorber plates)
inline constexpr double heuristic_share = 0.3;       // with the heuristic's currents: half of it
inline constexpr double curved_faces_share = 0.3;    // curved faces taken as planes
inline constexpr double followed_faces_share = 0.1;  // with strips that follow them: 0.84 dB in the mean over a section's looks
                                                     // at most (docs/theory/surface_waves.md)

// Borders of what is meant by a word, not sizes.
inline constexpr double doubtful_turn = 2.0;           // turns that may be tessellation, over edges.min_wedge_deg
inline constexpr double flat_crease = 1e-4;            // flatter ones are the rounding of coordinates [rad]
inline constexpr double least_turn = 15.0 * degree;    // wedges that turn less where they meet are one curved edge
inline constexpr double least_curvature = 20.0;        // kR above which shadow boundaries change the field of a facet by more
inline constexpr double darkest_rim = -0.7;            // cosine to the antenna of rims that waves from the other side still reach
inline constexpr std::size_t interacting_bounces = 3;  // that edge-face interaction mends

}  // namespace raytube::uncertainty
