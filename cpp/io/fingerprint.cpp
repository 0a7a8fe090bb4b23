#include "io/fingerprint.h"

#include "base/rng.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

namespace mlt {
namespace {

/// A chain of bijective mixers: h' = mix(h ^ word), eight bytes at a time.
class Hasher {
 public:
  void word(uint64_t bits) { state_ = mix_bits(state_ ^ bits); }

  void bytes(const char* data, size_t size) {
    word(size);
    for (size_t i = 0; i < size; i += 8) {
      uint64_t bits = 0;
      std::memcpy(&bits, data + i, std::min<size_t>(8, size - i));
      word(bits);
    }
  }
  void add(const std::string& text) { bytes(text.data(), text.size()); }
  void add(bool b) { word(b); }
  void add(int64_t i) { word(static_cast<uint64_t>(i)); }
  void add(double x) {
    uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    word(bits);
  }
  void add(const std::pair<double, double>& sample) {
    add(sample.first);
    add(sample.second);
  }
  void add(std::monostate) {}
  void add(const ObjectPtr&) {}
  template <class Sequence>
  void add(const Sequence& items) {
    for (const auto& item : items) add(item);
  }
  uint64_t result() const { return state_; }

 private:
  uint64_t state_ = 0x6d6c742d7363656eu;
};

uint64_t hash_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError("cannot read " + path);
  Hasher hash;
  std::vector<char> block(size_t{1} << 16);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.bytes(block.data(), static_cast<size_t>(file.gcount()));
  }
  return hash.result();
}

class TreeHasher {
 public:
  void add(const Node& node) {
    for (const std::string* text : {&node.family, &node.type, &node.id, &node.name})
      hash_.add(*text);
    hash_.word(node.properties.size());
    for (const Node::Property& property : node.properties) {
      hash_.add(property.name);
      add(property);
    }
    hash_.word(node.children.size());
    for (const Node& child : node.children) add(child);
  }
  Hasher& hash() { return hash_; }

 private:
  void add(const Node::Property& property) {
    hash_.word(property.value.index());
    const auto* text = std::get_if<std::string>(&property.value);
    std::error_code error;
    if (!text || property.name != "filename" || !std::filesystem::is_regular_file(*text, error))
      return std::visit([&](const auto& content) { hash_.add(content); }, property.value);
    auto known = files_.find(*text);
    if (known == files_.end()) known = files_.emplace(*text, hash_file(*text)).first;
    hash_.word(known->second);
  }

  Hasher hash_;
  std::map<std::string, uint64_t> files_;
};

}  // namespace

uint64_t fingerprint(const Node& root, const std::optional<Vec2i>& size) {
  TreeHasher tree;
  tree.add(root);
  if (size) {
    tree.hash().word(static_cast<uint64_t>(size->x));
    tree.hash().word(static_cast<uint64_t>(size->y));
  }
  return tree.hash().result();
}

}  // namespace mlt
