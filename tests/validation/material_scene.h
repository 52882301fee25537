// Targets of several materials at 10 GHz, solved without edges.
#pragma once

#include "shapes.h"
#include "solve/solve.h"

namespace raytube::material_scene {

inline constexpr double frequency = 10e9;
inline const double k = wavenumber(frequency), lambda = wavelength(frequency);

inline Material half_space(Complex permittivity, Complex permeability = 1.0) {
  Material material{"half-space", MaterialKind::half_space, 0.0, {}};
  material.layers = {{{{permittivity, permeability}, 0.0}}};
  return material;
}

inline Material layered(MaterialKind kind, std::vector<Layer> layers) {
  Material material{"layers", kind, 0.0, {}};
  material.layers = {std::move(layers)};
  return material;
}

/// One material all over, or for each polygon; edges add nothing.
struct Scene {
  PolygonSoup soup;
  std::vector<Material> materials;
  TubeOptions tubes{};

  std::vector<ScatteringMatrix> solved(std::vector<Look> looks, bool bistatic) const {
    PolygonSoup made = soup;
    if (!materials.empty() && made.materials.empty()) made.materials.assign(made.polygons.size(), 0);
    const LoadedMesh loaded = build_mesh(made, 1.0, "test", materials);
    SolveOptions options{tubes, {}, 1, false, {}};
    options.edges.method = EdgeMethod::none;
    const Target target(loaded.mesh);
    return solve(target, {{frequency}, std::move(looks), bistatic, {}, materials}, options).total;
  }
  ScatteringMatrix seen(const Direction& look) const { return solved({{look, look}}, false).front(); }
  ScatteringMatrix seen(const Direction& transmit, const Direction& receive) const {
    return solved({{transmit, receive}}, true).front();
  }
};

inline double difference(const ScatteringMatrix& a, const ScatteringMatrix& b) {
  return frobenius_norm(a - b) / frobenius_norm(b);
}

inline Direction deg(double theta, double phi) { return {theta * degree, phi * degree}; }

}  // namespace raytube::material_scene
