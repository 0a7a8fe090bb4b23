// Loading: makes a Scene from a scene description.
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
  std::optional<int64_t> sensor;  ///< Index of the sensor, from 0; by default the first.
  std::string filter;             ///< The reconstruction filter that replaces that of films.
  bool spectral = false;          ///< Whether films become spectral.
  std::string band;               ///< The band of spectral films, if one is asked for.
};

/// The source of a scene, from which a checkpoint can load it again.
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

/// The data of a scene that are reused when it is built again, with few changes.
struct Known {
  std::shared_ptr<const Parts> parts;
  std::shared_ptr<const Accel> accel;
  std::map<std::string, std::string> file_hashes;  ///< Hashes of the files read, by name.
  std::map<std::string, std::string>
      moved_files;  ///< Where files are now, by the names in the scene.
};

struct LoadedScene {
  ScenePtr scene;
  Known known;  ///< For scenes that are made of this one.
  SceneSource source;
  Node tree;                                  ///< The tree that it was built from.
  std::optional<Vec2i> size;                  ///< The size that was asked for.
  std::optional<Node> integrator;             ///< The scene's own, not yet made.
  std::string aovs;                           ///< Layers of its integrator `aov`.
  std::vector<std::string> warnings;          ///< One line each, with file and line.
  std::vector<std::string> reading_warnings;  ///< Warnings of reading the tree.
  double seconds = 0;                         ///< Wall time of loading.
  uint64_t hash =
      0;  ///< Hash of everything that was read: the scene, and the content of its files.
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

/// The scene of another tree, built of the same parts as far as possible.
LoadedScene build_again(const LoadedScene& loaded, const Node& tree, const Registry& registry);

/// The scene with spectral films; of a band such as "400:430", if that is not empty.
LoadedScene with_wavelengths(const LoadedScene& loaded, const std::string& band,
                             const Registry& registry);
/// The scene with another one of its sensors.
LoadedScene with_sensor(const LoadedScene& loaded, int64_t sensor, const Registry& registry);

/// Loads a file. From a pipe such as /dev/stdin it loads the text, with file names relative to the
/// current folder.
LoadedScene load_file(const std::string& path, const Registry& registry,
                      const LoadOptions& options);
LoadedScene load_string(const std::string& xml, const std::string& directory,
                        const Registry& registry, const LoadOptions& options);

/// Makes one plug-in (with everything nested in it) from a tree.
ObjectPtr build_object(const Node& node, const Registry& registry,
                       std::vector<std::string>& warnings);

}  // namespace mlt
