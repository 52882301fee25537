// Text of unknown origin: how files may begin, and how it is quoted in a sentence.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace raytube {

/// Begins a text file of some editors; says nothing in UTF-8.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// True if the text begins with a byte order mark of UTF-16: two bytes a character, which nothing here reads.
constexpr bool is_utf16(std::string_view text) { return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"); }

/// True if every byte belongs to a character of UTF-8.
bool is_utf8(std::string_view text);

/// The text with capitals made small (ASCII).
std::string lower_case(std::string_view text);

/// Behind a sentence about a file that is not there: what is wrong with a path as Windows writes it; empty for others.
std::string_view backslash_remedy(std::string_view path);

/// The text as a sentence can quote it: of long ones the beginning, and '?' for what is no printable character.
std::string quotable(std::string_view text);

/// The texts one after the other, with `between` between two of them.
std::string joined(std::span<const std::string_view> texts, std::string_view between);
std::string joined(std::span<const std::string> texts, std::string_view between);

}  // namespace raytube
