// Case file (TOML) -> Case: strict keys, units converted, every default resolved.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/options.h"
#include "scene/sweep.h"

namespace raytube {

/// The look section as the user gave it [deg]: either the name of a look list, relative to the case's folder, or the values of
/// each angle.
struct LookChoice {
  std::string looks_csv;
  std::vector<double> theta_deg, phi_deg;
  std::vector<double> rx_theta_deg, rx_phi_deg;  // empty when monostatic
};

/// The radar section as the user gave it; no range and no position: the far field.
struct RadarChoice {
  double range_m = 0.0, receive_range_m = 0.0;
  std::vector<dvec3> positions, receive_positions;  // [m]
  std::vector<double> beamwidth_deg;                // azimuth, elevation
  std::string pattern_csv;                          // relative to the case's folder
};

/// A medium as the user gave it: by name, by a table or by numbers.
struct MediumChoice {
  std::string medium;                                // of the library; else empty
  std::string table_csv;                             // relative to the case's folder; else empty
  std::array<double, 2> eps_r{1, 0}, mu_r{1, 0};     // eps' and eps'', mu' and mu''
  std::optional<double> loss_tangent, conductivity;  // in the place of eps''; conductivity [S/m]
  std::string place, key;                            // where it stands; the key that says what it is
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

/// Which material is where, as the user gave it. A number tells more than a name in a mesh file, and this more than the name of
/// the file.
struct MaterialPlaces {
  struct Part {
    std::string name, material, place;
  };
  struct Facets {
    std::uint64_t first, last;
    std::string material, place;
  };
  std::string elsewhere = "pec";
  std::vector<Part> parts;
  std::vector<Facets> facets;  // ascending, and no facet in two of them
};

struct Case {
  std::string title;
  std::filesystem::path file;
  std::vector<std::string> meshes;                // as written, relative to the case's folder
  std::vector<std::filesystem::path> mesh_files;  // resolved against it
  std::string unit;                               // as written
  double metres_per_unit = 1.0;
  MaterialPlaces places;
  std::vector<MaterialChoice> materials;  // all that are defined; those of use are in sweep.materials
  Sweep sweep;
  LookChoice looks;
  RadarChoice radar;
  TubeOptions tubes;
  EdgeOptions edges;
  WedgeOptions wedges;
  bool plots = true;
  bool incoherent = false;               // what rough surfaces scatter incoherently is written, too
  std::vector<std::size_t> image_looks;  // of which images are made
  double image_per_wavelength = 10.0;
};

/// Tables of the media in use, as written and resolved, each once.
std::vector<std::pair<std::string, std::filesystem::path>> medium_tables(const Case& c);

/// The files that the case is read from, each with the key that names it.
std::vector<std::pair<std::string, std::filesystem::path>> input_files(const Case& c);

/// Reads a case; `overrides` are "dotted.key=value" with values in TOML syntax, applied before anything is checked.
/// Throws InputError with file, line or key, and the remedy.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The resolved case with every default filled in, as JSON text with the case file's keys and units. File names stay relative
/// to the case file's folder, so that it can be read as a case there.
std::string resolved_case_json(const Case& c);

/// The same key by key ("tubes.mode" and its value in JSON), but for the title and [output], on which no amplitude depends.
std::vector<std::pair<std::string, std::string>> numerical_keys(const Case& c);

}  // namespace raytube
