#include "job/checkpoint.h"

#include "base/atomic_file.h"
#include "base/bytes.h"
#include "base/file_lock.h"
#include "io/node_bytes.h"
#include "io/pack.h"
#include "job/build_id.h"
#include "mlt_version.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>

namespace mlt {
namespace {

constexpr char magic[] = "pymlt checkpoint";
constexpr size_t magic_size = sizeof(magic) - 1;
constexpr size_t header_size = magic_size + sizeof(uint64_t) + sizeof(uint32_t);

uint32_t checksum(std::string_view bytes) {
  return static_cast<uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void save(ByteWriter& bytes, const SceneSource& scene) {
  bytes.write(scene.kind);
  bytes.write(scene.name);
  bytes.write(scene.directory);
  bytes.write(scene.options.defines);
  bytes.write(scene.options.size);
  bytes.write(scene.options.lenient);
  bytes.write(scene.options.sensor);
  bytes.write(scene.options.filter);
  bytes.write(scene.options.spectral);
  bytes.write(scene.options.band);
}

SceneSource load_source(ByteReader& bytes) {
  SceneSource scene;
  bytes.read(scene.kind);
  bytes.read(scene.name);
  bytes.read(scene.directory);
  bytes.read(scene.options.defines);
  bytes.read(scene.options.size);
  bytes.read(scene.options.lenient);
  bytes.read(scene.options.sensor);
  bytes.read(scene.options.filter);
  scene.options.spectral = bytes.read<bool>();
  bytes.read(scene.options.band);
  return scene;
}

/// The body of the file. The order of the checks gives the most specific message.
std::string checked_body(const std::string& file, const std::string& path) {
  if (file.compare(0, magic_size, magic, std::min(magic_size, file.size())) != 0 || file.empty())
    throw FileError(path + ": is no checkpoint of pymlt");
  uint64_t size = 0;
  uint32_t sum = 0;
  if (file.size() >= header_size) {
    std::memcpy(&size, file.data() + magic_size, sizeof size);
    std::memcpy(&sum, file.data() + magic_size + sizeof size, sizeof sum);
  }
  if (file.size() < header_size || file.size() - header_size < size)
    throw FileError(
        fmt::format("{}: the checkpoint is truncated after {} bytes", path, file.size()));
  if (file.size() - header_size > size)
    throw FileError(fmt::format("{}: the checkpoint is damaged: something follows its end", path));
  std::string body = file.substr(header_size);
  if (checksum(body) != sum)
    throw FileError(path + ": the checkpoint is damaged: its checksum is wrong");
  return body;
}

/// Reads bytes of a checkpoint; errors in them become FileErrors about the file.
template <class Read>
void undamaged(const std::string& path, Read&& read) {
  try {
    read();
  } catch (const RenderError& error) {
    throw FileError(path + ": the checkpoint is damaged: " + error.what());
  }
}

/// The scene's name in messages.
std::string name_of(const SceneSource& scene) {
  return scene.kind == SceneSource::Kind::text || scene.name.empty()
             ? "its scene"
             : "its scene '" + scene.name + "'";
}

}  // namespace

Checkpoint checkpoint_of(const LoadedScene& loaded, const MadeIntegrator& made, uint64_t seed) {
  return {loaded.source, loaded.hash, node_of(made), seed, ""};
}

Checkpoint read_checkpoint(const std::string& path) {
  try {
    return decode_checkpoint(read_file(path, UINT64_MAX), path);
  } catch (const std::bad_alloc&) {
    throw FileError(path + ": cannot read it: there is not enough memory for what it holds");
  }
}

Checkpoint decode_checkpoint(const std::string& file, const std::string& path) {
  const std::string body = checked_body(file, path);
  ByteReader bytes(body);
  Checkpoint checkpoint;
  undamaged(path, [&] {
    std::string version, build;
    bytes.read(version);
    bytes.read(build);
    if (version != MLT_VERSION || build != build_id())
      throw FileError(
          fmt::format("{}: the checkpoint was written by pymlt {} (build {}), but this is {} "
                      "(build {}); only the "
                      "same build goes on with the same pixels",
                      path, version, build, MLT_VERSION, build_id()));
    checkpoint.scene = load_source(bytes);
    checkpoint.scene_hash = bytes.read<uint64_t>();
    checkpoint.integrator = load_node(bytes);
    checkpoint.seed = bytes.read<uint64_t>();
    bytes.read(checkpoint.state);
    bytes.finish();
  });
  return checkpoint;
}

void write_checkpoint(const std::string& path, const Checkpoint& checkpoint) {
  ByteWriter bytes;
  bytes.write(std::string(MLT_VERSION));
  bytes.write(std::string(build_id()));
  save(bytes, checkpoint.scene);
  bytes.write(checkpoint.scene_hash);
  save(bytes, checkpoint.integrator);
  bytes.write(checkpoint.seed);
  bytes.write(checkpoint.state);
  const std::string body = bytes.take();
  const uint64_t size = body.size();
  const uint32_t sum = checksum(body);
  std::string file(magic, magic_size);
  file.reserve(header_size + body.size());
  file.append(reinterpret_cast<const char*>(&size), sizeof size);
  file.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  write_file(path, file += body);
}

void check_checkpoint_writable(const std::string& path) {
  check_file_writable(path);
  std::ifstream file(path, std::ios::binary);
  char start[magic_size] = {};
  if (file && file.read(start, 1)) {
    file.read(start + 1, magic_size - 1);
    if (std::memcmp(start, magic, magic_size) != 0)
      throw FileError(path + ": is no checkpoint of pymlt, so it is not replaced by one");
  }
}

uint64_t check_same_render(const std::string& path, const Checkpoint& checkpoint) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored) || std::filesystem::is_empty(path, ignored)) return 0;
  Checkpoint there;
  uint64_t units = 0;
  try {
    there = read_checkpoint(path);
    undamaged(path, [&] { units = Job::units_of(there.state); });
  } catch (const FileError& error) {
    throw FileError(std::string(error.what()) + "; to replace it all the same, say --overwrite");
  }
  const char* difference = there.scene_hash != checkpoint.scene_hash               ? "scene"
                           : there.seed != checkpoint.seed                         ? "seed"
                           : pack(there.integrator) != pack(checkpoint.integrator) ? "integrator"
                                                                                   : nullptr;
  if (difference)
    throw FileError(
        fmt::format("{}: is the checkpoint of another render, with another {}; go on "
                    "with that by --resume, or replace it by --overwrite",
                    path, difference));
  return units;
}

AutosaveSettings autosave_to(const CheckpointFile& file, Checkpoint checkpoint) {
  check_checkpoint_writable(file.path);
  auto lock = FileLock::of(file.path);
  const uint64_t units = file.overwrite ? 0 : check_same_render(file.path, checkpoint);
  return {[path = file.path, lock = std::move(lock), units,
           checkpoint = std::move(checkpoint)](std::string state) mutable {
            if (Job::units_of(state) < units) return;
            checkpoint.state = std::move(state);
            write_checkpoint(path, checkpoint);
          },
          file.every};
}

LoadedScene load_scene(const Checkpoint& checkpoint, const std::string& path,
                       const std::string& moved_to, const Registry& registry) {
  const SceneSource& scene = checkpoint.scene;
  LoadedScene loaded;
  if (!moved_to.empty())
    loaded = load_file(moved_to, registry, scene.options);
  else if (scene.kind == SceneSource::Kind::file)
    loaded = load_file(scene.name, registry, scene.options);
  else if (scene.kind == SceneSource::Kind::text)
    loaded = load_string(scene.name, scene.directory, registry, scene.options);
  else
    throw UsageError(path + ": " + name_of(scene) + " was made by Python; resume it from there");
  check_same_scene(checkpoint, path, loaded);
  return loaded;
}

void check_same_scene(const Checkpoint& checkpoint, const std::string& path,
                      const LoadedScene& loaded) {
  if (loaded.hash != checkpoint.scene_hash)
    throw SceneError(
        path + ": " + name_of(checkpoint.scene) +
        " has changed since the checkpoint was written; it can only be resumed with the "
        "scene as it was");
}

void resume(Job& job, const Checkpoint& checkpoint, const std::string& path) {
  undamaged(path, [&] { job.load(checkpoint.state); });
}

}  // namespace mlt
