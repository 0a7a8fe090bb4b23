// What a render costs over the rays it cannot do without.
//
// The rays of a stretch of rendering are recorded on their way to Embree, and then the very same
// rays are traced again, in the same order, in the same hierarchy, in a loop that does nothing
// else. For each stretch:
//
//   record   twin A of the rendering runs the stretch, and its rays are written down
//   render   twin B, with the same seed, runs the same stretch; its time is T
//   replay   the bare loop traces the recorded rays; its time is R
//
// Times are CPU seconds of this one thread; T / R is a median over the stretches, so that a busy
// machine changes it little. The integrators are run as a job would run them: samplers, film and
// statistics are part of T.
#include "base/rng.h"
#include "image/splat_film.h"
#include "job/make_integrator.h"
#include "job/plugins.h"

#include "dented_ball.h"
#include "recorded_rays.h"
#include "timing.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

namespace mlt {
namespace {

// ---- scenes ------------------------------------------------------------------------------------
struct NamedScene {
  std::string name;
  LoadedScene loaded;
};

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw FileError("cannot read " + path + "; run this in the repository, or give --scenes");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  if (at == std::string::npos) throw UsageError("the Cornell box has no '" + from + "' any more");
  text.replace(at, from.size(), to);
}

NamedScene cornell_box(const std::string& scenes, int dents) {
  LoadOptions options;
  options.size = Vec2i(512, 512);
  std::string xml = read_text(scenes + "/cornell-box/scene.xml");
  replace(xml, "<rfilter type=\"gaussian\"/>", "<rfilter type=\"box\"/>");
  if (dents == 0)
    return {"cornell-box", load_string(xml, scenes + "/cornell-box", plugins(), options)};
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("pymlt-ray-cost-{}", getpid());
  std::filesystem::create_directories(folder);
  write_dented_ball(folder / "ball.ply", dents);
  replace(xml, "</scene>",
          "<shape type=\"ply\"><string name=\"filename\" value=\"ball.ply\"/><ref "
          "id=\"white\"/></shape></scene>");
  NamedScene scene{"dented-ball", load_string(xml, folder.string(), plugins(), options)};
  std::filesystem::remove_all(folder);
  return scene;
}

std::optional<NamedScene> external_scene(const std::string& name, const Vec2i& size) {
  const char* shared = std::getenv("PYMLT_SHARED");
  const std::string path =
      std::string(shared ? shared : "../shared") + "/scenes/" + name + "/scene.xml";
  if (!std::filesystem::exists(path)) {
    fmt::print("{}: skipped, {} is not there (PYMLT_SHARED names the folder)\n", name, path);
    return std::nullopt;
  }
  LoadOptions options;
  options.size = size;
  return NamedScene{name, load_file(path, plugins(), options)};
}

// ---- one measurement ---------------------------------------------------------------------------
struct Measured {
  double samples = 0, rays = 0, render_seconds = 0, replay_seconds = 0;
  double ratio = 0;          ///< Median of render over replay time.
  double splat_seconds = 0;  ///< For each sample; Metropolis integrators only.
};

/// Time of one splat at a random position, an upper bound of what a chain that moves little pays.
double splat_seconds(const Scene& scene) {
  const Vec2i size = scene.camera().raster().size;
  SplatFilm film(size.x, size.y, scene.film().filter, 16);
  Rng rng(1, Purpose::test, 0);
  std::vector<Vec2> positions(1 << 16);
  for (Vec2& p : positions) {
    p.x = rng.next() * size.x;
    p.y = rng.next() * size.y;
  }
  std::vector<double> times;
  for (int round = 0; round < 16; ++round)
    times.push_back(timed([&] {
                      for (const Vec2& p : positions) film.add(round, p, Color(0.5, 0.7, 0.9));
                    }) /
                    static_cast<double>(positions.size()));
  return median(times);
}

Measured measure(const NamedScene& scene, const std::string& integrator, double seconds) {
  // Analytic shapes want to see the ray in double precision, which is gone when a recording is
  // replayed.
  for (const ShapePtr& shape : scene.loaded.scene->shapes())
    if (!shape->as_mesh())
      throw UsageError("the scene " + scene.name + " has shapes that are not meshes");
  Assignments settings{{"max_depth", "8"}};
  const bool metropolis = integrator == "mlt" || integrator == "pssmlt";
  if (metropolis) {
    settings.push_back({"luminance_samples", "20000"});
    settings.push_back({"independent_share", "0"});
  }
  const MadeIntegrator made =
      make_integrator(choose_integrator(scene.loaded, integrator, settings, plugins()), plugins());
  const std::unique_ptr<Rendering> twin_a = made.integrator->start(scene.loaded.scene, 1);
  const std::unique_ptr<Rendering> twin_b = made.integrator->start(scene.loaded.scene, 1);
  const std::atomic<bool> cancelled{false};
  twin_a->prepare(1, cancelled);
  twin_b->prepare(1, cancelled);
  const auto rays_of = [](const Rendering& rendering) {
    Stats stats;
    rendering.add_stats(stats);
    return stats.rays_intersect + stats.rays_occluded;
  };
  const uint64_t rays_before = rays_of(*twin_b);

  constexpr size_t rays_per_stretch = 200000;
  Measured m;
  std::vector<double> ratios;
  Recording recorded;
  uint64_t unit = 0, seen = 0;
  for (int stretch = -1; m.render_seconds < seconds || stretch < 3; ++stretch) {
    const uint64_t first = unit;
    recorded.rays.clear();
    recording = &recorded;
    while (recorded.rays.size() < rays_per_stretch) twin_a->run_unit(unit++);
    recording = nullptr;
    double render = 0, bare = 0;
    const auto run_render = [&] {
      render = timed([&] {
        for (uint64_t u = first; u < unit; ++u) twin_b->run_unit(u);
      });
    };
    const auto run_bare = [&] {
      bare = timed([&] {
        if (replay(recorded) == 0) throw RenderError("no recorded ray hits anything");
      });
    };
    if (stretch % 2 == 0) {
      run_render();
      run_bare();
    } else {
      run_bare();
      run_render();
    }
    seen += recorded.rays.size();
    if (stretch < 0) continue;  // warms the caches
    m.rays += static_cast<double>(recorded.rays.size());
    ratios.push_back(render / bare);
    m.samples += (twin_b->plan().spp_done(unit) - twin_b->plan().spp_done(first)) *
                 scene.loaded.scene->camera().raster().pixels();
    m.render_seconds += render;
    m.replay_seconds += bare;
  }
  // Light that passes surfaces takes a ray for each of them, and counts one.
  if (rays_of(*twin_a) != rays_of(*twin_b) || rays_of(*twin_b) - rays_before > seen)
    throw RenderError("the twins differ, or rays go to Embree by other functions than these two");
  m.ratio = median(ratios);
  if (metropolis) m.splat_seconds = splat_seconds(*scene.loaded.scene);
  return m;
}

// ---- reports -----------------------------------------------------------------------------------
struct Report {
  std::string text, json;
};

Report report(const NamedScene& scene, const std::string& integrator, const Measured& m) {
  const double sample_rate = m.samples / m.render_seconds, per_sample = m.rays / m.samples;
  const double bare_rate = m.rays / m.replay_seconds;
  // Splats are no tracing: apart from them the same ratio is
  const double without_splats = m.ratio * (1 - m.samples * m.splat_seconds / m.render_seconds);
  Report r;
  r.text = fmt::format("{:12} {:10} {:10} {:8.3f} {:8.2f} {:10.2f} {:9.2f} {:10.2f}", scene.name,
                       scene.loaded.scene->triangle_count(), integrator, sample_rate / 1e6,
                       per_sample, bare_rate / 1e6, m.ratio, 1 / m.ratio);
  if (m.splat_seconds > 0)
    r.text +=
        fmt::format("   {:4.0f} ns a splat; {:.2f} without", 1e9 * m.splat_seconds, without_splats);
  r.json = fmt::format(
      "  {{\"scene\": \"{}\", \"triangles\": {}, \"integrator\": \"{}\", \"samples_per_second\": "
      "{:.6g}, "
      "\"rays_per_sample\": {:.5g}, \"bare_rays_per_second\": {:.6g}, \"time_over_bare\": {:.4f}, "
      "\"rays_per_second_over_bare\": {:.4f}, \"splat_nanoseconds\": {:.1f}, "
      "\"time_over_bare_without_splats\": {:.4f}}}",
      scene.name, scene.loaded.scene->triangle_count(), integrator, sample_rate, per_sample,
      bare_rate, m.ratio, 1 / m.ratio, 1e9 * m.splat_seconds, without_splats);
  return r;
}

struct Options {
  double seconds = 3;
  std::string scenes = "scenes", json, only;
};

constexpr const char* usage =
    R"(Time of rendering over the time of tracing the same rays and nothing else.

usage: bench_ray_cost [--seconds S] [--scenes FOLDER] [--only WORD] [--json FILE]
  --seconds S      CPU seconds of rendering for each line (3)
  --scenes FOLDER  where cornell-box/scene.xml lies (scenes)
  --only WORD      lines whose scene or integrator is WORD
  --json FILE      write the numbers there as well
veachdoor, living-room and torus-lmc are looked for in $PYMLT_SHARED/scenes, or in ../shared/scenes.
A sample is a camera path (path), a camera and a light path (bdpt), or a mutation.
)";

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--help" || flag == "-h") {
      fmt::print("{}", usage);
      std::exit(0);
    }
    if (i + 1 == argc) throw UsageError(flag + " needs a value, or is unknown; see --help");
    const std::string value = argv[++i];
    if (flag == "--seconds") {
      options.seconds = std::stod(value);
    } else if (flag == "--scenes") {
      options.scenes = value;
    } else if (flag == "--only") {
      options.only = value;
    } else if (flag == "--json") {
      options.json = value;
    } else {
      throw UsageError("unknown option " + flag + "; see --help");
    }
  }
  return options;
}

int run(const Options& options) {
  std::vector<NamedScene> scenes;
  scenes.push_back(cornell_box(options.scenes, 0));
  scenes.push_back(cornell_box(options.scenes, 160));
  for (const char* name : {"veachdoor", "living-room", "torus-lmc"})
    if (auto external = external_scene(name, {320, 180})) scenes.push_back(std::move(*external));
  fmt::print("{:12} {:>10} {:10} {:>8} {:>8} {:>10} {:>9} {:>10}\n", "scene", "triangles",
             "integrator", "Msmp/s", "rays/smp", "bare Mr/s", "time/bare", "rays/bare");
  std::string json;
  for (const NamedScene& scene : scenes)
    for (const std::string integrator : {"path", "bdpt", "pssmlt", "mlt"}) {
      if (!options.only.empty() && options.only != scene.name && options.only != integrator)
        continue;
      const Report r = report(scene, integrator, measure(scene, integrator, options.seconds));
      fmt::print("{}\n", r.text);
      std::fflush(stdout);
      json += (json.empty() ? "" : ",\n") + r.json;
    }
  if (!options.json.empty()) std::ofstream(options.json) << "[\n" << json << "\n]\n";
  return 0;
}

}  // namespace
}  // namespace mlt

int main(int argc, char** argv) {
  try {
    return mlt::run(mlt::parse(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "ray_cost: {}\n", error.what());
    return 2;
  }
}
