// The constants of the model uncertainty, each with its ground. What is fitted is fitted by bench/calibrate_uncertainty.py, on
// bodies that do not judge it (docs/theory/model_uncertainty.md); what has a closed form stands where it is used.
#pragma once

#include "core/field.h"

namespace raytube::uncertainty {

// Fitted on plates of 1 to 3.6 wavelengths and a cube, by the method of moments: what covers nine rows in ten there is in
// brackets. Solid and reflecting bodies want more of corners than plates do, and no set without curved edges knows weak ones.
inline constexpr double corner_amplitude = 0.06;    // of a sharp corner, over the wavelength (0.037)
inline constexpr double untruncated_corners = 1.5;  // the same at first order, where faces are taken as endless (1.2 to 2)
inline constexpr double edge_amplitude = 1.2;       // of an edge without currents, over its length in phase / 2 pi (0.92)
inline constexpr double second_order = 0.8;         // at first order: what the next one adds, over the first (0.8)
// The next term of a series over the last one that is computed: of orders of edges, of edge-face interaction. No set of the
// project decides it, by hand.
inline constexpr double next_term = 0.3;

// Fitted on spheres of ka 5 to 50 by Mie's series, without and with waves over surfaces.
inline constexpr double boundary_amplitude = 1.6;  // of a shadow boundary, over LookFeatures::shadow_boundaries (1.6)
inline constexpr double wave_error = 0.15;         // where waves run on: of that (0.037 in monostatic looks, the only ones there)
inline constexpr double tight_wave_error = 1.0;    // and of tight bends, by which they are rough: by hand
inline constexpr double rim_amplitude = 5.0;       // of sharply curved rims, over LookFeatures::rims: by hand, on the almond

// Of waves that were inside of solids: of what rays give, and of what they would give evenly all around. Behind a curved surface
// they meet caustics, and bodies of revolution send them back in a ring (glory), which geometrical optics leaves out. By Mie's
// series, clear spheres of 3 to 10 wavelengths.
inline constexpr double focused_share = 1.0, focused_amplitude = 2.0;

// Chords of circles and ellipses of even and uneven chords (CoarseBodies): what a bent one is off, over a flat one and its
// turning to the power of 3/2; 1.2 in the place of 0.31 covers surfaces of two curvatures and triangles of any shape.
inline constexpr double bent_share = 1.2;
inline constexpr double most_facet_error = 2.0;  // two fields of the same size in opposite phase

// Share of the currents of an edge that is missing.
inline constexpr double material_share = 0.6;        // beside materials, of their strength (dielectric and absorber plates)
inline constexpr double rim_share = 0.08;            // of rims of thin plates with currents of their own (the same plates)
inline constexpr double opaque_share = 0.2;          // of edges of coats and media with theirs: first order (a coated plate)
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
