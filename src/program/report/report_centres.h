// Scattering centres that raytube centres has left beside a result.
#pragma once

#include "program/report/report_source.h"

namespace raytube {

/// null where there are none, or others than the result's, which is noted in `source`. Throws InputError for a centres.csv that
/// raytube has not written.
JsonValue report_centres(ReportSource& source);

}  // namespace raytube
