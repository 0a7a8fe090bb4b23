// From a scene description to a Scene.
#pragma once

#include "base/registry.h"
#include "io/node.h"
#include "io/parts.h"
#include "scene/scene.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mlt {

struct LoadOptions {
  std::map<std::string, std::string> defines;  ///< Values for the scene's <default> parameters.
  std::optional<Vec2i> size;                   ///< Replaces the film's width and height.
  /// Whether unknown parameters and integrators are left out with a warning, rather than refused;
  /// without, they are in files of Mitsuba 0.x.
  std::optional<bool> lenient;
  std::optional<int64_t> sensor;  ///< Which of several sensors, counted from 0; else the first.
  std::string filter;             ///< The reconstruction filter that replaces that of films.
};

/// How a scene was asked for, so that a checkpoint can ask for it again.
struct SceneSource {
  enum class Kind : uint8_t {
    none,     ///< Built from a tree that has no name; only its maker can make it again.
    file,     ///< `name` is the absolute path of an XML file.
    text,     ///< `name` is the XML itself, `directory` is where its file names start.
    built_in  ///< `name` is a scene of the Python package.
  };
  Kind kind = Kind::none;
  std::string name, directory;
  LoadOptions options;
};

/// What of a scene is there already when it is built again, with few changes.
struct Known {
  std::shared_ptr<const Parts> parts;
  std::shared_ptr<const Accel> accel;
  std::map<std::string, std::string> file_hashes;  ///< Of what it has read, by name.
  std::map<std::string, std::string> moved_files;  ///< Where they are, if not where the tree says.
};

struct LoadedScene {
  ScenePtr scene;
  Known known;  ///< For scenes that are made of this one.
  SceneSource source;
  Node tree;                                  ///< What it was built from,
  std::optional<Vec2i> size;                  ///< and the size that was asked for.
  std::optional<Node> integrator;             ///< As the scene describes it, not yet made.
  std::string aovs;                           ///< The layers that its integrator `aov` asks for.
  std::vector<std::string> warnings;          ///< One line each, with file and line.
  std::vector<std::string> reading_warnings;  ///< Those that came of reading the tree.
  double seconds = 0;                         ///< Wall time of loading.
  uint64_t hash =
      0;  ///< Of everything that was read (scene, meshes, textures by content or size+name).
};

/// Reads a Mitsuba XML file into a tree: includes, defaults, aliases and paths are resolved, file
/// names are absolute. Throws SceneError or FileError.
Node read_xml_file(const std::string& path, const LoadOptions& options,
                   std::vector<std::string>& warnings);
Node read_xml_string(const std::string& xml, const std::string& directory,
                     const LoadOptions& options, std::vector<std::string>& warnings);

/// Builds the scene that a tree describes.
LoadedScene build_scene(const Node& tree, const Registry& registry, const LoadOptions& options,
                        const Known* known = nullptr);

/// The scene of another tree, built of the same parts as far as that can be.
LoadedScene build_again(const LoadedScene& loaded, const Node& tree, const Registry& registry);

/// The same scene, seen by another of its sensors.
LoadedScene with_sensor(const LoadedScene& loaded, int64_t sensor, const Registry& registry);

/// Of a pipe such as /dev/stdin it takes the text, in which file names begin at the current folder.
LoadedScene load_file(const std::string& path, const Registry& registry,
                      const LoadOptions& options);
LoadedScene load_string(const std::string& xml, const std::string& directory,
                        const Registry& registry, const LoadOptions& options);

/// Makes one plug-in (with everything nested in it) from a tree.
ObjectPtr build_object(const Node& node, const Registry& registry,
                       std::vector<std::string>& warnings);

}  // namespace mlt
