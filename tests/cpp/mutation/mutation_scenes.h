// Scenes for mutations beside those of all light transport: long specular chains, nearly specular
// surfaces, caustics of lights that no walk can hit.
#pragma once

#include "moving_scenes.h"

namespace mlt::test {

inline const std::string nearly_glass =
    "<bsdf type='roughdielectric'><float name='alpha' value='0.05'/><float name='int_ior' "
    "value='1.5'/></bsdf>";
inline const std::string nearly_mirror =
    "<bsdf type='roughconductor'><float name='alpha' value='0.06'/><string name='material' "
    "value='Al'/></bsdf>";

/// A ring around the y axis, with the normals of a torus, as an obj file.
inline void write_torus(const std::string& path, double radius, double tube, int n) {
  std::ofstream out(path);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double phi = 2 * pi * i / n, theta = 2 * pi * j / n;
      const Vec3 normal(std::cos(theta) * std::cos(phi), std::sin(theta),
                        std::cos(theta) * std::sin(phi));
      const Vec3 p = Vec3(radius * std::cos(phi), 0, radius * std::sin(phi)) + tube * normal;
      out << "v " << p.x << " " << p.y << " " << p.z << "\nvn " << normal.x << " " << normal.y
          << " " << normal.z << "\n";
    }
  const auto corner = [&](int i, int j) {
    const int index = 1 + (i % n) * n + j % n;
    return " " + std::to_string(index) + "//" + std::to_string(index);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      out << "f" << corner(i, j) << corner(i, j + 1) << corner(i + 1, j + 1) << "\nf"
          << corner(i, j) << corner(i + 1, j + 1) << corner(i + 1, j) << "\n";
}

inline std::vector<std::string> mutation_scene_names() {
  std::vector<std::string> names = scene_names();
  for (const char* name : {"mirrors", "near_specular", "near_specular_mirrors", "sun_caustic",
                           "point_caustic", "lens_through_mirror", "moving_mirror", "moving_lamp",
                           "moving_lens", "spinning_instance", "glass_torus"})
    names.push_back(name);
  return names;
}

inline TestScene make_mutation_scene(const std::string& name) {
  const std::string image = film(16, 12);
  const std::string pinhole = camera(in_front, "0, 0, 0", 40, image);
  const std::string ball = sphere(0.35, -0.6, 0.2, 0.4, white);
  const auto walls = [&](const std::string& left_and_right) {
    return rectangle(rotate("x", -90) + translate(0, -1, 0), white) +
           rectangle(rotate("x", 90) + translate(0, 1, 0), white) +
           rectangle(translate(0, 0, -1), red) +
           rectangle(rotate("y", 90) + translate(-1, 0, 0), left_and_right) +
           rectangle(rotate("y", -90) + translate(1, 0, 0), left_and_right);
  };
  const auto done = [&](const std::string& content) {
    return TestScene{name, load_scene(content)};
  };

  // Chains of 0 to 4 specular vertices and more, on both sides of a diffuse one.
  if (name == "mirrors")
    return done(pinhole + walls(mirror) + ceiling_lamp(0.7) + sphere(0.2, -0.6, 0.2, 0.35, glass));
  if (name == "near_specular")
    return done(pinhole + room() + ceiling_lamp() + sphere(0.4, -0.5, 0.2, 0.45, nearly_glass) +
                sphere(-0.5, -0.6, 0, 0.4, nearly_mirror));
  if (name == "near_specular_mirrors")
    return done(pinhole + walls(nearly_mirror) + ceiling_lamp(0.7) + ball);
  if (name == "sun_caustic")
    return done(pinhole + sun + room() + sphere(0.35, -0.5, 0.2, 0.45, glass) +
                sphere(-0.5, -0.6, 0, 0.4, nearly_mirror));
  if (name == "point_caustic")
    return done(pinhole + point_lamp + room() + sphere(0.35, -0.5, 0.2, 0.4, glass) +
                sphere(-0.5, -0.6, 0, 0.4, nearly_glass));
  // The lamp's image in the mirror is seen by light walks that hit the lens alone.
  if (name == "lens_through_mirror")
    return done(
        camera(
            "0, 0, 0.9", "0, 0, 0", 90, image, "thinlens",
            "<float name='aperture_radius' value='0.8'/><float name='focus_distance' value='1'/>") +
        point_lamp + rectangle(rotate("x", -90) + translate(0, -1, 0), white) +
        rectangle(translate(0, 0, -1), mirror));
  // A ball in a block of water, and beside it a ring of glass, under a small lamp.
  if (name == "glass_torus") {
    const TemporaryFile torus("torus.obj");
    write_torus(torus.path(), 0.35, 0.15, 24);
    return done(pinhole + room() + ceiling_lamp(0.3, "15 12 10") +
                "<shape type='obj'><string name='filename' value='" + torus.path() + "'/>" +
                to_world(translate(0.4, -0.75, 0.3)) + glass + "</shape>\n" +
                cube(scale(0.4) + rotate("y", 20) + translate(-0.45, -0.55, 0), water) +
                sphere(-0.45, -0.6, 0, 0.2, white));
  }
  const std::vector<std::string> moving = moving_scene_names();
  if (std::count(moving.begin(), moving.end(), name)) return done(moving_scene(name));
  return make_scene(name);
}

}  // namespace mlt::test
