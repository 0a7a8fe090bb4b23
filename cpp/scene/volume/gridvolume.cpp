// A grid of values from a file or an array.
#include "base/registry.h"
#include "scene/texture/texture.h"
#include "scene/transform/transform_params.h"
#include "scene/volume/grid_volume.h"
#include "scene/volume/vol_file.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cstring>

namespace mlt {
namespace {

/// The grid that is in the scene in place of a file.
GridData held_grid(Params& params) {
  if (params.has("filename")) params.fail("data", "and 'filename' exclude each other");
  const Buffer data = params.buffer("data");
  const Vec3 shape = vector_param(params, "data_shape");
  const auto length = [&](int i) {
    return static_cast<int64_t>(std::clamp(shape[i], 0.0, double{1L << 31}));
  };
  const std::array<int64_t, 3> size{length(2), length(1), length(0)};
  check_grid_size(size, 1, "'data'");
  const size_t values = size_t(size[0]) * size[1] * size[2];
  const size_t channels = data.bytes().size() / (values * sizeof(float));
  check_grid_size(size, static_cast<int64_t>(channels), "'data'");
  if (data.bytes().size() != values * channels * sizeof(float))
    params.fail("data", "has another number of bytes than its shape says");
  GridData grid{{int(size[0]), int(size[1]), int(size[2])}, int(channels), {}};
  grid.values.resize(values * channels);
  std::memcpy(grid.values.data(), data.bytes().data(), data.bytes().size());
  return grid;
}

std::shared_ptr<GridVolume> make_grid(Params& params) {
  const bool held = params.has("data");
  VolFile file = held ? VolFile{held_grid(params)} : read_vol(params.text("filename"));
  Mat4 to_world = matrix_param(params, "to_world");
  if (params.boolean("use_grid_bbox"))
    to_world = to_world * glm::scale(glm::translate(Mat4(1), file.low), file.high - file.low);
  return std::make_shared<GridVolume>(Grid(file.grid, params.text("filter_type") == "nearest",
                                           held ? "the array 'data'" : params.text("filename")),
                                      to_world);
}

}  // namespace

Plugin volume_gridvolume() {
  return {
      {"volume",
       "gridvolume",
       "A grid of values in the unit cube, which to_world moves; outside of it there is nothing.",
       {{"filename", ParamType::text, no_default, "A .vol file of Mitsuba, version 3."},
        {"data", ParamType::buffer, no_default,
         "In place of a file: an array, which a Python dict can give: float32, (depth, height, "
         "width), or with 3 channels: along z, y and x."},
        {"data_shape", ParamType::point, no_default, "Depth, height and width of `data`."},
        {"to_world", ParamType::transform, no_default, "Where the unit cube is."},
        {"use_grid_bbox", ParamType::boolean, false,
         "Put the box that the file gives in the place of the unit cube."},
        choice_parameter("filter_type", "trilinear", "Between values.", {"trilinear", "nearest"}),
        choice_parameter("wrap_mode", "clamp", "As in Mitsuba.", {"clamp"})},
       {"raw", "accel"}},
      make_grid};
}

}  // namespace mlt
