// Targets on their way to other processes.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "bindings/target.h"

namespace raytube::python {

/// All that a target is made of, without what was made ready of it, for pickle.
pybind11::tuple state_of(const TargetSource& target);

std::shared_ptr<TargetSource> target_of_state(const pybind11::tuple& state);

}  // namespace raytube::python
