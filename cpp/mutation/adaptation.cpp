#include "mutation/adaptation.h"

#include "base/parallel.h"
#include "markov/bootstrap.h"

#include <algorithm>

namespace mlt {
namespace {

/// What the pilot chains learn of one mutation at one path length.
struct Experience {
  double jumps = 0;
  uint64_t proposed = 0, rays = 0;

  Experience& operator+=(const Experience& other) {
    jumps += other.jumps;
    proposed += other.proposed;
    rays += other.rays;
    return *this;
  }
  /// Expected squared jump per ray. A proposal costs about as much again as one ray.
  double efficiency() const { return jumps / static_cast<double>(rays + proposed); }
};

using Table = std::vector<std::vector<Experience>>;  // [length][mutation]

Table explore(const Scene& scene, const Mutations& mutations, const MutationChoice& choice,
              PathState x, int steps, Rng rng) {
  Table table(longest_row + 1, std::vector<Experience>(mutations.size()));
  RayCounts rays;
  MutationMixture kernel(mutations, choice, rays);
  std::array<PathState, 1> y;
  for (int i = 0; i < steps; ++i) {
    kernel.set_stratified_raster(unstratified(scene.camera().raster(), rng));
    const uint64_t rays_before = rays.intersect + rays.occluded;
    const int edges = x.edges();
    double jump = 0;
    metropolis_step(x, y, kernel, rng, [&](const PathState& state, double weight) {
      if (&state != &x) jump += weight * squared_jump(scene, x, state);
    });
    Experience& e = table[std::min(edges, longest_row)][kernel.chosen()];
    e.jumps += jump;
    ++e.proposed;
    e.rays += rays.intersect + rays.occluded - rays_before;
  }
  return table;
}

/// Shares in proportion to efficiency, none below its floor.
std::vector<double> shares(const std::vector<Experience>& row, const std::vector<Experience>& all,
                           const std::vector<double>& floors) {
  constexpr uint64_t enough = 200;  // proposals
  std::vector<double> efficiency;
  double sum = 0, floor_sum = 0;
  for (size_t i = 0; i < row.size(); ++i) {
    const Experience& e = row[i].proposed >= enough ? row[i] : all[i];
    efficiency.push_back(e.proposed > 0 ? e.efficiency() : 0.0);
    sum += efficiency.back();
    floor_sum += floors[i];
  }
  std::vector<double> result = floors;
  for (size_t i = 0; i < row.size(); ++i)
    result[i] += (1 - floor_sum) * (sum > 0 ? efficiency[i] / sum : 1.0 / row.size());
  return result;
}

}  // namespace

double squared_jump(const Scene& scene, const PathState& x, const PathState& y) {
  constexpr double pixels = 4, share_of_radius = 0.01;
  const auto squared = [](double distance) { return sqr(std::min(1.0, distance)); };
  const double image = squared(glm::length(y.raster - x.raster) / pixels);
  const int longer = std::max(x.edges(), y.edges()), shorter = std::min(x.edges(), y.edges());
  double vertices = longer - shorter;
  for (int i = 0; i <= shorter; ++i) {  // matched from the camera
    const SurfacePoint &a = x[x.edges() - i].at, &b = y[y.edges() - i].at;
    if (a.infinite() != b.infinite())
      vertices += 1;
    else
      vertices += squared(length(a.p - b.p) /
                          (share_of_radius * (a.infinite() ? 1 : scene.bounds().radius)));
  }
  return 0.5 * (image + vertices / (longer + 1));
}

MutationChoice adapt(const Scene& scene, const BidirectionalSettings& paths,
                     const MutationSettings& settings, const Mutations& mutations,
                     const MutationChoice& initial, const AdaptationSettings& adaptation,
                     const std::atomic<bool>& cancelled) {
  std::vector<double> weights(adaptation.candidates);
  constexpr uint64_t block = 256;
  parallel_for(adaptation.threads, (weights.size() + block - 1) / block, [&](uint64_t b) {
    PathSeeds seeds(scene, paths, settings);
    RayCounts rays;
    for (uint64_t i = b * block;
         i < std::min<uint64_t>(weights.size(), (b + 1) * block) && !cancelled; ++i) {
      Rng rng(adaptation.seed, Purpose::pilot, i);
      weights[i] = seeds.weigh(rng, rays, [](const Vec2&, double) {});
    }
  });
  Rng choose(adaptation.seed, Purpose::pilot, weights.size());
  const Bootstrap bootstrap = resample(weights, adaptation.chains, choose);
  if (bootstrap.seeds.empty() || cancelled) return initial;

  std::vector<Table> tables(bootstrap.seeds.size());
  parallel_for(adaptation.threads, tables.size(), [&](uint64_t i) {
    PathSeeds seeds(scene, paths, settings);
    RayCounts rays;
    Rng candidate(adaptation.seed, Purpose::pilot, bootstrap.seeds[i]);
    Rng choice(adaptation.seed, Purpose::pilot, weights.size() + 1 + 2 * i);
    const Rng own(adaptation.seed, Purpose::pilot, weights.size() + 2 + 2 * i);
    PathState x = seeds.pick(candidate, choice, rays);
    if (x.target > 0)
      tables[i] = explore(scene, mutations, initial, std::move(x), adaptation.steps, own);
  });

  Table sum(longest_row + 1, std::vector<Experience>(mutations.size()));
  std::vector<Experience> all(mutations.size());
  for (const Table& table : tables)
    for (size_t k = 0; k < table.size(); ++k)
      for (size_t m = 0; m < mutations.size(); ++m) {
        sum[k][m] += table[k][m];
        all[m] += table[k][m];
      }
  // A mutation that comes in several step sizes shares its floor among them.
  std::vector<double> floors;
  for (const auto& mutation : mutations) {
    const auto same = std::count_if(mutations.begin(), mutations.end(), [&](const auto& other) {
      return other->name() == mutation->name();
    });
    floors.push_back((mutation->name() == "bidirectional" ? adaptation.least_share_of_bidirectional
                                                          : adaptation.least_share) /
                     same);
  }
  std::vector<std::vector<double>> rows;
  for (const auto& row : sum) rows.push_back(shares(row, all, floors));
  return MutationChoice(std::move(rows));
}

}  // namespace mlt
