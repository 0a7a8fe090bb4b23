#include "io/load.h"
#include "io/text.h"
#include "io/values.h"

namespace mlt {
namespace {

/// The XML element that would write a value of this type.
std::string tag_of(ParamType type) {
  switch (type) {
    case ParamType::boolean: return "boolean";
    case ParamType::integer: return "integer";
    case ParamType::real: return "float";
    case ParamType::text:
    case ParamType::ior: return "string";
    case ParamType::point: return "point";
    case ParamType::reflectance:
    case ParamType::radiance:
    case ParamType::texture:
    case ParamType::emission: return "spectrum";
    case ParamType::transform:
    case ParamType::object: break;
  }
  return "";
}

std::optional<Value> parse(const std::string& text, const std::string& tag) {
  const auto as_value = [](const auto& parsed) {
    return parsed ? std::optional<Value>(*parsed) : std::nullopt;
  };
  if (tag == "boolean") return as_value(parse_boolean(text));
  if (tag == "integer") return as_value(parse_integer(text));
  if (tag == "float") return as_value(parse_real(text));
  if (tag == "string") return Value(text);
  if (tag == "spectrum") return parse_color(text);
  return as_value(parse_triple(text));
}

}  // namespace

Value parse_value(const std::string& text, const Parameter& parameter) {
  if (parameter.type == ParamType::ior)
    if (const auto number = parse_real(text)) return *number;
  const std::string tag = tag_of(parameter.type);
  if (tag.empty())
    throw UsageError("'" + parameter.name + "' is a " + to_string(parameter.type) +
                     ", which cannot be written as one value; give it in the scene");
  if (auto value = parse(text, tag)) return std::move(*value);
  throw UsageError("'" + parameter.name + "' is " + quote(text) + ", but should be " +
                   example_of(tag));
}

}  // namespace mlt
