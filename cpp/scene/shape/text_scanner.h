// Reads words and numbers from text in memory, and counts its lines.
#pragma once

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>

#include "base/error.h"

namespace mlt {

class TextScanner {
 public:
  TextScanner(std::string_view text, const std::string& name, int first_line = 1)
      : at_(text.data()), end_(text.data() + text.size()), name_(name), line_(first_line) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text.substr(0, 3) == byte_order_mark) at_ += 3;
    // Lines end with carriage returns alone if the first one does.
    const size_t end = std::min(text.find('\n'), text.size()), cr = text.substr(0, end).find('\r');
    if (text.substr(0, end).find_first_not_of('\r', cr) != text.npos) line_end_ = '\r';
  }

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
    for (; at_ != end_ && (is_blank(*at_) || ends_line(*at_)); ++at_) line_ += ends_line(*at_);
  }
  /// Whether the rest of the line is empty or a comment; to be called after skip_blanks.
  bool at_line_end() const { return at_ == end_ || ends_line(*at_) || *at_ == '#'; }
  void next_line() {
    at_ = std::find_if(at_, end_, [&](char c) { return ends_line(c); });
    if (at_ != end_) ++at_;
    ++line_;
  }

  /// The characters up to the next blank or line end.
  std::string_view word() {
    const char* begin = at_;
    while (!at_word_end()) ++at_;
    return {begin, static_cast<size_t>(at_ - begin)};
  }
  /// The characters up to the line's end, without blanks around them.
  std::string rest_of_line() const {
    const char* end = std::find_if(at_, end_, [&](char c) { return ends_line(c); });
    while (end != at_ && is_blank(end[-1])) --end;
    return {std::find_if(at_, end, [&](char c) { return !is_blank(c); }), end};
  }
  bool at_word_end() const { return at_ == end_ || is_blank(*at_) || ends_line(*at_); }
  bool is_at(char c) const { return at_ != end_ && *at_ == c; }
  /// Whether the next character is `c`, which is then skipped.
  bool accept(char c) {
    if (!is_at(c)) return false;
    ++at_;
    return true;
  }

  /// A number, ended by a blank or line end.
  double real(const char* what) {
    if (at_ != end_ && *at_ == '+') ++at_;
    double value = 0;
    const auto [next, error] = std::from_chars(at_, end_, value);
    if (error == std::errc::invalid_argument ||
        (next != end_ && !is_blank(*next) && !ends_line(*next)))
      fail_at_word(what);
    if (error == std::errc::result_out_of_range) value = out_of_range_value(at_, next);
    at_ = next;
    return value;
  }
  /// A number as real() reads it, or NaN for what Microsoft's C library prints in place of one,
  /// such as -1.#IND.
  double real_or_nan(const char* what) {
    const std::string_view rest(at_, remaining());
    if (rest.substr(is_at('-') || is_at('+'), 3) != "1.#") return real(what);
    word();
    return std::numeric_limits<double>::quiet_NaN();
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
  bool ends_line(char c) const { return c == '\n' || c == line_end_; }
  bool is_blank(char c) const { return c == ' ' || c == '\t' || (c == '\r' && line_end_ != '\r'); }

  bool continues_line() {
    if (*at_ != '\\') return false;
    const char* next = at_ + 1;
    if (next != end_ && is_blank(*next) && *next == '\r') ++next;
    if (next == end_ || !ends_line(*next)) return false;
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
  char line_end_ = '\n';
};

}  // namespace mlt
