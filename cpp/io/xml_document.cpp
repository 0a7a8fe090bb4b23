#include "io/xml_document.h"

#include "base/error.h"

#include <algorithm>

namespace mlt {
namespace {

/// UTF-16 needs its byte order mark.
pugi::xml_encoding encoding_of(const std::string& text) {
  if (text.compare(0, 2, "\xff\xfe") == 0) return pugi::encoding_utf16_le;
  if (text.compare(0, 2, "\xfe\xff") == 0) return pugi::encoding_utf16_be;
  return pugi::encoding_utf8;
}

/// Where lines end, in the UTF-8 that the parser makes of the text.
std::vector<ptrdiff_t> line_ends(const std::string& text, pugi::xml_encoding encoding) {
  std::vector<ptrdiff_t> ends;
  if (encoding == pugi::encoding_utf8) {
    for (size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') ends.push_back(static_cast<ptrdiff_t>(i));
    return ends;
  }
  const size_t high = encoding == pugi::encoding_utf16_be ? 0 : 1;
  ptrdiff_t offset = 0;
  for (size_t i = 0; i + 1 < text.size(); i += 2) {
    const auto byte = [&](size_t at) { return static_cast<unsigned char>(text[i + at]); };
    const unsigned unit = byte(high) * 256u + byte(1 - high);
    if (unit == '\n') ends.push_back(offset);
    const bool half_of_a_pair = unit >= 0xd800 && unit < 0xe000;
    offset += unit < 0x80 ? 1 : unit < 0x800 || half_of_a_pair ? 2 : 3;
  }
  return ends;
}

}  // namespace

XmlDocument::XmlDocument(const std::string& text, std::string file) : file_(std::move(file)) {
  const pugi::xml_encoding encoding = encoding_of(text);
  line_ends_ = line_ends(text, encoding);
  const unsigned flags = pugi::parse_default | pugi::parse_doctype;
  const pugi::xml_parse_result result =
      document_.load_buffer(text.data(), text.size(), flags, encoding);
  if (!result)
    throw SceneError(at({file_, line(result.offset)},
                        std::string("this is not well-formed XML: ") + result.description()));
  for (const pugi::xml_node& node : document_.children()) {
    if (node.type() == pugi::node_doctype)
      throw SceneError(at({file_, 1}, "a document type (<!DOCTYPE>) is not allowed; remove it"));
    if (node.type() != pugi::node_element) continue;
    if (root_) throw SceneError(at({file_, line(node)}, "there is a second root element"));
    root_ = node;
  }
}

int XmlDocument::line(ptrdiff_t offset) const {
  const auto next = std::lower_bound(line_ends_.begin(), line_ends_.end(), offset);
  return static_cast<int>(next - line_ends_.begin()) + 1;
}

}  // namespace mlt
