// Loading a large mesh from a binary PLY file: the time to read it, without the hierarchy; the time
// of a whole scene, whose difference is the hierarchy; and the memory that both leave behind.
#include "io/load.h"
#include "job/plugins.h"

#include "dented_ball.h"
#include "timing.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstring>

namespace mlt {
namespace {

constexpr const char* usage = R"(Time and memory of loading a mesh from a binary PLY file.

usage: bench_load [--triangles N] [--json]
  --triangles N    about so many (1000000)
  --json           one line of JSON instead of text
)";

struct Usage {
  double seconds;
  double bytes;
};

double resident_bytes() {
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

template <class Make>
Usage usage_of(Make&& make) {
  const double before = resident_bytes();
  Usage usage;
  usage.seconds = timed(make);
  usage.bytes = resident_bytes() - before;
  return usage;
}

Node ply_node(const std::string& path) {
  Node node;
  node.family = "shape";
  node.type = "ply";
  node.properties.push_back({"filename", path, {}});
  return node;
}

constexpr const char* scene_text = R"(<scene version="3.0.0">
  <sensor type="perspective"/>
  <emitter type="constant"/>
  <shape type="ply"><string name="filename" value="ball.ply"/></shape>
</scene>)";

int run(int triangles, bool json) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("pymlt-load-{}", getpid());
  std::filesystem::create_directories(folder);
  const int n = static_cast<int>(std::lround(std::sqrt(triangles / 4.0)));
  write_dented_ball(folder / "ball.ply", n);

  const Node node = ply_node((folder / "ball.ply").string());
  std::vector<double> read, whole;
  ScenePtr scene;
  Usage first{};
  for (int round = 0; round < 5; ++round) {
    scene = nullptr;
    std::vector<std::string> warnings;
    read.push_back(timed([&] { build_object(node, plugins(), warnings); }));
    const Usage usage =
        usage_of([&] { scene = load_string(scene_text, folder.string(), plugins(), {}).scene; });
    if (round == 0) first = usage;  // later ones take memory that was freed
    whole.push_back(usage.seconds);
  }
  std::filesystem::remove_all(folder);
  const double count = static_cast<double>(scene->triangle_count());
  const double own = static_cast<double>(scene->bytes()) / count, resident = first.bytes / count;
  const double hierarchy = std::max(0.0, median(whole) - median(read));
  if (json)
    fmt::print(
        "{{\"triangles\": {}, \"read_seconds\": {:.4f}, \"hierarchy_seconds\": {:.4f}, "
        "\"mesh_bytes_per_triangle\": {:.1f}, \"resident_bytes_per_triangle\": {:.1f}}}\n",
        count, median(read), hierarchy, own, resident);
  else
    fmt::print(
        "{} triangles: read in {:.3f} CPU s, hierarchy built in {:.3f} CPU s; a triangle takes "
        "{:.1f} bytes of mesh, {:.1f} bytes of memory with the hierarchy\n",
        count, median(read), hierarchy, own, resident);
  return 0;
}

}  // namespace
}  // namespace mlt

int main(int argc, char** argv) {
  int triangles = 1000000;
  bool json = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0) {
      json = true;
    } else if (std::strcmp(argv[i], "--triangles") == 0 && i + 1 < argc) {
      triangles = std::max(100, std::atoi(argv[++i]));
    } else {
      fmt::print("{}", mlt::usage);
      return std::strcmp(argv[i], "--help") == 0 ? 0 : 2;
    }
  }
  try {
    return mlt::run(triangles, json);
  } catch (const std::exception& error) {
    fmt::print(stderr, "load: {}\n", error.what());
    return 2;
  }
}
