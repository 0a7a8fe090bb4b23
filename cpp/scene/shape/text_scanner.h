// Reads words and numbers from text in memory, and counts its lines.
#pragma once

#include <charconv>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "base/error.h"

namespace mlt {

class TextScanner {
 public:
  TextScanner(std::string_view text, const std::string& name, int first_line = 1)
      : at_(text.data()), end_(text.data() + text.size()), name_(name), line_(first_line) {}

  bool at_end() const { return at_ == end_; }
  int line() const { return line_; }
  const char* position() const { return at_; }
  size_t remaining() const { return static_cast<size_t>(end_ - at_); }

  /// Skips blanks within the line; a backslash before the line's end continues it.
  void skip_blanks() {
    while (at_ != end_ && (is_blank(*at_) || continues_line())) ++at_;
  }
  /// Skips blanks and line ends.
  void skip_space() {
    for (; at_ != end_ && (is_blank(*at_) || *at_ == '\n'); ++at_) line_ += *at_ == '\n';
  }
  /// Whether the rest of the line is empty or a comment; to be called after skip_blanks.
  bool at_line_end() const { return at_ == end_ || *at_ == '\n' || *at_ == '#'; }
  void next_line() {
    const void* newline = at_ == end_ ? nullptr : std::memchr(at_, '\n', remaining());
    at_ = newline ? static_cast<const char*>(newline) + 1 : end_;
    ++line_;
  }

  /// The characters up to the next blank or line end.
  std::string_view word() {
    const char* begin = at_;
    while (at_ != end_ && !is_blank(*at_) && *at_ != '\n') ++at_;
    return {begin, static_cast<size_t>(at_ - begin)};
  }
  /// Whether the next character is `c`, which is then skipped.
  bool accept(char c) {
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }

  /// A number, ended by a blank or line end.
  double real(const char* what) {
    if (at_ != end_ && *at_ == '+') ++at_;
    double value = 0;
    const auto [next, error] = std::from_chars(at_, end_, value);
    if (error == std::errc::invalid_argument || (next != end_ && !is_blank(*next) && *next != '\n'))
      fail_at_word(what);
    if (error == std::errc::result_out_of_range) value = out_of_range_value(at_, next);
    at_ = next;
    return value;
  }
  /// An integer; the characters after it are not checked.
  int64_t integer(const char* what) {
    if (at_ != end_ && *at_ == '+') ++at_;
    int64_t value = 0;
    const auto [next, error] = std::from_chars(at_, end_, value);
    if (error != std::errc()) fail_at_word(what);
    at_ = next;
    return value;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError(at({name_, line_}, message));
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

  bool continues_line() {
    if (*at_ != '\\') return false;
    const char* next = at_ + 1;
    if (next != end_ && *next == '\r') ++next;
    if (next == end_ || *next != '\n') return false;
    at_ = next;
    ++line_;
    return true;
  }

  /// 0 for a number that is too small for a double; infinity, which check_mesh rejects, for others.
  static double out_of_range_value(const char* begin, const char* end) {
    const std::string_view text(begin, static_cast<size_t>(end - begin));
    return text.find("e-") != text.npos || text.find("E-") != text.npos
               ? 0
               : std::numeric_limits<double>::infinity();
  }

  [[noreturn]] void fail_at_word(const char* what) {
    const std::string found(word().substr(0, 40));
    fail(found.empty() ? std::string(what) + " is missing" : "'" + found + "' is not " + what);
  }

  const char* at_;
  const char* end_;
  const std::string& name_;
  int line_;
};

}  // namespace mlt
