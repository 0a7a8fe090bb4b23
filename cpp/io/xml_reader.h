// From Mitsuba XML, either dialect, to a tree of nodes.
#pragma once

#include "io/element.h"
#include "io/load.h"
#include "io/search_path.h"
#include "io/variables.h"
#include "io/xml_document.h"

#include <optional>
#include <string>
#include <vector>

namespace mlt {

class XmlReader {
 public:
  XmlReader(const LoadOptions& options, std::vector<std::string>& warnings);

  Node read_file(const std::string& path);
  Node read_string(const std::string& xml, const std::string& directory);

 private:
  /// What is being read, and where the files that it names are looked for.
  struct Source {
    const XmlDocument& document;
    SearchPath search;
    /// Is a <spectrum> of one number the same power at all wavelengths, and not grey? It is since
    /// Mitsuba 2, and differs for what emits.
    bool spectral;
  };

  Node read_document(const XmlDocument& document, const std::string& directory);
  Element element(const pugi::xml_node& node, const Source& source);
  Node read_plugin(const pugi::xml_node& node, const Element& element, Source& source, int depth);
  void read_children(const pugi::xml_node& node, Node& parent, Source& source, int depth);
  void read_child(const pugi::xml_node& node, Node& parent, Source& source, int depth);
  void read_property(const Element& element, Node& parent, const Source& source);
  void read_transform_property(const pugi::xml_node& node, const Element& element, Node& parent,
                               const Source& source);
  void read_include(const Element& element, Node& parent, const Source& source, int depth);
  void skip_foreign(const Element& element, const Node& parent);
  void resolve_aliases(Node& root) const;

  struct Alias {
    std::string id;
    Location where;
  };

  Variables variables_;
  std::vector<std::string>& warnings_;
  std::vector<std::string> open_files_;  ///< Each includes the next.
  int include_count_ = 0;
  std::map<std::string, Alias> aliases_;  ///< By the new name.
};

}  // namespace mlt
