// Typed values of a case file. Each reader throws InputError with the location, what is wrong and what to write instead;
// `key` is the dotted name used in the sentence.
#pragma once

#include <span>

#include "case/text/document.h"
#include "core/field.h"
#include "scene/keys/key.h"

namespace raytube {

/// A finite number, never -0.
double read_number(const CaseValue& value, const std::string& key);
/// The sentence about an angle so large that the numbers beside it lie more than a millionth of a degree apart, so that it points
/// nowhere; empty for others.
std::string unresolved_angle(const std::string& key, double degrees);
/// A number within limits, or a whole one.
double read_in(const CaseValue& value, const std::string& key, const Limits& limits);
int read_whole(const CaseValue& value, const std::string& key, const Limits& limits);
/// true or false.
bool read_flag(const CaseValue& value, const std::string& key);
/// A list of three numbers.
dvec3 read_vector(const CaseValue& value, const std::string& key);
/// One such list, or a list of them.
std::vector<dvec3> read_vectors(const CaseValue& value, const std::string& key);
/// A text in quotes.
std::string read_text(const CaseValue& value, const std::string& key);
/// The place of a text among these words.
std::size_t read_word(const CaseValue& value, const std::string& key, std::span<const std::string_view> words);
/// The name of a file, relative to the case's folder; `what` it holds is for the sentence about an empty one.
std::string read_file_name(const CaseValue& value, const std::string& key, const std::string& what);

/// Metres of the unit of length that the text names: m, cm, mm, um, in, ft.
double read_unit(const CaseValue& value, const std::string& key);

/// How a sentence names the two kinds of ranges.
inline constexpr const char* range_forms = "{ start, stop, step } (or count)";

/// A number, a list of numbers, { start, stop, count } with both ends, or { start, stop, step } with `stop` included when a step
/// lands on it; when none does, a sentence is added to `warnings`.
std::vector<double> read_values(const CaseValue& value, const std::string& key, std::vector<std::string>& warnings);

}  // namespace raytube
