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
  void text(const std::string& text) { bytes(text.data(), text.size()); }
  void real(double x) {
    uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    word(bits);
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
    hash_.text(node.family);
    hash_.text(node.type);
    hash_.text(node.id);
    hash_.text(node.name);
    hash_.word(node.properties.size());
    for (const Node::Property& property : node.properties) {
      hash_.text(property.name);
      add(property);
    }
    hash_.word(node.children.size());
    for (const Node& child : node.children) add(child);
  }
  Hasher& hash() { return hash_; }

 private:
  void add(const Node::Property& property) {
    const Value& value = property.value;
    hash_.word(value.index());
    if (const auto* b = std::get_if<bool>(&value)) hash_.word(*b);
    if (const auto* i = std::get_if<int64_t>(&value)) hash_.word(static_cast<uint64_t>(*i));
    if (const auto* x = std::get_if<double>(&value)) hash_.real(*x);
    if (const auto* t = std::get_if<Triple>(&value))
      for (double x : *t) hash_.real(x);
    if (const auto* m = std::get_if<Matrix>(&value))
      for (double x : *m) hash_.real(x);
    if (const auto* s = std::get_if<Spectrum>(&value))
      for (const auto& [wavelength, x] : *s) {
        hash_.real(wavelength);
        hash_.real(x);
      }
    if (const auto* text = std::get_if<std::string>(&value)) add_text(property.name, *text);
  }

  void add_text(const std::string& name, const std::string& text) {
    std::error_code error;
    if (name != "filename" || !std::filesystem::is_regular_file(text, error))
      return hash_.text(text);
    auto known = files_.find(text);
    if (known == files_.end()) known = files_.emplace(text, hash_file(text)).first;
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
