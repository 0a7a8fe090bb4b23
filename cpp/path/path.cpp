#include "path/path.h"

namespace mlt {

namespace {

/// Visits the members of a vertex, for writing and for reading.
template <class V, class Visit>
void for_each_member(V& x, Visit&& visit) {
  visit(x.kind);
  visit(x.lobe);
  visit(x.emitter);
  auto& at = x.at;
  visit(at.p);
  visit(at.ng);
  visit(at.shading.s);
  visit(at.shading.t);
  visit(at.shading.n);
  visit(at.uv);
  visit(at.shape);
  visit(at.primitive);
  visit(at.instance);
  visit(at.kind);
  visit(at.medium);
  visit(at.extent);
}

}  // namespace

void save(ByteWriter& bytes, const Path& path) {
  bytes.write<uint64_t>(path.vertices.size());
  for (const Vertex& x : path.vertices)
    for_each_member(x, [&](const auto& member) { bytes.write(member); });
  bytes.write(path.time);
  bytes.write(path.wavelength);
}

void load(ByteReader& bytes, Path& path) {
  const uint64_t count = bytes.read<uint64_t>();
  path.vertices.clear();
  for (uint64_t i = 0; i < count; ++i) {
    path.vertices.emplace_back();
    for_each_member(path.vertices.back(),
                    [&](auto& member) { member = bytes.read<std::decay_t<decltype(member)>>(); });
  }
  path.set_time(bytes.read<double>());
  path.set_wavelength(bytes.read<double>());
}

std::optional<Vec2> raster_position(const Scene& scene, const Path& path) {
  const int k = path.edges();
  return scene.camera().raster_position(path[k].at, direction(path[k].at, path[k - 1].at));
}

}  // namespace mlt
