// Tiny scenes for tests of light transport, as XML. Each is a room or a table that shows one thing
// which an algorithm may get wrong; together they have every kind of light, vertex and camera.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "image/image_io.h"
#include "io/load.h"
#include "job/plugins.h"

namespace mlt::test {

// ---- pieces

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
inline const std::string water =
    "<bsdf type='dielectric'><float name='int_ior' value='1.33'/></bsdf>";
inline const std::string mirror =
    "<bsdf type='conductor'><string name='material' value='Ag'/></bsdf>";
inline const std::string null_surface = "<bsdf type='null'/>";

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
inline const std::string sun =
    "<emitter type='directional'><vector name='direction' x='-0.3' y='-0.7' z='-1'/>"
    "<rgb name='irradiance' value='3 2 1'/></emitter>\n";
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

/// An octahedron whose faces are cut into n^2 triangles, with the normals of a sphere: far from
/// smooth geometry, far from its shading normals.
inline void write_coarse_ball(const std::string& path, int n) {
  std::ofstream out(path);
  const auto corner = [&](double x, double y, double z) {
    const Vec3 p = normalize(Vec3(x, y, z));
    out << "v " << p.x << " " << p.y << " " << p.z << "\nvn " << p.x << " " << p.y << " " << p.z
        << "\n";
  };
  int index = 0;
  for (int face = 0; face < 8; ++face) {
    const double sx = face & 1 ? -1 : 1, sy = face & 2 ? -1 : 1, sz = face & 4 ? -1 : 1;
    const auto triangle = [&](int i, int j, bool up) {
      const int d = up ? 1 : -1;
      const int corners[3][2] = {{i, j}, {i + d, j}, {i, j + d}};
      const bool turn = sx * sy * sz < 0;
      for (int c = 0; c < 3; ++c) {
        const int* at = corners[turn ? 2 - c : c];
        corner(sx * at[0], sy * at[1], sz * (n - at[0] - at[1]));
      }
      out << "f";
      for (int c = 1; c <= 3; ++c) out << " " << index + c << "//" << index + c;
      out << "\n";
      index += 3;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        triangle(i, j, true);
        if (i + j < n - 1) triangle(i + 1, j + 1, false);
      }
  }
}

/// A sky with a bright spot and a gradient.
inline void write_sky(const std::string& path) {
  Image image(8, 5, 3);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 8; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) = 0.3f + 0.1f * static_cast<float>(c) + (x == 2 && y == 1 ? 5.0f : 0.0f);
  write_image(path, image);
}

/// Waves: as heights, and as normals that lean a little, since (0.5, 0.5, 1) is upright.
inline void write_waves(const std::string& path) {
  Image image(16, 16, 3);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      image.at(x, y, 0) = static_cast<float>(0.5 + 0.25 * std::sin(0.8 * x + 0.3 * y));
      image.at(x, y, 1) = static_cast<float>(0.5 + 0.25 * std::cos(0.5 * x - 0.9 * y));
      image.at(x, y, 2) = 0.9f;
    }
  write_image(path, image);
}

inline ScenePtr load_scene(const std::string& content) {
  const LoadedScene loaded = load_string("<scene>\n" + content + "</scene>", "", plugins(), {});
  EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings.front();
  return loaded.scene;
}

// ---- scenes

/// What an algorithm can see of a scene.
struct TestScene {
  std::string name;
  ScenePtr scene;
  bool path_sees_all = true;  ///< No light is visible only to techniques from the light side.
  /// Nothing is seen by way of a delta vertex alone, or so rarely by light walks that a test of it
  /// would take hours (the sky itself, through a pinhole).
  bool light_sees_all = true;
};

/// Where cameras stand: before the room, or inside it.
inline const std::string in_front = "0, 0, 3.6", inside = "0.1, -0.2, 0.85", middle = "0, -0.1, 0";

struct SceneSettings {
  int width = 16, height = 12;
  std::string filter = "<rfilter type='box'/>";
};

/// All test scenes by name.
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
          "mirror",
          "sphere_light",
          "spot",
          "materials",
          "instances",
          "orthographic",
          "projector",
          "daylight",
          "bent_normals",
          "more_materials"};
}

inline TestScene make_scene(const std::string& name, const SceneSettings& settings = {}) {
  const std::string image = film(settings.width, settings.height, settings.filter);
  const std::string pinhole = camera(in_front, "0, 0, 0", 40, image);
  const auto lens = [&](double radius) {
    return camera("0, 0, 2.2", "0, 0, 0", 50, image, "thinlens",
                  "<float name='aperture_radius' value='" + std::to_string(radius) +
                      "'/><float name='focus_distance' value='2.4'/>");
  };
  const std::string ball = sphere(0.35, -0.6, 0.2, 0.4, white);
  const std::string block =
      cube(scale(0.3) + rotate("y", 25) + translate(-0.4, -0.7, -0.3), diffuse("0.5 0.5 0.3"));
  const std::string lamp = ceiling_lamp();
  const TemporaryFile mesh("ball.obj"), map("sky.exr");
  const auto coarse_ball = [&](const std::string& nested) {
    write_coarse_ball(mesh.path(), 2);
    return "<shape type='obj'><string name='filename' value='" + mesh.path() + "'/>" +
           to_world(scale(0.55) + translate(0, -0.3, 0)) + nested + "</shape>\n";
  };
  const auto done = [&](const std::string& content, bool path_sees_all, bool light_sees_all) {
    return TestScene{name, load_scene(content), path_sees_all, light_sees_all};
  };

  if (name == "cornell") return done(pinhole + room() + lamp + ball + block, true, true);
  if (name == "caustic")
    return done(pinhole + room() + lamp + block + sphere(0.35, -0.5, 0.2, 0.45, glass), true,
                false);
  if (name == "plastic") {
    const std::string smooth =
        "<bsdf type='plastic'><rgb name='diffuse_reflectance' value='0.5 0.3 0.1'/></bsdf>";
    const std::string rough =
        "<bsdf type='roughplastic'><float name='alpha' value='0.2'/>"
        "<rgb name='diffuse_reflectance' value='0.1 0.3 0.5'/></bsdf>";
    return done(pinhole + room(smooth) + lamp + sphere(0.35, -0.6, 0.2, 0.4, rough) + block, true,
                false);
  }
  if (name == "rough_glass")
    return done(pinhole + room() + lamp + block +
                    sphere(0.35, -0.5, 0.2, 0.45,
                           "<bsdf type='roughdielectric'><float name='alpha' value='0.3'/></bsdf>"),
                true, true);
  const std::string table = rectangle(scale(1.5) + rotate("x", -90) + translate(0, -1, 0), white);
  if (name == "sky")
    return done(pinhole + sky + table + ball + sphere(-0.5, -0.5, 0, 0.4, glass), true, false);
  if (name == "sky_map") {
    write_sky(map.path());
    return done(pinhole + "<emitter type='envmap'><string name='filename' value='" + map.path() +
                    "'/></emitter>\n" + table + ball + block,
                true, true);
  }
  if (name == "sun") return done(pinhole + sun + room() + ball + block, true, true);
  if (name == "point") return done(pinhole + point_lamp + room() + ball + block, true, true);
  if (name == "mixed_lights") {
    const std::string small =
        sphere(-0.5, 0, 0.3, 0.15, diffuse("0.4 0.4 0.4") + area_light("1 3 1"));
    return done(pinhole + point_lamp + sun + sky + lamp + small + room() + ball, true, true);
  }
  // The lens is so large that light walks often hit it; the block stands in part before it.
  const std::string before_lens =
      cube(scale(0.25) + translate(0.3, 0.1, 1.3), diffuse("0.5 0.5 0.3"));
  if (name == "thin_lens") return done(lens(0.5) + room() + lamp + ball + before_lens, true, true);
  if (name == "thin_lens_sky")
    return done(lens(0.6) + sky + table + ball + before_lens + sphere(-0.5, -0.4, 0.3, 0.4, glass),
                true, false);
  const std::string eye_in_ball = camera(middle, "0, -0.3, -1", 70, image);
  const std::string glow = sphere(0, 0.5, 0, 0.2, white + area_light("10 8 6"));
  if (name == "camera_in_glass")
    return done(eye_in_ball + room() + lamp + sphere(0.05, -0.1, 0.02, 0.3, glass), true, false);
  if (name == "light_in_glass")
    return done(
        camera(inside, "0, -0.3, -1", 70, image) + room() + glow + sphere(0, 0.5, 0, 0.3, glass),
        true, false);
  if (name == "both_in_glass")
    return done(eye_in_ball + room() + glow + sphere(0, 0.2, 0, 0.6, glass), true, false);
  const std::string pool = rectangle(scale(3) + rotate("x", -90) + translate(0, -0.2, 0), water);
  if (name == "camera_under_water")
    return done(
        camera("0, -0.7, 0.8", "0, 0.3, -0.5", 80, image) + room() + ceiling_lamp(0.8) + pool, true,
        false);
  if (name == "light_under_water")
    return done(camera("0, 0.7, 0.8", "0, -0.3, -1", 80, image) + room() + pool +
                    sphere(0.3, -0.6, 0, 0.25, white + area_light("10 8 6")),
                true, false);
  if (name == "smooth_normals")
    return done(pinhole + room() + lamp + coarse_ball("<bsdf type='twosided'>" + white + "</bsdf>"),
                true, true);
  if (name == "smooth_glass")
    return done(pinhole + room() + lamp + coarse_ball(glass), true, false);
  if (name == "null_surface")
    return done(pinhole + room() + lamp + ball +
                    cube(scale(0.5) + translate(0.3, -0.45, 0.1), null_surface),
                true, false);
  if (name == "mirror")
    return done(pinhole + room() + lamp + ball + sphere(-0.4, -0.5, -0.2, 0.45, mirror), true,
                false);
  if (name == "sphere_light")
    return done(pinhole + room() + block +
                    sphere(0.2, 0.3, 0, 0.3, diffuse("0.4 0.4 0.4") + area_light("4 5 6")),
                true, true);
  if (name == "spot")
    return done(pinhole + room() + ball + block +
                    "<emitter type='spot'><float name='cutoff_angle' value='50'/>" +
                    to_world("<lookat origin='0, 0.9, 0.8' target='0, -1, -0.2' up='0, 0, 1'/>") +
                    "<rgb name='intensity' value='8 6 4'/></emitter>\n",
                true, true);
  if (name == "materials") {
    const std::string clay = "<bsdf type='roughdiffuse'><float name='alpha' value='0.6'/></bsdf>";
    const std::string veil =
        "<bsdf type='mask'><float name='opacity' value='0.6'/><bsdf type='twosided'>" + red +
        "</bsdf></bsdf>";
    const std::string misted_glass =
        "<bsdf type='blendbsdf'><float name='weight' value='0.4'/>" + glass + white + "</bsdf>";
    return done(pinhole + room(clay) + ceiling_lamp(0.7) +
                    sphere(0.35, -0.5, 0.2, 0.4, misted_glass) +
                    cube(scale(0.25) + translate(-0.5, -0.6, 0.1), veil) +
                    rectangle(scale(0.3) + rotate("y", -60) + translate(0.1, 0.5, -0.2),
                              "<bsdf type='twosided'>" + red + green + "</bsdf>") +
                    rectangle(scale(0.4) + rotate("y", 40) + translate(-0.1, 0, 0.3),
                              "<bsdf type='thindielectric'/>"),
                true, false);
  }
  if (name == "instances") {
    const auto instance = [](const std::string& steps) {
      return "<shape type='instance'><ref id='things'/>" + to_world(steps) + "</shape>\n";
    };
    const std::string uneven = "<scale x='-0.4' y='0.7' z='0.4'/>";
    return done(pinhole + room() + lamp + "<shape type='shapegroup' id='things'>" +
                    sphere(0.35, -0.6, 0.2, 0.4, glass) + block + "</shape>\n" + instance("") +
                    instance(uneven + rotate("z", 20) + translate(0.1, 0.3, 0.1)),
                true, false);
  }
  if (name == "orthographic")
    return done(
        "<sensor type='orthographic'>" +
            to_world("<scale x='1.2' y='1.1'/><lookat origin='0.3, 0.2, 0.8' target='0, 0, 0' "
                     "up='0, 1, 0'/>") +
            image + "</sensor>\n" + room() + lamp + ball + block + before_lens,
        true, true);
  if (name == "projector")
    return done(pinhole + room() + ball + block +
                    "<emitter type='projector'><float name='fov' value='60'/><float name='scale' "
                    "value='4'/>" +
                    "<texture name='irradiance' type='checkerboard'>"
                    "<rgb name='color0' value='0.6 0.2 0.2'/><rgb name='color1' value='0.2 0.4 "
                    "1'/></texture>" +
                    to_world("<lookat origin='0.7, 0.6, 0.9' target='-0.2, -0.6, -0.5' "
                             "up='0, 1, 0'/>") +
                    "</emitter>\n",
                true, true);
  if (name == "daylight")
    return done(pinhole +
                    "<emitter type='sunsky'><vector name='sun_direction' x='1' y='2' z='3'/>"
                    "<integer name='resolution' value='32'/><float name='turbidity' value='4'/>"
                    "<float name='sun_radius_scale' value='30'/></emitter>\n" +
                    table + ball + block,
                true, false);
  if (name == "bent_normals") {
    write_waves(map.path());
    const std::string waves = "<texture type='bitmap'><string name='filename' value='" +
                              map.path() + "'/><boolean name='raw' value='true'/></texture>";
    const auto bump = [&](double scale, const std::string& nested) {
      return "<bsdf type='bumpmap'><float name='scale' value='" + std::to_string(scale) + "'/>" +
             waves + nested + "</bsdf>";
    };
    const std::string tilted = "<bsdf type='twosided'><bsdf type='normalmap'>" + waves +
                               "<bsdf type='roughconductor'><float name='alpha' value='0.4'/>"
                               "</bsdf></bsdf></bsdf>";
    return done(pinhole + room(bump(0.25, "<bsdf type='plastic'/>")) + ceiling_lamp(0.7) +
                    sphere(0.4, -0.5, 0.2, 0.4, bump(0.1, glass)) +
                    sphere(-0.5, -0.3, -0.2, 0.35, bump(0.1, mirror)) +
                    cube(scale(0.25) + rotate("y", 30) + translate(-0.3, -0.7, 0.5), tilted),
                true, false);
  }
  if (name == "more_materials") {
    const std::string car =
        "<bsdf type='coating'><rgb name='sigma_a' value='0.1 0.5 0.9'/>"
        "<bsdf type='roughconductor'><float name='alpha' value='0.3'/></bsdf></bsdf>";
    const std::string clear =
        "<bsdf type='principled'><float name='spec_trans' value='0.7'/>"
        "<float name='roughness' value='0.5'/><float name='clearcoat' value='0.5'/>"
        "<rgb name='base_color' value='0.4 0.6 0.8'/></bsdf>";
    const std::string leaf =
        "<bsdf type='principledthin'><float name='spec_trans' value='0.4'/>"
        "<float name='diff_trans' value='0.9'/><float name='roughness' value='0.7'/></bsdf>";
    const std::string brushed =
        "<bsdf type='mixturebsdf'><string name='weights' value='0.6, 0.3'/>"
        "<bsdf type='ward'><float name='alpha_u' value='0.15'/>"
        "<float name='alpha_v' value='0.4'/></bsdf>" +
        white + "</bsdf>";
    return done(pinhole + room(brushed) + ceiling_lamp(0.7) + sphere(0.4, -0.5, 0.2, 0.4, clear) +
                    sphere(-0.5, -0.6, -0.2, 0.35, car) +
                    rectangle(scale(0.4) + rotate("y", 30) + translate(-0.2, 0, 0.4), leaf),
                true, false);
  }
  throw UsageError("there is no test scene '" + name + "'");
}

}  // namespace mlt::test
