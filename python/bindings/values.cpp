#include "bindings/values.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <string_view>

#include "core/error.h"

namespace raytube::python {

namespace py = pybind11;

namespace {

using Kind = CaseValue::Kind;

// Where a value stands. A list that holds itself is deeper than any case.
struct Place {
  const std::string& location;
  std::string key;
  int depth = 0;

  Place below(const std::string& name) const { return {location, key.empty() ? name : key + '.' + name, depth + 1}; }
  Place entry() const { return {location, key, depth + 1}; }
  [[noreturn]] void reject(const std::string& sentence) const {
    throw InputError(fmt::format("{}: {}{}{}", location, key, key.empty() ? "" : ": ", sentence));
  }
};

constexpr int deepest = 16;

CaseValue value_at(const py::handle& value, const Place& place);

// Python texts may hold halves of characters, which no file can.
std::string text_of(const py::handle& text, const Place& place) {
  Py_ssize_t bytes = 0;
  if (const char* utf8 = PyUnicode_AsUTF8AndSize(text.ptr(), &bytes)) return {utf8, static_cast<std::size_t>(bytes)};
  PyErr_Clear();
  place.reject("a text that cannot be written as UTF-8; give whole characters");
}

CaseValue table(const py::dict& entries, const Place& place) {
  CaseValue value;
  for (const auto& [key, entry] : entries) {
    if (entry.is_none()) continue;
    value.keys.push_back(text_of(py::str(key), place));
    value.items.push_back(value_at(entry, place.below(value.keys.back())));
    value.items.back().written_inline = true;
  }
  return value;
}

CaseValue list(const py::handle& sequence, const Place& place) {
  CaseValue value;
  value.kind = Kind::list;
  for (const py::handle entry : py::iter(sequence)) value.items.push_back(value_at(entry, place.entry()));
  return value;
}

// By far the quickest for thousands of angles.
CaseValue list_of_numbers(const py::array_t<double>& numbers, const Place& place) {
  CaseValue value;
  value.kind = Kind::list;
  value.items.resize(static_cast<std::size_t>(numbers.size()));
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    value.items[i].kind = Kind::number;
    value.items[i].location = place.location;
    value.items[i].number = numbers.data()[i];
  }
  return value;
}

// Whatever is no plain list of numbers is told entry by entry what it is: texts, masked entries, tables of numbers.
CaseValue array(const py::array& value, const Place& place) {
  const bool plain = value.ndim() == 1 && std::string_view("iuf").find(value.dtype().kind()) != std::string_view::npos &&
                     !py::hasattr(value, "mask");
  if (plain) return list_of_numbers(py::array_t<double, py::array::c_style | py::array::forcecast>(value), place);
  return value_at(value.attr("tolist")(), place.entry());
}

CaseValue number(const py::handle& value, const Place& place) {
  CaseValue result;
  result.kind = Kind::number;
  result.number = PyFloat_AsDouble(value.ptr());
  if (!PyErr_Occurred()) return result;
  PyErr_Clear();
  place.reject("a number that cannot be held; give one below 1e308");
}

CaseValue text(const py::handle& value, const Place& place) {
  CaseValue result;
  result.kind = Kind::text;
  result.text = text_of(value, place);
  return result;
}

CaseValue truth(const py::handle& value) {
  CaseValue result;
  result.kind = Kind::boolean;
  result.boolean = value.ptr() == Py_True;
  return result;
}

bool is_mapping(const py::handle& value) { return py::isinstance(value, py::module_::import("collections.abc").attr("Mapping")); }

// Labelled arrays (pandas, xarray), NumPy's own scalars, decimals and fractions, paths, mappings.
CaseValue other(const py::handle& value, const Place& place) {
  if (is_mapping(value)) return table(py::dict(py::reinterpret_borrow<py::object>(value)), place);
  if (py::hasattr(value, "__array__")) return array(py::module_::import("numpy").attr("asarray")(value), place);
  if (PyNumber_Check(value.ptr()) && py::hasattr(value, "__float__")) return number(value, place);
  if (py::hasattr(value, "__fspath__")) return text(py::module_::import("os").attr("fsdecode")(value), place);
  place.reject(
      fmt::format("a value of the type {} is nothing that a case can hold; give numbers, texts, lists and dictionaries of these",
                  Py_TYPE(value.ptr())->tp_name));
}

CaseValue any(const py::handle& value, const Place& place) {
  if (place.depth > deepest) place.reject("nested too deeply; does it hold itself?");
  if (PyDict_Check(value.ptr())) return table(py::reinterpret_borrow<py::dict>(value), place);
  if (PyBool_Check(value.ptr())) return truth(value);
  if (PyUnicode_Check(value.ptr())) return text(value, place);
  if (PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr())) return number(value, place);
  if (py::isinstance<py::array>(value)) return array(py::reinterpret_borrow<py::array>(value), place);
  if (PyList_Check(value.ptr()) || PyTuple_Check(value.ptr()) || PyRange_Check(value.ptr())) return list(value, place);
  return other(value, place);
}

CaseValue value_at(const py::handle& value, const Place& place) {
  CaseValue result = any(value, place);
  result.location = place.location;
  return result;
}

}  // namespace

CaseValue case_value(const py::handle& value, const std::string& location) { return value_at(value, {location, ""}); }

py::object python_value(const Json& json) { return py::module_::import("json").attr("loads")(text_of_json(json)); }

py::str python_text(std::string_view text) {
  PyObject* decoded = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace");
  if (!decoded) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

py::list python_texts(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts) list.append(python_text(text));
  return list;
}

}  // namespace raytube::python
