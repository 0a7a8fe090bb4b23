// Integrators by name, and renderings of whole images without a Job.
#pragma once

#include <gtest/gtest.h>

#include <atomic>

#include "base/parallel.h"
#include "harness/same_image.h"
#include "job/make_integrator.h"
#include "scenes.h"

namespace mlt::test {

inline IntegratorPtr integrator(const std::string& name, const Assignments& assignments = {}) {
  const Node node = choose_integrator(LoadedScene(), name, assignments, plugins());
  return make_integrator(node, plugins()).integrator;
}

inline void run_units(Rendering& rendering, uint64_t first, uint64_t last, int threads = 1) {
  parallel_for(threads, last - first, [&](uint64_t i) { rendering.run_unit(first + i); });
}

inline std::unique_ptr<Rendering> prepared(const ScenePtr& scene, const IntegratorPtr& algorithm,
                                           uint64_t seed, int threads = 1) {
  auto rendering = algorithm->start(scene, seed);
  const std::atomic<bool> cancelled{false};
  rendering->prepare(threads, cancelled);
  return rendering;
}

inline std::unique_ptr<Rendering> rendered(const ScenePtr& scene, const IntegratorPtr& algorithm,
                                           uint64_t seed, double spp, int threads = 1) {
  auto rendering = prepared(scene, algorithm, seed, threads);
  run_units(*rendering, 0, rendering->plan().unit_count(spp), threads);
  return rendering;
}

/// An integrator with some of its parameters, under a name for both.
struct Variant {
  std::string integrator;
  Assignments assignments;
};
inline Variant variant(const std::string& name) {
  if (name == "path_equiangular") return {"path", {{"equiangular", "true"}}};
  if (name == "pssmlt_bdpt") return {"pssmlt", {{"estimator", "bdpt"}}};
  if (name == "pssmlt_ptracer") return {"pssmlt", {{"estimator", "ptracer"}}};
  if (name == "mmlt_chains") return {"mmlt", {{"independent_share", "0"}}};
  if (name == "rjmlt_chains") return {"rjmlt", {{"independent_share", "0"}}};
  if (name == "erpt") return {"erpt", {{"tours", "1"}, {"tour_length", "8"}}};
  if (name == "pssmlt_gaussian") return {"pssmlt", {{"small_step", "gaussian"}}};
  return {name, {}};
}
inline bool has_chains(const std::string& integrator) {
  return integrator == "pssmlt" || integrator == "mmlt" || integrator == "rjmlt" ||
         integrator == "mlt" || integrator == "erpt";
}

/// An integrator as a side of a comparison. Metropolis integrators scale their bootstrap with the
/// samples, so that its error vanishes with theirs.
inline Side side(const ScenePtr& scene, const std::string& name, const Assignments& assignments,
                 double spp, double luminance_samples = 5000) {
  return {name, [=](uint64_t seed, double effort) {
            const auto [integrator_name, own] = variant(name);
            Assignments all = assignments;
            all.insert(all.end(), own.begin(), own.end());
            if (has_chains(integrator_name)) {
              const auto samples = static_cast<int>(luminance_samples * effort);
              all.push_back({"chains", "64"});
              all.push_back({"luminance_samples", std::to_string(samples)});
            }
            return rendered(scene, integrator(integrator_name, all), seed, spp * effort)->image();
          }};
}

/// Every integrator with what it can save and share out, by settings for small renders.
struct Algorithm {
  std::string name;
  Assignments assignments;
};

inline std::vector<Algorithm> algorithms() {
  return {{"path", {{"max_depth", "6"}}},
          {"direct", {}},
          {"ptracer", {{"max_depth", "6"}}},
          {"bdpt", {{"max_depth", "6"}}},
          {"bdpt", {{"max_depth", "3"}, {"techniques", "true"}}},
          {"pssmlt", {{"max_depth", "6"}, {"chains", "40"}, {"luminance_samples", "4000"}}},
          {"pssmlt",
           {{"delayed_rejection", "true"},
            {"independent_share", "0.1"},
            {"max_depth", "6"},
            {"chains", "600"},
            {"luminance_samples", "4000"}}},
          {"pssmlt",
           {{"estimator", "bdpt"},
            {"max_depth", "4"},
            {"chains", "40"},
            {"luminance_samples", "4000"}}},
          {"mmlt", {{"max_depth", "6"}, {"chains", "40"}, {"luminance_samples", "4000"}}},
          {"rjmlt", {{"max_depth", "6"}, {"chains", "40"}, {"luminance_samples", "4000"}}},
          {"erpt", {{"max_depth", "6"}, {"tour_length", "4"}, {"luminance_samples", "4000"}}},
          {"mlt", {{"max_depth", "6"}, {"chains", "40"}, {"luminance_samples", "4000"}}}};
}

/// All kinds of light, on more than one tile of the film, with a filter that reaches over their
/// borders.
inline ScenePtr lights_on_tiles() {
  static const ScenePtr made = make_scene("mixed_lights", with_size(70, 40, "gaussian")).scene;
  return made;
}

inline Side known(const std::string& name, const Image& image) { return {name, nullptr, image}; }

}  // namespace mlt::test
