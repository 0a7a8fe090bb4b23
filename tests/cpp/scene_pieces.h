// Pieces of scenes as XML, for tests that put scenes together.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "io/load.h"
#include "job/plugins.h"

namespace mlt::test {

inline std::string translate(double x, double y, double z) {
  return "<translate x='" + std::to_string(x) + "' y='" + std::to_string(y) + "' z='" +
         std::to_string(z) + "'/>";
}
inline std::string scale(double s) { return "<scale value='" + std::to_string(s) + "'/>"; }
inline std::string rotate(const std::string& axis, double degrees) {
  return "<rotate " + axis + "='1' angle='" + std::to_string(degrees) + "'/>";
}
inline std::string to_world(const std::string& steps) {
  return "<transform name='to_world'>" + steps + "</transform>";
}

inline std::string diffuse(const std::string& rgb) {
  return "<bsdf type='diffuse'><rgb name='reflectance' value='" + rgb + "'/></bsdf>";
}
inline const std::string white = diffuse("0.7 0.7 0.7"), red = diffuse("0.6 0.1 0.05"),
                         green = diffuse("0.1 0.5 0.1");
inline const std::string glass =
    "<bsdf type='dielectric'><float name='int_ior' value='1.5'/></bsdf>";
inline const std::string mirror =
    "<bsdf type='conductor'><string name='material' value='Ag'/></bsdf>";

inline std::string area_light(const std::string& radiance) {
  return "<emitter type='area'><rgb name='radiance' value='" + radiance + "'/></emitter>";
}
inline std::string rectangle(const std::string& steps, const std::string& nested) {
  return "<shape type='rectangle'>" + to_world(steps) + nested + "</shape>\n";
}
inline std::string cube(const std::string& steps, const std::string& nested) {
  return "<shape type='cube'>" + to_world(steps) + nested + "</shape>\n";
}
inline std::string sphere(double x, double y, double z, double radius, const std::string& nested) {
  return "<shape type='sphere'><point name='center' x='" + std::to_string(x) + "' y='" +
         std::to_string(y) + "' z='" + std::to_string(z) + "'/><float name='radius' value='" +
         std::to_string(radius) + "'/>" + nested + "</shape>\n";
}

inline std::string film(int width, int height,
                        const std::string& filter = "<rfilter type='box'/>") {
  return "<film type='hdrfilm'><integer name='width' value='" + std::to_string(width) +
         "'/><integer name='height' value='" + std::to_string(height) + "'/>" + filter + "</film>";
}
/// A pinhole, or with `more` a thin lens, at `origin` that looks at `target`.
inline std::string camera(const std::string& origin, const std::string& target, double fov,
                          const std::string& film, const std::string& type = "perspective",
                          const std::string& more = "", const std::string& up = "0, 1, 0") {
  return "<sensor type='" + type + "'>" +
         to_world("<lookat origin='" + origin + "' target='" + target + "' up='" + up + "'/>") +
         "<float name='fov' value='" + std::to_string(fov) + "'/>" + more + film + "</sensor>\n";
}

/// Floor, ceiling, back and side walls of the room [-1, 1]^3; the front is open.
inline std::string room(const std::string& floor = white) {
  return rectangle(rotate("x", -90) + translate(0, -1, 0), floor) +
         rectangle(rotate("x", 90) + translate(0, 1, 0), white) +
         rectangle(translate(0, 0, -1), white) +
         rectangle(rotate("y", 90) + translate(-1, 0, 0), red) +
         rectangle(rotate("y", -90) + translate(1, 0, 0), green);
}
/// A square lamp below the ceiling.
inline std::string ceiling_lamp(double half_width = 0.4, const std::string& radiance = "6 5 4") {
  return rectangle(scale(half_width) + rotate("x", 90) + translate(0, 0.98, 0),
                   diffuse("0.2 0.2 0.2") + area_light(radiance));
}
inline const std::string point_lamp =
    "<emitter type='point'><point name='position' x='0.3' y='0.6' z='0.2'/>"
    "<rgb name='intensity' value='2 2 3'/></emitter>\n";
inline const std::string sky =
    "<emitter type='constant'><rgb name='radiance' value='0.5 0.7 1'/></emitter>\n";

/// A file that is gone when the scene has been loaded.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : path_(testing::TempDir() + "mlt_" + std::to_string(getpid()) + "_" + name) {}
  ~TemporaryFile() { std::remove(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline ScenePtr without_warnings(const LoadedScene& loaded) {
  EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings.front();
  return loaded.scene;
}
inline ScenePtr load_scene(const std::string& content) {
  return without_warnings(load_string("<scene>\n" + content + "</scene>", "", plugins(), {}));
}

/// Where the camera stands before the room.
inline const std::string in_front = "0, 0, 3.6";

}  // namespace mlt::test
