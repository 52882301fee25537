// Work in counted steps: what a look costs, the same on every machine and at every run.
//
// A unit is about a nanosecond of one core of 2024. What a step costs was measured, with bench/interaction_budget.py, and is a
// constant; what decides a result is how often it was done, never how long it took.
#pragma once

namespace raytube::work {

// Rays of one azimuth about an edge (utd/fan/ray_fan).
inline constexpr double fan = 400.0;                 // the search for faces
inline constexpr double face_in_fan = 40.0;          // one face cut by the fan's plane
inline constexpr double order_in_fan = 2.0;          // one face compared at one place
inline constexpr double ray_row = 1200.0;            // waves over one face, at one frequency (utd/wedge/edge_wave_integral)
inline constexpr double near_ray_row = 1500.0;       // rays from and to antennas at a finite distance (utd/interaction/near_row)
inline constexpr double near_ray_frequency = 500.0;  // their waves, at one frequency
inline constexpr double known_wave = 30.0;           // one wave over a face, of known amplitude, at one frequency
inline constexpr double azimuth_cut = 60.0;          // one azimuth where rays may jump
inline constexpr double edge_light = 5000.0;         // which parts of one edge a wave lights

// Fringe currents (utd/fringe, utd/multiple).
inline constexpr double strip_tree = 1000.0;     // one wave on one face of an edge
inline constexpr double strip_corner = 8.0;      // one corner of a face, projected along a wave
inline constexpr double strip_point = 60.0;      // one point of the quadrature in one wave, at one frequency
inline constexpr double edge_amplitude = 300.0;  // one edge at first order, at one frequency
inline constexpr double corner_wave = 15000.0;   // the waves along one edge, both ways

inline constexpr double impedance_edge = 12000.0;   // one edge of coats and half-spaces, at one frequency (utd/impedance)
inline constexpr double impedance_strip = 50000.0;  // its strips to one far edge, at one frequency

// Rims of material plates (utd/sheet).
inline constexpr double sheet_half_plane = 300000.0;  // the tables of one sheet at one angle of the cone
inline constexpr double sheet_rim = 30000.0;          // one rim at first order
inline constexpr double sheet_wave = 500.0;           // one wave of a sheet at the next rim, or at one point of it

// Strips over curved surfaces (utd/surface).
inline constexpr double surface_step = 300.0;       // one step along a geodesic
inline constexpr double surface_frequency = 100.0;  // the current there, at one frequency
inline constexpr double lit_point = 250.0;          // one point of the lit side
inline constexpr double lit_frequency = 50.0;       // the current there, at one frequency

// Beside them (utd/rounded, utd/tip), at one frequency.
inline constexpr double rim_piece = 90000.0;       // one lit piece of a rounded edge
inline constexpr double flat_tip_point = 250.0;    // one point of a rim before a flat tip, for one antenna
inline constexpr double round_tip_side = 70000.0;  // one side of a round tip, as one antenna sees it

inline constexpr double blocker_ray = 1500.0;  // one ray that looks for what blocks a wave

}  // namespace raytube::work
