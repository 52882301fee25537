// Antennas at a finite distance: the [radar] section.
#pragma once

#include "case/data/case.h"
#include "case/text/document.h"

namespace raytube {

/// True if the antennas' positions stand in place of [look] and [receive].
bool has_positions(const CaseValue& root);

/// The look of antennas at two places [m], in the mesh's own coordinates.
Look look_between(const dvec3& transmit, const dvec3& receive);

/// Fills c.radar and c.sweep.looks from radar.position_m and radar.receive_position_m. Throws
/// InputError.
void read_positions(const CaseValue& root, Case& c);

/// Fills the rest of c.radar, c.sweep.radar and the ranges of the looks. Throws InputError.
void read_radar(const CaseValue& root, Case& c);

}  // namespace raytube
