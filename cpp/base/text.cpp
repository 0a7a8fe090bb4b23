#include "base/text.h"

#include "base/error.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace mlt {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_separator(char c) { return is_space(c) || c == ','; }

/// Removes a leading plus sign, which std::from_chars does not accept.
std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

}  // namespace

std::string quote(std::string_view text) {
  constexpr size_t longest = 80;
  return "'" + on_one_line(text.substr(0, longest)) + (text.size() > longest ? "...'" : "'");
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> words;
  size_t i = 0;
  while (i < text.size()) {
    while (i < text.size() && is_separator(text[i])) ++i;
    const size_t start = i;
    while (i < text.size() && !is_separator(text[i])) ++i;
    if (i > start) words.push_back(text.substr(start, i - start));
  }
  return words;
}

std::optional<double> parse_real(std::string_view text) {
  text = without_plus(trim(text));
  // The wider type tells a number too small for a double, which is 0, from one too large.
  long double wide = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), wide);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(static_cast<double>(wide))) return std::nullopt;
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::optional<int64_t> parse_integer(std::string_view text) {
  text = without_plus(trim(text));
  int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<bool> parse_boolean(std::string_view text) {
  std::string lower(trim(text));
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (lower == "true") return true;
  if (lower == "false") return false;
  return std::nullopt;
}

std::optional<std::vector<double>> parse_reals(std::string_view text) {
  std::vector<double> numbers;
  for (std::string_view word : split(text)) {
    const std::optional<double> number = parse_real(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<std::array<double, 3>> parse_triple(std::string_view text) {
  const auto numbers = parse_reals(text);
  if (!numbers || numbers->size() != 3) return std::nullopt;
  return std::array<double, 3>{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

}  // namespace mlt
