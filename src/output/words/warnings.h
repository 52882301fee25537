// Warnings about cases that do not suit their targets. Each sentence gives the number, the limit and the remedy.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "output/tables/sampled_rows.h"
#include "scene/material.h"
#include "scene/open_bodies.h"
#include "scene/thick_layers.h"
#include "scene/validity.h"

namespace raytube {

/// Places and lengths are given in the unit of the mesh, in which the user looks for them.
struct MeshUnit {
  double metres = 1.0;
  std::string name = "m";
};

/// One sentence, unless the open bodies are a small share of the surface.
std::vector<std::string> open_body_warnings(const OpenBodies& bodies, const MeshUnit& unit);

/// One sentence for each of the materials, about its narrowest component.
std::vector<std::string> thick_layer_warnings(const std::vector<ThickLayers>& layers, std::span<const Material> materials,
                                              const MeshUnit& unit);

/// One sentence for each kind of feature that is too small for the methods, or a single one for a target that is too small as a
/// whole. For a target so large or small that another unit was likely meant, the sentence names target.unit.
std::vector<std::string> validity_warnings(const Validity& validity, const MeshUnit& unit = {});

/// One sentence for each swept quantity.
std::vector<std::string> sampling_warnings(const std::vector<CoarseSteps>& steps);

}  // namespace raytube
