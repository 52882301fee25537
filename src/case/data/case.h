// The room of case files. A case file (TOML) becomes a Case: keys are strict, units converted, every default is resolved.
//
//     document     the text of the file and of --set as a tree of values that know their location: file and line, or option
//     keys         which keys there are; values: numbers, texts, vectors and ranges, checked
//     read_case    the tree -> Case, section by section: materials, media, looks, radar
//     target       Case -> mesh with materials; resolved_case: Case -> JSON
//
// This file has the plain data alone. Lengths, angles and frequencies that a reader keeps "as the user gave it" have the unit of
// their key; all others are in SI units and radians.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/motion.h"
#include "scene/options.h"
#include "scene/sweep.h"

namespace raytube {

/// The look section as the user gave it [deg]: the name of a look list, relative to the case's folder, or a list of numbers,
/// which stands in the sweep alone, or the values of each angle.
struct LookChoice {
  std::string looks_csv;
  bool given_as_numbers = false;
  std::vector<double> theta_deg, phi_deg;
  std::vector<double> rx_theta_deg, rx_phi_deg;  // empty when monostatic
};

/// The radar section as the user gave it; no range and no position: the far field.
struct RadarChoice {
  double range_m = 0.0, receive_range_m = 0.0;
  std::vector<dvec3> positions, receive_positions;  // [m]
  std::vector<double> turntable_deg;                // empty: there is none
  std::vector<double> beamwidth_deg;                // azimuth, elevation
  std::string pattern_csv;                          // relative to the case's folder
  std::optional<LinkBudget> link;                   // transmit power and gain
};

/// A medium as the user gave it: by name, by a table or by numbers.
struct MediumChoice {
  std::string medium;                                // of the library; else empty
  std::string table_csv;                             // relative to the case's folder; else empty
  std::array<double, 2> eps_r{1, 0}, mu_r{1, 0};     // eps' and eps'', mu' and mu''
  std::optional<double> loss_tangent, conductivity;  // in the place of eps''; conductivity [S/m]
  std::string location, key;                         // file and line, or option; the key that says what it is
};

struct LayerChoice {
  double thickness_mm = 0.0;  // 0: a half-space
  MediumChoice medium;
};

/// An entry of the materials section as the user gave it.
struct MaterialChoice {
  std::string name, kind;
  std::vector<LayerChoice> layers;
  std::optional<double> resistance, conductance;  // [ohm], [S]
  double roughness_mm = 0.0;
};

/// Which facets have which material, as the user gave it. A number tells more than a name in a mesh file, and this more than the
/// name of the file.
struct MaterialAssignment {
  struct Part {
    std::string name, material, location;
  };
  struct Facets {
    std::uint64_t first, last;
    std::string material, location;
  };
  std::string elsewhere = "pec";
  std::vector<Part> parts;
  std::vector<Facets> facets;  // ascending, and no facet in two of them
};

/// Words of motion.retrace.
inline constexpr std::array<std::string_view, 2> retrace_words{"every", "auto"};

/// The motion section as the user gave it: pulses, or a list of times.
struct MotionChoice {
  double start_s = 0.0, interval_s = 0.0;  // of pulses
  std::size_t pulses = 0;                  // how many; 0: times are listed
  std::vector<double> times_s;             // listed
  bool retrace = true;                     // every time is traced; else so many as their motion asks for
  std::optional<BodyMotion> radar;         // of the antennas, if they move: its velocity and its places
  bool aim_moves = false;                  // with the antennas; else it stands
  std::string location;                    // of the section: file and line, or option
  Motion motion;                           // bodies; their names in the mesh are not checked yet

  /// How many times there are.
  std::size_t times() const { return pulses > 0 ? pulses : times_s.size(); }
};

/// A key of a section, and where it is written: file and line, or option.
struct WrittenKey {
  std::string name, location;
  bool overriding;  // written on the command line
};

/// A case, read and checked: what `sweep`, `tubes`, `edges` and `wedges` hold goes to the solver as it is.
struct Case {
  std::string title;
  std::filesystem::path file;
  std::vector<std::string> meshes;                // as written, relative to the case's folder
  std::string mesh_location;                      // of target.mesh: file and line, or option
  std::vector<std::filesystem::path> mesh_files;  // resolved against it
  std::string unit;                               // as written
  double metres_per_unit = 1.0;
  MaterialAssignment assignment;
  std::vector<MaterialChoice> materials;  // all that are defined; those of use are in sweep.materials
  Sweep sweep;
  LookChoice looks;
  RadarChoice radar;
  std::optional<Ground> ground;        // below the target; none: free space
  std::optional<MotionChoice> motion;  // sweep.times are there, and the looks of all of these; none: everything stands
  TubeOptions tubes;
  EdgeOptions edges;
  std::vector<WrittenKey> edge_keys;  // of [edges] that are written
  SurfaceOptions surfaces;
  WedgeOptions wedges;
  bool plots = true;
  bool netcdf = false;                   // the results are written as rcs.nc, too
  bool incoherent = false;               // what rough surfaces scatter incoherently is written, too
  bool power = false;                    // received power is written, too; radar.link is there
  std::vector<std::size_t> image_looks;  // of which images are made
  double image_per_wavelength = 10.0;
  std::vector<std::string> warnings;  // sentences about what was likely meant otherwise

  /// Times at which every look is computed: one where everything stands.
  std::size_t times() const { return motion ? motion->times() : 1; }
  /// How many looks each of them has.
  std::size_t looks_at_a_time() const { return sweep.looks.size() / times(); }
};

}  // namespace raytube
