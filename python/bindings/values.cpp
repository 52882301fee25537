#include "bindings/values.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "core/error.h"

namespace raytube::python {

namespace py = pybind11;

namespace {

using Kind = CaseValue::Kind;

CaseValue table(const py::dict& entries, const std::string& location) {
  CaseValue value;
  for (const auto& [key, entry] : entries) {
    if (entry.is_none()) continue;
    value.keys.push_back(py::str(key));
    value.items.push_back(case_value(entry, location));
    value.items.back().written_inline = true;
  }
  return value;
}

CaseValue list(const py::handle& sequence, const std::string& location) {
  CaseValue value;
  value.kind = Kind::list;
  for (const py::handle entry : py::iter(sequence)) value.items.push_back(case_value(entry, location));
  return value;
}

// By far the quickest for thousands of angles.
CaseValue list_of_numbers(const py::array_t<double>& numbers, const std::string& location) {
  CaseValue value;
  value.kind = Kind::list;
  value.items.resize(static_cast<std::size_t>(numbers.size()));
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    value.items[i].kind = Kind::number;
    value.items[i].location = location;
    value.items[i].number = numbers.data()[i];
  }
  return value;
}

bool is_array(const py::handle& value) { return py::isinstance<py::array>(value); }

CaseValue array(const py::handle& value, const std::string& location) {
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!numbers) {
    PyErr_Clear();
    throw InputError(fmt::format("{}: an array that holds no numbers; give numbers", location));
  }
  if (numbers.ndim() == 1) return list_of_numbers(numbers, location);
  return numbers.ndim() == 0 ? case_value(value.attr("item")(), location) : list(value, location);
}

CaseValue scalar(const py::handle& value, const std::string& location) {
  CaseValue result;
  if (py::isinstance<py::bool_>(value)) {
    result.kind = Kind::boolean;
    result.boolean = value.cast<bool>();
  } else if (py::isinstance<py::str>(value)) {
    result.kind = Kind::text;
    result.text = value.cast<std::string>();
  } else if (PyNumber_Check(value.ptr()) && py::hasattr(value, "__float__")) {
    result.kind = Kind::number;
    result.number = py::float_(py::reinterpret_borrow<py::object>(value));
  } else if (py::hasattr(value, "__fspath__")) {
    result.kind = Kind::text;
    result.text = py::str(value.attr("__fspath__")());
  } else {
    throw InputError(fmt::format("{}: {} is nothing that a case can hold; give numbers, texts, lists and dictionaries of these",
                                 location, py::repr(value).cast<std::string>()));
  }
  return result;
}

CaseValue any(const py::handle& value, const std::string& location) {
  if (py::isinstance<py::dict>(value)) return table(py::reinterpret_borrow<py::dict>(value), location);
  if (is_array(value)) return array(value, location);
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value) || PyRange_Check(value.ptr()))
    return list(value, location);
  return scalar(value, location);
}

py::object python_table(const JsonValue& json) {
  py::dict table;
  for (std::size_t i = 0; i < json.names.size(); ++i) table[py::str(json.names[i])] = python_value(json.items[i]);
  return table;
}

py::object python_list(const JsonValue& json) {
  py::list list;
  for (const JsonValue& item : json.items) list.append(python_value(item));
  return list;
}

}  // namespace

CaseValue case_value(const py::handle& value, const std::string& location) {
  CaseValue result = any(value, location);
  result.location = location;
  return result;
}

py::object python_value(const JsonValue& json) {
  switch (json.kind) {
    case JsonValue::Kind::boolean:
      return py::bool_(json.boolean);
    case JsonValue::Kind::whole:
      return py::int_(json.whole);
    case JsonValue::Kind::number:
      return py::float_(json.number);
    case JsonValue::Kind::text:
      return py::str(json.text);
    case JsonValue::Kind::list:
      return python_list(json);
    case JsonValue::Kind::table:
      return python_table(json);
    default:
      return py::none();
  }
}

}  // namespace raytube::python
