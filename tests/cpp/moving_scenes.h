// Scenes in which something moves, for tests of motion blur.
#pragma once

#include "scenes.h"

namespace mlt::test {

/// Times and the steps of a transform.
using Keys = std::vector<std::pair<double, std::string>>;

inline std::string animation(const Keys& keys) {
  std::string text = "<animation name='to_world'>";
  for (const auto& [time, steps] : keys)
    text += "<transform time='" + std::to_string(time) + "'>" + steps + "</transform>";
  return text + "</animation>";
}

inline std::string shutter(double open, double close) {
  return "<float name='shutter_open' value='" + fmt::format("{}", open) +
         "'/><float name='shutter_close' value='" + fmt::format("{}", close) + "'/>";
}

inline std::string moving(const std::string& type, const Keys& keys, const std::string& nested) {
  return "<shape type='" + type + "'>" + animation(keys) + nested + "</shape>\n";
}

inline std::vector<std::string> moving_scene_names() {
  return {"moving_ball",       "moving_lamp", "moving_mirror", "moving_camera",   "moving_lens",
          "spinning_instance", "moving_spot", "moving_point",  "moving_projector"};
}

/// The scene while the shutter is open; everything moves from time 0 to 1.
inline std::string moving_scene(const std::string& name, double open = 0, double close = 1) {
  const std::string image = film(16, 12), times = shutter(open, close);
  const auto look = [](const std::string& origin, const std::string& target) {
    return "<lookat origin='" + origin + "' target='" + target + "' up='0, 1, 0'/>";
  };
  const auto eye = [&](const std::string& type, const Keys& keys, const std::string& more) {
    return "<sensor type='" + type + "'>" + animation(keys) + "<float name='fov' value='40'/>" +
           more + times + image + "</sensor>\n";
  };
  const std::string pinhole = camera(in_front, "0, 0, 0", 40, image, "perspective", times);
  const std::string block =
      cube(scale(0.3) + rotate("y", 25) + translate(-0.4, -0.7, -0.3), diffuse("0.5 0.5 0.3"));
  const std::string lamp = ceiling_lamp();
  const Keys across = {{0, scale(0.35) + translate(-0.5, -0.6, 0.3)},
                       {1, scale(0.35) + translate(0.6, -0.2, -0.2)}};

  if (name == "moving_ball")
    return pinhole + room() + lamp + block + moving("sphere", across, white);
  if (name == "moving_mirror")
    return pinhole + room() + lamp + block + moving("sphere", across, mirror);
  if (name == "moving_lamp")  // It grows unevenly, and turns.
    return pinhole + room() + block + sphere(0.5, -0.7, 0.3, 0.3, glass) +
           moving("cube",
                  {{0, scale(0.1) + translate(-0.6, 0.4, 0)},
                   {1, "<scale x='0.1' y='0.3' z='0.2'/>" + rotate("z", 80) +
                           translate(0.5, 0.6, -0.2)}},
                  diffuse("0.2 0.2 0.2") + area_light("6 5 4"));
  const std::string ball = sphere(0.35, -0.6, 0.2, 0.4, white);
  if (name == "moving_camera")
    return eye("perspective",
               {{0, look("-0.4, 0, 3.6", "0, 0.1, 0")}, {1, look("0.5, 0.2, 3.2", "0.1, -0.3, 0")}},
               "") +
           room() + lamp + ball + block;
  if (name == "moving_lens")
    return eye("thinlens",
               {{0, look("-0.2, 0, 2.4", "0, 0.1, 0")}, {1, look("0.3, 0.2, 2.2", "0.1, -0.3, 0")}},
               "<float name='aperture_radius' value='0.4'/>"
               "<float name='focus_distance' value='2.4'/>") +
           room() + lamp + ball + moving("cube", across, red);
  if (name == "spinning_instance")
    return pinhole + room() + lamp + "<shape type='shapegroup' id='things'>" +
           sphere(0.35, -0.3, 0.2, 0.3, glass) + block + "</shape>\n" +
           moving(
               "instance",
               {{0, translate(0, 0.3, 0)},
                {0.5, "<scale x='0.8' y='1' z='1.2'/>" + rotate("y", 150) + translate(0, 0.2, 0)},
                {1, scale(1.2) + rotate("y", 300) + translate(0, 0.4, 0)}},
               "<ref id='things'/>");
  const auto light = [&](const std::string& type, const std::string& nested) {
    return pinhole + room() + ball + block + "<emitter type='" + type + "'>" +
           animation({{0, look("0, 0.9, 0.8", "0.4, -1, -0.2")},
                      {1, look("-0.3, 0.8, 0.6", "-0.4, -1, 0.2")}}) +
           nested + "</emitter>\n";
  };
  if (name == "moving_spot")
    return light("spot",
                 "<float name='cutoff_angle' value='50'/><rgb name='intensity' value='8 6 4'/>");
  if (name == "moving_point") return light("point", "<rgb name='intensity' value='3 2 1'/>");
  if (name == "moving_projector")
    return light("projector",
                 "<float name='fov' value='70'/><rgb name='irradiance' value='3 2 1'/>");
  throw UsageError("there is no moving scene '" + name + "'");
}

}  // namespace mlt::test
