#include "io/variables.h"

#include "base/text.h"

#include <fmt/format.h>

#include <cctype>

namespace mlt {
namespace {

/// Limit of a value: defaults of defaults could otherwise need any amount of memory.
constexpr size_t longest_value = size_t{1} << 16;

bool is_name_char(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

size_t end_of_name(const std::string& text, size_t start) {
  while (start < text.size() && is_name_char(text[start])) ++start;
  return start;
}

}  // namespace

Variables::Variables(const std::map<std::string, std::string>& defines) : values_(defines) {
  for (const auto& [name, value] : defines) unused_.insert(name);
}

void Variables::set_default(const std::string& name, const std::string& value) {
  values_.emplace(name, value);
  unused_.erase(name);
  of_scene_.insert(name);
}

std::string Variables::substitute(const std::string& text, const Location& where) {
  if (text.find('$') == std::string::npos) return text;
  std::string out;
  for (size_t i = 0; i < text.size();) {
    if (text[i] == '\\' && text.compare(i, 2, "\\$") == 0) {
      out += '$';
      i += 2;
      continue;
    }
    const size_t end = text[i] == '$' ? end_of_name(text, i + 1) : i;
    if (end <= i + 1) {
      out += text[i++];
      continue;
    }
    std::string name = text.substr(i + 1, end - i - 1);
    while (!name.empty() && !values_.count(name)) name.pop_back();
    if (name.empty()) {
      std::vector<std::string> known;
      for (const auto& [known_name, value] : values_) known.push_back("$" + known_name);
      throw SceneError(
          at(where, "${} has no value; give it one with -D or <default>{}",
             text.substr(i + 1, std::min<size_t>(end - i - 1, 80)),
             known.empty() ? "" : fmt::format("; known are: {}", fmt::join(known, ", "))));
    }
    unused_.erase(name);
    out += values_.at(name);
    i += 1 + name.size();
    if (out.size() > longest_value)
      throw SceneError(
          at(where, "a value made of $names is longer than {} characters", longest_value));
  }
  return out;
}

void Variables::expect_all_used() const {
  if (unused_.empty()) return;
  const std::string& name = *unused_.begin();
  const std::vector<std::string> known(of_scene_.begin(), of_scene_.end());
  throw UsageError("the scene has no parameter " + quote(name) +
                   (known.empty() ? ": it has no <default> at all" : suggestion(name, known)));
}

}  // namespace mlt
