#include "ray_arrays.h"

#include "base/magnitude.h"
#include "base/parallel.h"
#include "path/walk.h"

#include <fmt/format.h>

namespace mlt::python {
namespace {

/// The rows of an array (n, columns).
py::ssize_t rows_of(const Doubles& array, py::ssize_t columns, const char* what) {
  if (array.ndim() != 2 || array.shape(1) != columns)
    throw UsageError(fmt::format("{} should be an array of the shape (n, {})", what, columns));
  return array.shape(0);
}

Vec3 row(const Doubles& array, size_t i) {
  const double* v = array.data() + 3 * i;
  return {v[0], v[1], v[2]};
}

void check_rays(const Doubles& starts, const Doubles& directions) {
  if (rows_of(starts, 3, "start") != rows_of(directions, 3, "direction"))
    throw UsageError(fmt::format("there are {} starts, but {} directions", starts.shape(0),
                                 directions.shape(0)));
  for (py::ssize_t i = 0; i < starts.shape(0); ++i) {
    const double length2 = length_squared(row(directions, i));
    if (!is_finite(row(starts, i)) || !std::isfinite(length2))
      throw UsageError(fmt::format("ray {} is not finite", i));
    if (!(length2 > 0)) throw UsageError(fmt::format("direction {} has no length", i));
    check_start(row(starts, i), fmt::format("start {}", i));
  }
}

struct Columns {
  explicit Columns(py::ssize_t n)
      : position({n, py::ssize_t{3}}),
        geo_normal({n, py::ssize_t{3}}),
        sh_normal({n, py::ssize_t{3}}),
        uv({n, py::ssize_t{2}}),
        distance(n),
        shape_index(n),
        prim_index(n) {}

  py::array_t<double> position, geo_normal, sh_normal, uv, distance;
  py::array_t<int64_t> shape_index, prim_index;
};

/// Writes a row; NaN and -1 for a ray that hits nothing.
class Writer {
 public:
  Writer(Columns& to, const Vec3& origin)
      : origin_(origin),
        position_(to.position.mutable_data()),
        geo_normal_(to.geo_normal.mutable_data()),
        sh_normal_(to.sh_normal.mutable_data()),
        uv_(to.uv.mutable_data()),
        distance_(to.distance.mutable_data()),
        shape_(to.shape_index.mutable_data()),
        prim_(to.prim_index.mutable_data()) {}

  void miss(size_t i) const {
    const Vec3 none(std::numeric_limits<double>::quiet_NaN());
    write(i, none, none, none, Vec2(none), infinity, -1, -1);
  }
  void hit(size_t i, const Ray& ray, const SurfacePoint& at) const {
    const uint32_t shape = at.instance == SurfacePoint::no_shape ? at.shape : at.instance;
    write(i, at.p + origin_, at.ng, at.shading.n, at.uv, length(at.p - ray.o), shape, at.primitive);
  }

 private:
  void write(size_t i, const Vec3& p, const Vec3& ng, const Vec3& n, const Vec2& uv, double t,
             int64_t shape, int64_t prim) const {
    for (int c = 0; c < 3; ++c) {
      position_[3 * i + c] = p[c];
      geo_normal_[3 * i + c] = ng[c];
      sh_normal_[3 * i + c] = n[c];
    }
    uv_[2 * i] = uv.x;
    uv_[2 * i + 1] = uv.y;
    distance_[i] = t;
    shape_[i] = shape;
    prim_[i] = prim;
  }

  Vec3 origin_;  ///< Scene::origin().
  double *position_, *geo_normal_, *sh_normal_, *uv_, *distance_;
  int64_t *shape_, *prim_;
};

}  // namespace

void check_start(const Vec3& start, const std::string& what) {
  const Vec3 size = glm::abs(start);
  if (too_large(max_component(size)))
    throw UsageError(fmt::format("{} has the coordinate {:g}, but should have none beyond {:g}",
                                 what, max_component(size), largest_magnitude));
}

py::dict intersect_rays(const LoadedScene& loaded, const Doubles& starts, const Doubles& directions,
                        double time) {
  check_rays(starts, directions);
  Columns columns(starts.shape(0));
  const Vec3 origin = loaded.scene->origin();
  const Writer writer(columns, origin);
  without_gil([&] {
    parallel_blocks(hardware_threads(), starts.shape(0), [&](uint64_t first, uint64_t end) {
      for (uint64_t i = first; i < end; ++i) {
        const Ray ray{row(starts, i) - origin, normalize(row(directions, i)), time};
        SurfacePoint at;
        if (loaded.scene->intersect(ray, at))
          writer.hit(i, ray, at);
        else
          writer.miss(i);
      }
    });
  });
  py::dict found;
  found["distance"] = columns.distance;
  found["position"] = columns.position;
  found["geo_normal"] = columns.geo_normal;
  found["sh_normal"] = columns.sh_normal;
  found["uv"] = columns.uv;
  found["shape_index"] = columns.shape_index;
  found["prim_index"] = columns.prim_index;
  return found;
}

py::tuple camera_rays(const LoadedScene& loaded, const Doubles& rasters, double time) {
  const py::ssize_t n = rows_of(rasters, 2, "raster");
  py::array_t<double> starts({n, py::ssize_t{3}}), directions({n, py::ssize_t{3}});
  const Camera& camera = loaded.scene->camera();
  const SurfacePoint lens = camera.sample_position({0.5, 0.5}, time).at;
  for (py::ssize_t i = 0; i < n; ++i) {
    const double* raster = rasters.data() + 2 * i;
    const Ray ray = camera_ray(camera, lens, {raster[0], raster[1]});
    for (int c = 0; c < 3; ++c) {
      starts.mutable_data()[3 * i + c] = ray.o[c] + loaded.scene->origin()[c];
      directions.mutable_data()[3 * i + c] = ray.d[c];
    }
  }
  return py::make_tuple(starts, directions);
}

}  // namespace mlt::python
