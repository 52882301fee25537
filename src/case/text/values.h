// Typed values of a case file. Each reader throws InputError with the location, what is wrong and what to write instead;
// `key` is the dotted name used in the sentence.
#pragma once

#include "case/text/document.h"
#include "core/field.h"

namespace raytube {

/// Nothing of a case may lie farther from the origin [m].
inline constexpr double farthest = 1e12;

/// A finite number, never -0.
double read_number(const CaseValue& value, const std::string& key);
/// A number greater than 0.
double read_positive(const CaseValue& value, const std::string& key);
/// A whole number from `least` to `most`.
int read_whole(const CaseValue& value, const std::string& key, int least, int most);
/// true or false.
bool read_flag(const CaseValue& value, const std::string& key);
/// A list of three numbers.
dvec3 read_vector(const CaseValue& value, const std::string& key);
/// One such list, or a list of them.
std::vector<dvec3> read_vectors(const CaseValue& value, const std::string& key);
/// A text in quotes.
std::string read_text(const CaseValue& value, const std::string& key);

/// Metres of the unit of length that the text names: m, cm, mm, um, in, ft.
double read_unit(const CaseValue& value, const std::string& key);

/// A number, a list of numbers, or { start, stop, step } with `stop` included when a step lands on it.
std::vector<double> read_stepped(const CaseValue& value, const std::string& key);

/// A number, a list of numbers, or { start, stop, count }, both ends included.
std::vector<double> read_counted(const CaseValue& value, const std::string& key);

}  // namespace raytube
