// Making plug-ins in tests as the scene loader does, and temporary image files for them.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/registry.h"
#include "image/image_io.h"
#include "math/vec.h"

namespace mlt::test {

using Given = std::map<std::string, Value>;

constexpr Matrix identity_rows = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// The object that a plug-in makes; `warnings` receives what it had to say.
template <class T>
std::shared_ptr<T> make(const Plugin& plugin, const Given& given = {},
                        std::vector<std::string>* warnings = nullptr) {
  Params params(plugin.schema, {"scene.xml", 7});
  for (const auto& [name, value] : given) params.set(name, value, {"scene.xml", 8});
  auto object = std::dynamic_pointer_cast<T>(make_object(plugin, params));
  params.expect_all_read();
  if (warnings) *warnings = params.warnings();
  return object;
}

/// The message of the Error that making the plug-in ends in; "" if there is none.
inline std::string error_in(const Plugin& plugin, const Given& given) {
  try {
    make<Object>(plugin, given);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline Image image_of(int width, int height, int channels, const std::vector<double>& values) {
  Image image(width, height, channels);
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<float>(values[i]);
  return image;
}

/// Writes the image into the tests' directory and returns its path.
inline std::string temporary_image(const std::string& name, const Image& image) {
  const std::string path = testing::TempDir() + "mlt_" + name;
  write_image(path, image);
  return path;
}

inline void expect_close(const Vec3& a, const Vec3& b, double tolerance,
                         const std::string& what = "") {
  EXPECT_LE(length(a - b), tolerance) << "(" << a.x << ", " << a.y << ", " << a.z << ") and ("
                                      << b.x << ", " << b.y << ", " << b.z << ") " << what;
}

}  // namespace mlt::test
