// A run that is finished already.
#pragma once

#include "program/run/prepared_run.h"
#include "program/run/result_names.h"

namespace raytube {

/// True if the folder holds all results of this run. Throws InputError if it holds those of a finished run of another case.
bool is_finished(const Request& request, const PreparedRun& prepared, const Destination& destination);

}  // namespace raytube
