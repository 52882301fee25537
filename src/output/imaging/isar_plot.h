// Images of sweeps as pictures.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "imaging/isar.h"

namespace raytube {

/// Draws isar.png in `folder`, which holds none: sigma of the four channels, cross-range to the right, range upwards, and over it
/// the target's lines, given by their ends in the mesh's coordinates. Of an image in space the strongest cell along each line of
/// sight and, in further panels, along the other axes, of the stronger co-polar channel. Returns an empty text, or why there is
/// no picture.
std::string plot_isar(const std::filesystem::path& folder, const std::string& title, const IsarImage& image,
                      std::span<const std::array<dvec3, 2>> target_lines);

/// Draws isar_pauli.png likewise, of an image in a plane: one picture of three colours, each over 40 dB below the strongest: red
/// |hh - vv| / sqrt(2), two bounces; green |hv + vh| / sqrt(2), turned dihedrals and edges; blue |hh + vv| / sqrt(2), one bounce
/// or three (Cloude & Pottier, IEEE Trans. GRS-34 (1996), eq. 13).
std::string plot_pauli(const std::filesystem::path& folder, const std::string& title, const IsarImage& image,
                       std::span<const std::array<dvec3, 2>> target_lines);

}  // namespace raytube
