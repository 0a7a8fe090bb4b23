#include "io/values.h"

#include "base/atomic_file.h"
#include "base/text.h"
#include "image/srgb.h"

#include <charconv>
#include <map>
#include <sstream>

namespace mlt {
namespace {

const std::map<std::string, std::string>& examples() {
  static const std::map<std::string, std::string> table{
      {"float", "a number such as 0.5"},
      {"integer", "a whole number such as 8"},
      {"boolean", "true or false"},
      {"string", "a text"},
      {"point", "three numbers such as 0, 1, 2"},
      {"vector", "three numbers such as 0, 1, 2"},
      {"rgb", "one number, three, or #rrggbb"},
      {"srgb", "one number, three, or #rrggbb"},
      {"spectrum", "one number, three (RGB), or pairs such as 400:0.1, 700:0.3 by wavelength"}};
  return table;
}

/// Three numbers, or one for all three.
std::optional<Triple> parse_one_or_three(const std::string& text) {
  const auto numbers = parse_reals(text);
  if (numbers && numbers->size() == 1) return Triple{(*numbers)[0], (*numbers)[0], (*numbers)[0]};
  return parse_triple(text);
}

Triple decode_srgb(const Triple& encoded) {
  return {srgb_to_linear(encoded[0]), srgb_to_linear(encoded[1]), srgb_to_linear(encoded[2])};
}

/// #rrggbb, linear.
std::optional<Triple> parse_hex(std::string_view text) {
  text = trim(text);
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  unsigned bits = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, bits, 16);
  if (error != std::errc() || end != text.data() + 7) return std::nullopt;
  return decode_srgb({(bits >> 16) / 255.0, (bits >> 8 & 255) / 255.0, (bits & 255) / 255.0});
}

std::optional<WavelengthTable> checked(WavelengthTable samples) {
  if (samples.size() < 2) return std::nullopt;
  for (size_t i = 1; i < samples.size(); ++i)
    if (!(samples[i - 1].first < samples[i].first)) return std::nullopt;
  return samples;
}

/// Samples (wavelength, value) from "400:0.1, 700:0.3": two or more, wavelengths increasing.
std::optional<WavelengthTable> parse_spectrum(const std::string& text) {
  WavelengthTable samples;
  for (std::string_view word : split(text)) {
    const size_t colon = word.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const auto wavelength = parse_real(word.substr(0, colon));
    const auto value = parse_real(word.substr(colon + 1));
    if (!wavelength || !value) return std::nullopt;
    samples.emplace_back(*wavelength, *value);
  }
  return checked(std::move(samples));
}

/// The value of the text of an element with this tag.
std::optional<Value> parse_as(const std::string& tag, const std::string& text) {
  const auto as_value = [](const auto& parsed) {
    return parsed ? std::optional<Value>(*parsed) : std::nullopt;
  };
  if (tag == "boolean") return as_value(parse_boolean(text));
  if (tag == "integer") return as_value(parse_integer(text));
  if (tag == "float") return as_value(parse_real(text));
  if (tag == "string") return Value(text);
  if (tag == "point" || tag == "vector") return as_value(parse_triple(text));
  if (tag == "spectrum" && text.find(':') != std::string::npos)
    return as_value(parse_spectrum(text));
  if (const auto number = parse_real(text); number && tag == "spectrum") return Value(*number);
  if (const auto linear = parse_hex(text)) return Value(*linear);
  const auto triple = parse_one_or_three(text);
  return as_value(triple && tag == "srgb" ? decode_srgb(*triple) : triple);
}

Value read_as_value(const Element& element) {
  const std::string& text = element.require("value");
  if (auto value = parse_as(element.tag, text)) return *std::move(value);
  element.fail("is " + quote(text) + ", but should be " + examples().at(element.tag));
}

/// The tag of the XML element for a value of this type.
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
    case ParamType::lamp:
    case ParamType::texture:
    case ParamType::emission:
    case ParamType::volume: return "spectrum";
    case ParamType::transform:
    case ParamType::motion:
    case ParamType::buffer:
    case ParamType::object: break;
  }
  return "";
}

/// The text without a byte order mark, its lines ended by newlines, with a carriage return or not.
std::string with_newlines(std::istream& file) {
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\r' && text.compare(i + 1, 1, "\n") != 0) text[i] = '\n';
  return text;
}

WavelengthTable read_spectrum_file(const Element& element, const SearchPath& search) {
  const std::string path = search.find_file(element.require("filename"), element.where);
  std::istringstream file(read_file(path, uint64_t{1} << 28));
  return read_spectrum_table(file, path);
}

Value read_spectrum(const Element& element, const SearchPath& search) {
  element.expect_only({"name", "value", "filename"});
  if (element.find("filename")) {
    if (element.find("value"))
      element.fail("has both a 'value' and a 'filename'; give one of them");
    return read_spectrum_file(element, search);
  }
  return read_as_value(element);
}

}  // namespace

WavelengthTable read_spectrum_table(std::istream& file, const std::string& path) {
  WavelengthTable samples;
  std::string line;
  std::istringstream lines(with_newlines(file));
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string_view content = trim(std::string_view(line).substr(0, line.find('#')));
    if (content.empty()) continue;
    const auto numbers = parse_reals(content);
    if (!numbers || numbers->size() != 2)
      throw SceneError(at({path, number}, quote(content) + " should be a wavelength and a value"));
    samples.emplace_back((*numbers)[0], (*numbers)[1]);
  }
  if (samples.empty()) throw SceneError(at({path, 0}, "the file of a spectrum is empty"));
  const auto result = checked(std::move(samples));
  if (!result)
    throw SceneError(
        at({path, 0}, "a spectrum needs two or more wavelengths, in increasing order"));
  return *result;
}

bool is_value_tag(const std::string& tag) { return examples().count(tag) > 0; }

Triple read_triple(const Element& element, double missing) {
  static const char* axes[] = {"x", "y", "z"};
  if (const std::string* text = element.find("value")) {
    for (const char* axis : axes)
      if (element.find(axis)) element.fail(std::string("has both 'value' and '") + axis + "'");
    const auto triple = parse_one_or_three(*text);
    if (!triple)
      element.fail("is " + quote(*text) + ", but should be three numbers such as 0, 1, 2");
    return *triple;
  }
  Triple triple{missing, missing, missing};
  bool any = false;
  for (size_t i = 0; i < 3; ++i)
    if (const std::string* text = element.find(axes[i])) {
      const auto number = parse_real(*text);
      if (!number)
        element.fail(std::string("has ") + axes[i] + " = " + quote(*text) +
                     ", but it should be a number such as 0.5");
      triple[i] = *number;
      any = true;
    }
  if (!any) element.fail("needs 'x', 'y' and 'z', or 'value' with three numbers");
  return triple;
}

Value read_value(const Element& element, const SearchPath& search) {
  const std::string& tag = element.tag;
  if (tag == "spectrum") return read_spectrum(element, search);
  if (tag == "point" || tag == "vector") {
    element.expect_only({"name", "value", "x", "y", "z"});
    return read_triple(element, 0);
  }
  element.expect_only({"name", "value"});
  if (tag != "string") return read_as_value(element);
  if (!element.find("value")) element.require("value");
  return element.get("value");
}

Value parse_value(const std::string& text, const Parameter& parameter) {
  if (parameter.type == ParamType::ior)
    if (const auto number = parse_real(text)) return *number;
  const std::string tag = tag_of(parameter.type);
  if (tag.empty())
    throw UsageError("'" + parameter.name + "' is a " + to_string(parameter.type) +
                     ", which cannot be written as one value; give it in the scene");
  if (auto value = parse_as(tag, text)) return std::move(*value);
  throw UsageError("'" + parameter.name + "' is " + quote(text) + ", but should be " +
                   examples().at(tag));
}

}  // namespace mlt
