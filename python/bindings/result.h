// Results as Python holds them: arrays without a copy.
#pragma once

#include <pybind11/pybind11.h>

namespace raytube::python {

/// StoredResult as the class `Stored`: arrays of the shape [look, frequency, receive, transmit].
void bind_stored(pybind11::module_& module);

/// range_profiles, isar: of a result; outline: what a target looks like in them.
void bind_products(pybind11::module_& module);

/// traced_target, look_in_space, tubes, error_sentences, isar_cells: what a report shows beside the rows of a result.
void bind_report(pybind11::module_& module);

/// compare: two results as Comparison.
void bind_comparison(pybind11::module_& module);

}  // namespace raytube::python
