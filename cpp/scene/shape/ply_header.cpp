#include "scene/shape/ply_header.h"

#include <algorithm>

#include "scene/shape/text_scanner.h"

namespace mlt {
namespace {

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name)
      : text_(bytes, name), begin_(bytes.data()) {}

  PlyHeader read() {
    if (word() != "ply") text_.fail("not a PLY file: it does not begin with 'ply'");
    end_line();
    while (read_line()) {
    }
    if (!has_format_) text_.fail("the PLY header has no 'format' line");
    header_.size = static_cast<size_t>(text_.position() - begin_);
    header_.lines = text_.line() - 1;
    return std::move(header_);
  }

 private:
  /// Reads one line; false after "end_header".
  bool read_line() {
    if (text_.at_end()) text_.fail("the PLY header does not end ('end_header' is missing)");
    const std::string_view keyword = word();
    if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) {
      text_.next_line();
      return true;
    }
    if (keyword == "format") {
      read_format();
    } else if (keyword == "element") {
      read_element();
    } else if (keyword == "property") {
      read_property();
    } else if (keyword != "end_header") {
      text_.fail("unknown line '" + shortened(keyword) + "' in the PLY header");
    }
    end_line();
    return keyword != "end_header";
  }

  void read_format() {
    const std::string format = shortened(word()), version = shortened(word());
    if (format == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (format == "binary_little_endian") {
      header_.format = PlyFormat::little_endian;
    } else if (format == "binary_big_endian") {
      header_.format = PlyFormat::big_endian;
    } else {
      text_.fail("unknown PLY format '" + format +
                 "'; valid are: ascii, binary_little_endian, binary_big_endian");
    }
    if (version != "1.0") text_.fail("unknown PLY version '" + version + "'; 1.0 is known");
    has_format_ = true;
  }

  void read_element() {
    PlyElement element;
    element.name = shortened(word());
    text_.skip_blanks();
    const int64_t count = text_.integer("a count");
    if (count < 0) text_.fail("a negative count of '" + element.name + "'");
    element.count = static_cast<uint64_t>(count);
    header_.elements.push_back(std::move(element));
  }

  void read_property() {
    if (header_.elements.empty()) text_.fail("a property before the first element");
    PlyProperty property;
    std::string_view type = word();
    if (type == "list") {
      property.list = true;
      property.count_type = type_named(word());
      if (!is_integer(property.count_type)) text_.fail("the length of a list must be an integer");
      type = word();
    }
    property.type = type_named(type);
    property.name = shortened(word());
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType type_named(std::string_view name) {
    static constexpr std::pair<std::string_view, PlyType> names[] = {
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    for (const auto& [known, type] : names)
      if (known == name) return type;
    text_.fail("unknown PLY type '" + shortened(name) + "'");
  }

  std::string_view word() {
    text_.skip_blanks();
    return text_.word();
  }
  static std::string shortened(std::string_view word) { return std::string(word.substr(0, 40)); }

  void end_line() {
    const std::string_view rest = word();
    if (!rest.empty()) text_.fail("'" + shortened(rest) + "' is too much on this line");
    text_.next_line();
  }

  TextScanner text_;
  const char* begin_;
  PlyHeader header_{};
  bool has_format_ = false;
};

}  // namespace

size_t size_of(PlyType type) {
  static constexpr size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<size_t>(type)];
}

int PlyElement::find(std::initializer_list<const char*> names) const {
  for (const char* wanted : names)
    for (size_t i = 0; i < properties.size(); ++i)
      if (properties[i].name == wanted) return static_cast<int>(i);
  return -1;
}

size_t PlyElement::least_size() const {
  size_t size = 0;
  for (const PlyProperty& p : properties) size += size_of(p.list ? p.count_type : p.type);
  return size;
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  return HeaderReader(bytes, name).read();
}

}  // namespace mlt
