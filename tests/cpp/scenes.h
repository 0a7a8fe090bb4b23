// The scenes of tests/scenes. Each is a room or a table that shows one thing which an algorithm may
// get wrong; together they have every kind of light, vertex and camera. To look at one:
// `pymlt render tests/scenes/caustic.xml --size 320x240`.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "scene_pieces.h"

namespace mlt::test {

/// Scenes for all algorithms.
inline std::vector<std::string> scene_names() {
  return {"cornell",
          "caustic",
          "plastic",
          "rough_glass",
          "sky",
          "sky_map",
          "sun",
          "point",
          "mixed_lights",
          "thin_lens",
          "thin_lens_sky",
          "camera_in_glass",
          "light_in_glass",
          "both_in_glass",
          "camera_under_water",
          "light_under_water",
          "smooth_normals",
          "smooth_glass",
          "null_surface",
          "windows",
          "fog",
          "smoke_box",
          "smoke",
          "fire",
          "mirror",
          "sphere_light",
          "spot",
          "luminaire",
          "materials",
          "instances",
          "orthographic",
          "spherical",
          "fisheye",
          "projector",
          "daylight",
          "bent_normals",
          "more_materials",
          "spectral_room",
          "prism",
          "frosted_prism",
          "spectral_fog"};
}

inline std::set<std::string> media_scene_names() {
  return {"fog",          "smoke_box",   "smoke",  "fire",   "volume_caustic",
          "spectral_fog", "clipped_fog", "solids", "openpbr"};
}
inline std::set<std::string> spectral_scene_names() {
  return {"spectral_room", "prism", "frosted_prism", "spectral_fog", "prism_beam"};
}
/// Those in which all media are grey, as BidirectionalWave requires, and one of many lights.
inline std::vector<std::string> grey_scene_names() {
  std::vector<std::string> names = scene_names();
  const auto is_left_out = [](const std::string& name) {
    return media_scene_names().count(name) > 0;
  };
  names.erase(std::remove_if(names.begin(), names.end(), is_left_out), names.end());
  for (const char* name : {"volume_caustic", "solids", "lamps", "fading"}) names.push_back(name);
  return names;
}

/// Whether walks from the lights see everything in one of scene_names(). In the others something is
/// seen by way of a delta vertex alone, or so rarely by light walks that a test of it would take
/// hours (the sky itself, through a pinhole).
inline bool light_sees_all(const std::string& name) {
  const std::vector<std::string> seen = {
      "cornell",      "rough_glass",  "sky_map",        "sun",          "point",
      "mixed_lights", "thin_lens",    "smooth_normals", "sphere_light", "spot",
      "luminaire",    "orthographic", "projector"};
  return std::count(seen.begin(), seen.end(), name) > 0;
}

/// Scenes in which something moves or changes from time 0 to 1.
inline std::vector<std::string> moving_scene_names() {
  return {"moving_ball",       "moving_lamp", "moving_mirror", "moving_camera",    "moving_lens",
          "spinning_instance", "moving_spot", "moving_point",  "moving_projector", "fading"};
}

/// Scenes for mutations: long specular chains, nearly specular surfaces, caustics of lights that no
/// walk can hit.
inline std::vector<std::string> mutation_scene_names() {
  std::vector<std::string> names = scene_names();
  for (const char* name : {"mirrors",
                           "near_specular",
                           "near_specular_mirrors",
                           "sun_caustic",
                           "point_caustic",
                           "lens_through_mirror",
                           "moving_mirror",
                           "moving_lamp",
                           "moving_lens",
                           "spinning_instance",
                           "fading",
                           "glass_torus",
                           "beam",
                           "prism_beam",
                           "window_caustic",
                           "volume_caustic",
                           "clipped",
                           "clipped_fog",
                           "solids",
                           "openpbr",
                           "wax"})
    names.push_back(name);
  return names;
}

struct TestScene {
  std::string name;
  ScenePtr scene;
};

/// The scene tests/scenes/NAME.xml; tests run in the root of the repository.
inline TestScene make_scene(const std::string& name, const LoadOptions& options = {}) {
  return {name, without_warnings(load_file("tests/scenes/" + name + ".xml", plugins(), options))};
}

/// The same scene for the eye: a pane that light passes and no ray meets stands first in it, and
/// its shapes are in reversed order if that is asked for. So a scene becomes one with passages, and
/// no other shape is the first.
inline TestScene with_pane_first(const std::string& name, bool reversed = false) {
  std::vector<std::string> warnings;
  Node tree = read_xml_file("tests/scenes/" + name + ".xml", {}, warnings);
  std::vector<Node>& parts = tree.children;
  if (reversed) {
    const auto end_of_others = std::stable_partition(
        parts.begin(), parts.end(), [](const Node& node) { return node.family != "shape"; });
    std::reverse(end_of_others, parts.end());
  }
  const Node pane = read_xml_string(
      "<scene>" + rectangle(scale(1e-5), "<bsdf type='thindielectric'/>") + "</scene>", "", {},
      warnings);
  parts.insert(parts.begin(), pane.children.front());
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  return {name, without_warnings(build_scene(tree, plugins(), {}))};
}

/// A test scene with the red extinction of its media in all channels.
inline TestScene with_grey_media(const std::string& name) {
  std::vector<std::string> warnings;
  Node tree = read_xml_file("tests/scenes/" + name + ".xml", {}, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  const std::function<void(Node&)> make_grey = [&](Node& node) {
    for (Node& child : node.children) make_grey(child);
    if (node.family != "medium") return;
    for (auto& [parameter, value, where] : node.properties)
      if (Triple* rgb = std::get_if<Triple>(&value); rgb && parameter.rfind("sigma", 0) == 0)
        rgb->fill(rgb->front());
  };
  make_grey(tree);
  return {name, without_warnings(build_scene(tree, plugins(), {}))};
}

inline LoadOptions with_size(int width, int height, const std::string& filter = "") {
  LoadOptions options;
  options.size = Vec2i(width, height);
  options.filter = filter;
  return options;
}

inline LoadOptions with_shutter(double open, double close) {
  LoadOptions options;
  options.defines = {{"shutter_open", fmt::format("{}", open)},
                     {"shutter_close", fmt::format("{}", close)}};
  return options;
}

}  // namespace mlt::test
