#include "case/text/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include "case/text/not_a_case.h"
#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

using Kind = CaseValue::Kind;

constexpr std::string_view override_prefix = "--set ";

// Where a value was written: the override's own text, or a line of the case file.
struct Source {
  std::string name;
  bool has_lines;

  std::string location(const toml::source_region& region) const {
    if (!has_lines || region.begin.line == 0) return name;
    return fmt::format("{}, line {}", name, region.begin.line);
  }
};

CaseValue converted(const toml::node& node, const Source& source);

CaseValue converted_table(const toml::table& table, const Source& source) {
  CaseValue value;
  value.written_inline = table.is_inline();
  for (const auto& [key, item] : table) {
    value.keys.emplace_back(key.str());
    value.items.push_back(converted(item, source));
  }
  return value;
}

CaseValue converted_list(const toml::array& array, const Source& source) {
  CaseValue value;
  value.kind = Kind::list;
  for (const toml::node& item : array) value.items.push_back(converted(item, source));
  return value;
}

CaseValue converted_scalar(const toml::node& node) {
  CaseValue value;
  if (node.is_number()) {
    value.kind = Kind::number;
    value.number = *node.value<double>();
  } else if (node.is_string()) {
    value.kind = Kind::text;
    value.text = *node.value<std::string>();
  } else if (node.is_boolean()) {
    value.kind = Kind::boolean;
    value.boolean = *node.value<bool>();
  } else {
    value.kind = Kind::other;
  }
  return value;
}

CaseValue converted(const toml::node& node, const Source& source) {
  CaseValue value = node.is_table()   ? converted_table(*node.as_table(), source)
                    : node.is_array() ? converted_list(*node.as_array(), source)
                                      : converted_scalar(node);
  value.location = source.location(node.source());
  return value;
}

constexpr std::uintmax_t longest_file = 1 << 24;  // [bytes]
constexpr std::size_t most_parts = 10;            // of a dotted key; those known have three at most

// Line of the first dotted key with more parts, 0 if there is none. The TOML library descends one call for each, and would run
// out of stack.
std::size_t line_of_deep_key(const std::string& text) {
  std::size_t line = 1, dots = 0;
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n')
      ++line, dots = 0, quote = '\0';
    else if (quote == '"' && c == '\\')
      ++i;
    else if (quote)
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '#')
      i = std::min(text.find('\n', i), text.size()) - 1;
    else if (c == '.' && ++dots >= most_parts)
      return line;
    else if (std::string_view(",=[]{}").find(c) != std::string_view::npos)
      dots = 0;
  }
  return 0;
}

std::string text_of_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw InputError(
        fmt::format("{}: no such file; give the path of a case file (TOML){}", file.string(), backslash_remedy(file.string())));
  const bool folder = std::filesystem::is_directory(file, error);
  if (!folder) refuse_mesh_as_case(file);
  if (!folder && !std::filesystem::is_regular_file(file, error))
    throw InputError(fmt::format("{}: is a pipe or a device; copy the case into a file", file.string()));
  if (!folder && std::filesystem::file_size(file, error) > longest_file)
    throw InputError(fmt::format("{}: is larger than any case file; give the path of a case file (TOML)", file.string()));
  std::ifstream stream(file, std::ios::binary);
  if (folder || !stream)
    throw InputError(fmt::format("{}: cannot be read; give the path of a readable case file (TOML)", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

[[noreturn]] void reject_deep_key(const std::string& location) {
  throw InputError(fmt::format("{}: a key of more than {} parts; write section.key", location, most_parts));
}

std::string line_of(const std::string& text, std::size_t line) {
  std::size_t begin = 0;
  for (std::size_t i = 1; i < line && begin < text.size(); ++i) begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
  return text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin);
}

constexpr const char* blanks = " \t\r\v\f";

// True for two numbers with nothing but `mark` and blanks between them; a blank as the mark itself is needed.
bool numbers_with_between(const std::string& line, char mark) {
  for (std::size_t at = line.find_first_of(".0123456789"); at != std::string::npos;
       at = line.find_first_of(".0123456789", at + 1)) {
    std::size_t next = line.find_first_not_of(blanks, at + 1);
    if (mark != ' ' && next != std::string::npos && line[next] == mark)
      next = line.find_first_not_of(blanks, next + 1);
    else if (mark != ' ' || next == at + 1)
      continue;
    if (next != std::string::npos && std::string_view("+-.0123456789").find(line[next]) != std::string_view::npos) return true;
  }
  return false;
}

// True for a backslash that begins no quote and no backslash between double quotes, as in a path of Windows.
bool has_lone_backslash(const std::string& line) {
  for (std::size_t at = line.find('"'); (at = line.find('\\', at)) != std::string::npos; at += 2)
    if (std::string_view("\"\\").find(line[std::min(at + 1, line.size() - 1)]) == std::string_view::npos) return true;
  return false;
}

// What people who come from MATLAB or from Windows write in a line that is no TOML.
std::string_view habit_in_line(const std::string& text, std::size_t number) {
  const std::string line = line_of(text, number);
  const std::size_t last = line.find_last_not_of(blanks);
  if (has_lone_backslash(line)) return "; in a path write / for \\, or put it in 'single quotes'";
  if (line.find('%') < line.find('"')) return "; a comment begins with #";
  if (numbers_with_between(line, ':')) return "; a range is written { start = 0, stop = 90, step = 1 }";
  if (last != std::string::npos && line[last] == ';') return "; a line ends without a semicolon";
  if (numbers_with_between(line, ' ')) return "; numbers of a list have commas between them";
  return "";
}

CaseValue parsed_file(const std::filesystem::path& file) {
  const Source source{file.string(), true};
  const std::string text = text_of_file(file);
  if (is_utf16(text)) throw InputError(fmt::format("{}: is text in UTF-16; save it as UTF-8", source.name));
  if (const std::size_t line = line_of_deep_key(text)) {
    refuse_other_kinds(file, text);
    reject_deep_key(fmt::format("{}, line {}", source.name, line));
  }
  try {
    CaseValue root = converted(toml::parse(text), source);
    root.location = source.name;
    return root;
  } catch (const toml::parse_error& error) {
    refuse_other_kinds(file, text);
    throw InputError(fmt::format("{}: not valid TOML{}; correct this line ({})", source.location(error.source()),
                                 habit_in_line(text, error.source().begin.line), error.description()));
  }
}

// Down to one leaf: neither a comment nor a section, which read well and set nothing.
bool sets_one_value(const CaseValue& root) {
  const CaseValue* value = &root;
  while (value->kind == Kind::table && !value->written_inline) {
    if (value->items.size() != 1) return false;
    value = &value->items.front();
  }
  return true;
}

std::optional<CaseValue> parsed_override(const std::string& text, const Source& source) {
  try {
    CaseValue root = converted(toml::parse(text), source);
    return sets_one_value(root) ? std::optional(std::move(root)) : std::nullopt;
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

// "tubes.mode=uniform" fails as TOML, but its meaning is plain: the dotted key holds a string.
CaseValue override_with_bare_word(const std::string& key, const std::string& word, const Source& source) {
  std::optional<CaseValue> root = parsed_override(key + " = 0", source);
  if (!root)
    throw InputError(fmt::format("{}: \"{}\" is not a dotted key; write for example --set tubes.per_wavelength=20", source.name,
                                 quotable(key)));
  CaseValue* leaf = &*root;
  while (leaf->kind == Kind::table) leaf = &leaf->items.front();
  leaf->kind = Kind::text;
  leaf->text = word;
  return *root;
}

CaseValue override_tree(const std::string& option) {
  const Source source{std::string(override_prefix) + quotable(option), false};
  const std::size_t equals = option.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw InputError(source.name + ": no KEY=VALUE; write for example --set tubes.per_wavelength=20");
  const std::string key = option.substr(0, equals), word = option.substr(equals + 1);
  if (option.find_first_of("\n\r") != std::string::npos)
    throw InputError(source.name + ": holds a line break; write KEY=VALUE in one line, and a --set for each key");
  if (!is_utf8(option)) throw InputError(source.name + ": is not text in UTF-8; write it so");
  if (line_of_deep_key(option)) reject_deep_key(source.name);
  const std::optional<CaseValue> root = parsed_override(key + " = " + word, source);
  return root ? *root : override_with_bare_word(key, word, source);
}

void apply(CaseValue& base, CaseValue&& change) {
  const bool both_tables = base.kind == Kind::table && change.kind == Kind::table && !change.written_inline;
  if (!both_tables) {
    base = std::move(change);
    return;
  }
  for (std::size_t i = 0; i < change.keys.size(); ++i) {
    const auto known = std::find(base.keys.begin(), base.keys.end(), change.keys[i]);
    if (known != base.keys.end()) {
      apply(base.items[known - base.keys.begin()], std::move(change.items[i]));
    } else {
      base.keys.push_back(change.keys[i]);
      base.items.push_back(std::move(change.items[i]));
    }
  }
}

}  // namespace

const CaseValue* CaseValue::find(std::string_view key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[found - keys.begin()];
}

const CaseValue* find(const CaseValue& root, std::string_view dotted) {
  const std::size_t dot = dotted.find('.');
  const CaseValue* table = root.find(dotted.substr(0, dot));
  return table && dot != std::string_view::npos ? table->find(dotted.substr(dot + 1)) : table;
}

const CaseValue& require(const CaseValue& root, std::string_view dotted, std::string_view remedy) {
  if (const CaseValue* value = find(root, dotted)) return *value;
  throw InputError(
      fmt::format("{}: {} is missing; add {} under [{}]", root.location, dotted, remedy, dotted.substr(0, dotted.find('.'))));
}

void reject(const CaseValue& value, const std::string& sentence) { throw InputError(value.location + ": " + sentence); }

void reject(const CaseValue& value, std::initializer_list<const CaseValue*> others, const std::string& sentence) {
  if (!is_override(value.location))
    for (const CaseValue* other : others)
      if (other && is_override(other->location)) reject(*other, sentence);
  reject(value, sentence);
}

bool is_override(std::string_view location) { return location.starts_with(override_prefix); }

CaseValue read_case_document(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  CaseValue root = parsed_file(file);
  for (const std::string& option : overrides) apply(root, override_tree(option));
  return root;
}

}  // namespace raytube
