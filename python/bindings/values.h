// Python values as those of a case file, and JSON as Python values.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <vector>

#include "case/text/document.h"
#include "core/ordered_json.h"

namespace raytube::python {

/// Numbers, texts, truth values, and dictionaries and sequences (also NumPy arrays) of these; entries that are None are left out.
/// `location` is where sentences say that the values stand. Throws InputError for anything else.
CaseValue case_value(const pybind11::handle& value, const std::string& location);

pybind11::object python_value(const Json& json);

/// Names of files and of parts may be bytes that are no UTF-8; these become \xff and the like.
pybind11::str python_text(std::string_view text);
pybind11::list python_texts(const std::vector<std::string>& texts);

}  // namespace raytube::python
