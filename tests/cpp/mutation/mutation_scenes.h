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

inline std::vector<std::string> mutation_scene_names() {
  std::vector<std::string> names = scene_names();
  for (const char* name :
       {"mirrors", "near_specular", "near_specular_mirrors", "sun_caustic", "point_caustic",
        "lens_through_mirror", "moving_mirror", "moving_lamp", "moving_lens", "spinning_instance"})
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
  const std::vector<std::string> moving = moving_scene_names();
  if (std::count(moving.begin(), moving.end(), name)) return done(moving_scene(name));
  return make_scene(name);
}

}  // namespace mlt::test
