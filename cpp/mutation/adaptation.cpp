#include "mutation/adaptation.h"

#include "base/parallel.h"
#include "mutation/path_seeds.h"

#include <algorithm>

namespace mlt {
namespace {

/// Statistics of one mutation at one path length, from the pilot chains.
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

Table explore(PathChain& chain, const Scene& scene, int steps) {
  const PathMixture& mixture = chain.kernel();
  Table table(longest_row + 1, std::vector<Experience>(mixture.moves().size()));
  for (int i = 0; i < steps; ++i) {
    const uint64_t rays_before = mixture.scratch().rays.total();
    double jump = 0;
    chain.step([&](const PathState& state, double weight) {
      if (&state != &chain.state()) jump += weight * squared_jump(scene, chain.state(), state);
    });
    Experience& e = table[std::min(mixture.row(), longest_row)][mixture.chosen()];
    e.jumps += jump;
    ++e.proposed;
    e.rays += mixture.scratch().rays.total() - rays_before;
  }
  return table;
}

/// Runs pilot chains, each from a path of its own; fewer, or none, where no light was found.
std::vector<Table> explore(const PathTarget& target, const Mutations& mutations,
                           const MixtureWeights& weights, const AdaptationSettings& adaptation,
                           const std::atomic<bool>& cancelled) {
  const Candidates candidates{adaptation.seed, Purpose::pilot, adaptation.candidates};
  PathStarts starts =
      bootstrap(target, candidates, adaptation.chains, adaptation.threads, cancelled);
  std::vector<Table> tables(cancelled ? 0 : starts.paths.size());
  const auto shared = std::make_shared<MixtureWeights>(weights);
  parallel_for(adaptation.threads, tables.size(), [&](uint64_t i) {
    PathChain chain({mutations, shared},
                    candidates.rng(candidates.count + 1 + starts.paths.size() + i),
                    std::move(starts.paths[i]));
    if (chain.state().target > 0) tables[i] = explore(chain, target.scene(), adaptation.steps);
  });
  return tables;
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

MixtureWeights adapt(const PathTarget& target, const Mutations& mutations,
                     const MixtureWeights& initial, const AdaptationSettings& adaptation,
                     const std::atomic<bool>& cancelled) {
  const std::vector<Table> tables = explore(target, mutations, initial, adaptation, cancelled);
  if (tables.empty()) return initial;
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
  for (const MutationPtr& mutation : mutations) {
    const auto same =
        std::count_if(mutations.begin(), mutations.end(),
                      [&](const MutationPtr& other) { return other->name() == mutation->name(); });
    floors.push_back(
        (mutation->ergodic() ? adaptation.least_share_of_ergodic : adaptation.least_share) /
        static_cast<double>(same));
  }
  std::vector<std::vector<double>> rows;
  for (const auto& row : sum) rows.push_back(shares(row, all, floors));
  return MixtureWeights(std::move(rows));
}

}  // namespace mlt
