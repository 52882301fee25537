// Values as bytes, and back, between processes of the same program: every bit of them, in the machine's own order.
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace raytube {

/// Copied byte by byte.
template <class Value>
concept Plain = std::is_trivially_copyable_v<Value>;

/// Lists its members for both ways: members(value, take).
template <class Value>
concept Listed = !Plain<Value> && requires(Value & value) {
  Value::members(value, [](auto&) {});
};

/// Appends them one after the other.
class ByteWriter {
 public:
  explicit ByteWriter(std::size_t expected = 0) { bytes_.reserve(expected); }

  template <Plain Value>
  void operator()(const Value& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <Plain Value>
  void operator()(const std::vector<Value>& values) {
    (*this)(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
  }
  template <class List>
  void operator()(const std::vector<List>& lists) {
    (*this)(lists.size());
    for (const List& list : lists) (*this)(list);
  }
  template <Listed Value>
  void operator()(const Value& value) {
    Value::members(value, *this);
  }
  void operator()(const std::vector<bool>& flags) { (*this)(std::vector<char>(flags.begin(), flags.end())); }
  void operator()(const std::string& text) { (*this)(std::vector<char>(text.begin(), text.end())); }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Takes them off again, in the same order.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <Plain Value>
  void operator()(Value& value) {
    copy(&value, sizeof value);
  }
  template <Plain Value>
  void operator()(std::vector<Value>& values) {
    values.resize(size(sizeof(Value)));
    copy(values.data(), values.size() * sizeof(Value));
  }
  template <class List>
  void operator()(std::vector<List>& lists) {
    lists.resize(size(sizeof(std::size_t)));
    for (List& list : lists) (*this)(list);
  }
  template <Listed Value>
  void operator()(Value& value) {
    Value::members(value, *this);
  }
  void operator()(std::vector<bool>& flags) {
    std::vector<char> bytes;
    (*this)(bytes);
    flags.assign(bytes.begin(), bytes.end());
  }
  void operator()(std::string& text) {
    std::vector<char> bytes;
    (*this)(bytes);
    text.assign(bytes.begin(), bytes.end());
  }

  /// Everything was there, and nothing more.
  bool fits() const { return fits_ && bytes_.empty(); }

 private:
  // The length of a list whose entries take so many bytes each, at least.
  std::size_t size(std::size_t each) {
    std::size_t count = 0;
    (*this)(count);
    if (count > bytes_.size() / each) fits_ = false;
    return fits_ ? count : 0;
  }

  void copy(void* to, std::size_t count) {
    if (count > bytes_.size()) fits_ = false;
    if (!fits_ || count == 0) return;
    std::memcpy(to, bytes_.data(), count);
    bytes_.remove_prefix(count);
  }

  std::string_view bytes_;
  bool fits_ = true;
};

}  // namespace raytube
