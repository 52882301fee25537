#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings/result.h"
#include "bindings/values.h"
#include "output/compare/comparison_report.h"
#include "output/tables/column_map.h"
#include "output/tables/stored.h"

namespace raytube::python {
