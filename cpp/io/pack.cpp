#include "io/pack.h"

#include "base/atomic_file.h"
#include "io/node_bytes.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>

namespace mlt {
namespace {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "pymlt-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      throw FileError("cannot make a folder " + pattern + ": " + std::strerror(errno));
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

std::string pack(const Node& node) {
  ByteWriter bytes;
  save(bytes, node);
  return bytes.take();
}

Node unpack_node(const std::string& packed) {
  ByteReader bytes(packed);
  Node node = load_node(bytes);
  bytes.finish();
  return node;
}

std::string pack(const LoadedScene& loaded) {
  Node tree = loaded.tree;
  std::map<std::string, std::string> files;
  for_each_file(tree, [&](std::string& path) {
    std::error_code error;
    // A film's file name is one to write; a missing file is an error only where it is read.
    if (fs::is_regular_file(path, error) && !files.count(path)) files[path] = read_file(path);
  });
  ByteWriter bytes;
  save(bytes, tree);
  bytes.write(loaded.size.value_or(Vec2i(0)));
  bytes.write(files);
  return bytes.take();
}

LoadedScene unpack_scene(const std::string& packed, const Registry& registry) {
  ByteReader bytes(packed);
  const Node tree = load_node(bytes);
  LoadOptions options;
  if (const auto size = bytes.read<Vec2i>(); size.x > 0) options.size = size;
  std::map<std::string, std::string> files;
  Known known;
  bytes.read(files);
  bytes.finish();
  const TemporaryFolder folder;
  for (const auto& [path, text] : files) {
    // the extension determines the format
    auto& moved = known.moved_files;
    const fs::path name = std::to_string(moved.size()) + fs::path(path).extension().string();
    write_file(moved[path] = (folder.path() / name).string(), text);
  }
  return build_scene(tree, registry, options, &known);
}

}  // namespace mlt
