#include "io/xml_document.h"

#include "base/error.h"

#include <algorithm>

namespace mlt {

XmlDocument::XmlDocument(const std::string& text, std::string file) : file_(std::move(file)) {
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') line_ends_.push_back(static_cast<ptrdiff_t>(i));

  const unsigned flags = pugi::parse_default | pugi::parse_doctype;
  const pugi::xml_parse_result result =
      document_.load_buffer(text.data(), text.size(), flags, pugi::encoding_utf8);
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
