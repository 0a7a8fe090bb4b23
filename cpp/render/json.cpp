#include "render/json.h"

#include <fmt/format.h>

#include <cmath>

namespace mlt {
namespace {

struct Writer {
  std::string operator()(std::monostate) const { return "null"; }
  std::string operator()(const ObjectPtr&) const { return "null"; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const {
    return std::isfinite(value) ? fmt::format("{}", value) : "null";
  }
  std::string operator()(const std::string& text) const { return json_string(text); }
  std::string operator()(const std::pair<double, double>& sample) const {
    return "[" + (*this)(sample.first) + ", " + (*this)(sample.second) + "]";
  }
  template <class Sequence>
  std::string operator()(const Sequence& sequence) const {
    std::string list;
    for (const auto& item : sequence) list += (list.empty() ? "" : ", ") + (*this)(item);
    return "[" + list + "]";
  }
};

}  // namespace

std::string json_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<int>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string json_value(const Value& value) { return std::visit(Writer{}, value); }

void Json::add_text(const std::string& name, const std::string& value) {
  members_ += (members_.empty() ? "" : ", ") + json_string(name) + ": " + value;
}

}  // namespace mlt
