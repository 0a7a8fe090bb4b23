// A parsed XML text, with the line of each element.
#pragma once

#include <pugixml.hpp>

#include <string>
#include <vector>

namespace mlt {

class XmlDocument {
 public:
  /// `file` is its name in messages. Throws SceneError if the text is not well-formed, has other
  /// than one root element, or a document type (entities could expand without end).
  XmlDocument(const std::string& text, std::string file);

  pugi::xml_node root() const { return root_; }
  const std::string& file() const { return file_; }
  int line(const pugi::xml_node& node) const { return line(node.offset_debug()); }

 private:
  int line(ptrdiff_t offset) const;

  std::string file_;
  std::vector<ptrdiff_t> line_ends_;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

}  // namespace mlt
