// Writing JSON: settings in image headers, `info`, and stats.json.
#pragma once

#include "base/schema.h"
#include "rendering/stats.h"

#include <string>

namespace mlt {

/// The text with quotes, and with characters escaped that JSON does not allow in a string.
/// Bytes that are no UTF-8, as file names may have them, become lone surrogates, as in Python.
std::string json_string(const std::string& text);

/// Numbers in the shortest form that reads back as the same number; "null" for values that JSON
/// lacks (NaN, infinity, a nested object that is only known as a pointer).
std::string json_value(const Value& value);

/// An object, member by member, on one line.
class Json {
 public:
  void add(const std::string& name, const Value& value) { add_text(name, json_value(value)); }
  void add(const std::string& name, const Json& object) { add_text(name, object.text()); }
  std::string text() const { return "{" + members_ + "}"; }

 private:
  void add_text(const std::string& name, const std::string& value);

  std::string members_;
};

/// The text of stats.json.
std::string to_json(const Stats& stats);

}  // namespace mlt
