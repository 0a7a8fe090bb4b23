#include "io/node_bytes.h"

#include "base/atomic_file.h"

#include <algorithm>
#include <filesystem>

namespace mlt {
namespace {

/// Calls use(T()) for the type at this place in the variant; throws if values have no such type.
template <size_t I = 0, class Use>
void with_type(size_t index, Use&& use) {
  if constexpr (I == std::variant_size_v<Value>) {
    throw RenderError("the saved state has a value of an unknown type");
  } else {
    if (index != I) return with_type<I + 1>(index, use);
    using T = std::variant_alternative_t<I, Value>;
    if constexpr (std::is_same_v<T, ObjectPtr>)
      throw RenderError("a made object cannot be saved");
    else
      use(T());
  }
}

void save(ByteWriter& bytes, const Value& value) {
  bytes.write(static_cast<uint64_t>(value.index()));
  with_type(value.index(), [&](const auto& type) {
    using T = std::decay_t<decltype(type)>;
    if constexpr (std::is_same_v<T, Buffer>)
      bytes.write(std::get<T>(value).bytes());
    else
      bytes.write(std::get<T>(value));
  });
}

Value load_value(ByteReader& bytes) {
  Value value;
  with_type(bytes.read<uint64_t>(), [&](auto content) {
    if constexpr (std::is_same_v<decltype(content), Buffer>) {
      std::string held;
      bytes.read(held);
      value = Buffer(std::move(held));
    } else {
      bytes.read(content);
      value = std::move(content);
    }
  });
  return value;
}

Node load_node(ByteReader& bytes, int depth) {
  if (depth > max_nesting) throw RenderError("the saved state is nested too deeply");
  Node node;
  for (std::string* text : {&node.family, &node.type, &node.id, &node.name}) bytes.read(*text);
  for (uint64_t left = bytes.read<uint64_t>(); left > 0; --left) {
    Node::Property property;
    bytes.read(property.name);
    property.value = load_value(bytes);
    node.properties.push_back(std::move(property));
  }
  for (uint64_t left = bytes.read<uint64_t>(); left > 0; --left)
    node.children.push_back(load_node(bytes, depth + 1));
  return node;
}

/// Sorts properties, whose order does not count, and replaces the bytes of arrays by hashes.
void simplify(Node& node) {
  std::stable_sort(node.properties.begin(), node.properties.end(),
                   [](const auto& a, const auto& b) { return a.name < b.name; });
  for (Node::Property& property : node.properties)
    if (const auto* buffer = std::get_if<Buffer>(&property.value))
      property.value = std::to_string(buffer->hash());
  for (Node& child : node.children) simplify(child);
}

}  // namespace

void save(ByteWriter& bytes, const Node& node) {
  for (const std::string* text : {&node.family, &node.type, &node.id, &node.name})
    bytes.write(*text);
  bytes.write<uint64_t>(node.properties.size());
  for (const Node::Property& property : node.properties) {
    bytes.write(property.name);
    save(bytes, property.value);
  }
  bytes.write<uint64_t>(node.children.size());
  for (const Node& child : node.children) save(bytes, child);
}

Node load_node(ByteReader& bytes) { return load_node(bytes, 1); }

void for_each_file(Node& node, const std::function<void(std::string&)>& use) {
  for (Node::Property& property : node.properties)
    if (auto* text = std::get_if<std::string>(&property.value); text && property.name == "filename")
      use(*text);
  for (Node& child : node.children) for_each_file(child, use);
}

std::string file_hash(const std::string& path) { return std::to_string(hash_of(read_file(path))); }

uint64_t fingerprint(Node tree, const std::optional<Vec2i>& size,
                     std::map<std::string, std::string>& file_hashes) {
  for_each_file(tree, [&](std::string& path) {
    std::error_code error;
    auto known = file_hashes.find(path);
    if (known == file_hashes.end()) {
      if (!std::filesystem::is_regular_file(path, error)) return;
      known = file_hashes.emplace(path, file_hash(path)).first;
    }
    path = known->second;
  });
  simplify(tree);
  ByteWriter bytes;
  save(bytes, tree);
  bytes.write(size);
  return hash_of(bytes.take());
}

}  // namespace mlt
