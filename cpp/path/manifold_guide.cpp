#include "path/manifold_guide.h"

#include "path/bidirectional_sampler.h"
#include "scene/accel/instance.h"

#include <algorithm>
#include <unordered_set>

namespace mlt {
namespace {

/// The share of seeds that follow no photon, so that chains are found that no photon has found.
constexpr double blind_share = 0.2;

}  // namespace

uint64_t lobes_of(const Vertex* first, int m) {
  uint64_t key = 1;
  for (int i = 1; i <= m; ++i) key = 4 * key + static_cast<uint64_t>(first[i].lobe);
  return key;
}

int count_lobes(uint64_t key) {
  int m = 0;
  for (; key > 1; key /= 4) ++m;
  return m;
}

ManifoldGuide::ManifoldGuide(const Scene& scene) {
  const auto has_delta = [](const ShapePtr& shape) { return shape->bsdf().has_delta(); };
  std::unordered_set<const Shape*> grouped;
  for (const ShapePtr& shape : scene.shapes())
    if (const Instance* instance = shape->as_instance())
      for (const ShapePtr& member : instance->group().shapes()) grouped.insert(member.get());
  for (const ShapePtr& shape : scene.shapes()) {
    if (grouped.count(shape.get()) > 0) continue;
    const Instance* instance = shape->as_instance();
    const auto delta = [&] {
      if (!instance) return has_delta(shape);
      const auto& members = instance->group().shapes();
      return std::any_of(members.begin(), members.end(), has_delta);
    };
    if (!delta()) continue;
    Box& box = boxes_.emplace_back();
    shape->bounds(box.low, box.high);
  }
}

ManifoldPhotons::Cell ManifoldGuide::photons_near(const Vertex& x0, const Vertex& y) const {
  return photons_ ? photons_->near(x0, y) : ManifoldPhotons::Cell();
}

ManifoldAim ManifoldGuide::aim(const Vertex& x0, const Vertex& y, Rng& rng) const {
  const ManifoldPhotons::Cell cell = photons_near(x0, y);
  if (cell.count == 0 || rng.next() < blind_share) return {aim_blindly(rng)};
  const ManifoldPhoton& photon = cell.first[rng.below(cell.count)];
  return {photon.aim, photon.lobes};
}

double ManifoldGuide::lobes_of_seed(const Vertex* first, int m, double lobes) const {
  const ManifoldPhotons::Cell cell = photons_near(first[0], first[m + 1]);
  if (cell.count == 0) return lobes;
  return blind_share * lobes + (1 - blind_share) * cell.share(lobes_of(first, m));
}

Vec3 ManifoldGuide::aim_blindly(Rng& rng) const {
  const Box& box = boxes_[rng.below(boxes_.size())];
  const double x = rng.next(), y = rng.next();
  return box.low + Vec3(x, y, rng.next()) * (box.high - box.low);
}

double ManifoldGuide::guess(const Vertex* first, int m, double lobes) const {
  if (!ratios_) return lobes_of_seed(first, m, lobes);
  const auto ratio = ratios_->find(lobes_of(first, m));
  return ratio == ratios_->end() ? 0 : lobes_of_seed(first, m, lobes) * ratio->second;
}

namespace {

/// Light is rare if other techniques have less than this share of its density.
constexpr double rare_share = 0.1;
/// The least share of rare light for which chains are searched, where samples that search take no
/// longer than others or no other technique finds it.
constexpr double least_rare = 0.002;
/// The part of it along chains with the same lobes for which these are searched, or of all rare
/// light, where there is little.
constexpr double least_part = 0.25, least_part_of_rare = 0.02;
/// The most searches, in the mean, that find a chain again: the square of that number is noise.
constexpr double most_again = 3;

/// Samples of bidirectional path tracing that search for all chains.
class ManifoldLessons {
 public:
  ManifoldLessons(const Scene& scene, const PathRules& rules,
                  const std::shared_ptr<const ManifoldGuide>& all, uint64_t most_rays)
      : scene_(&scene),
        most_rays_(most_rays),
        manifolds_(scene, all),
        paths_(scene, settings(rules, all)) {}

  /// Takes samples until there are `count`, or they have taken the most rays.
  void take(uint64_t count) {
    for (; taken_ < count && rays_.total() + searching_.total() < most_rays_; ++taken_) {
      Rng rng(0, Purpose::manifold, taken_);
      RandomSampler sampler(rng);
      paths_.sample(scene_->camera().raster().sample(sampler.next2()), sampler, rays_);
      const auto found = [&](const Connection& c) { learn(c); };
      paths_.connect_walks(rays_, found);
      paths_.connect_by_manifolds(searching_, found);
    }
  }

  /// Whether light that is scattered before it comes to the lens has this multiple of the share
  /// that is worth the searches.
  bool pay(double multiple) const {
    return light_.scattered > 0 && (is_part(multiple, rare_.scattered, light_.scattered) ||
                                    hidden_ >= multiple * least_rare * light_.scattered);
  }
  /// For the lobes of the chains to be found, how often these are found over the probability of
  /// the lobes.
  std::unordered_map<uint64_t, double> ratios() const {
    std::unordered_map<uint64_t, double> ratios;
    for (const auto& [lobes, chains] : classes_)
      if (matter(chains) && chains.again <= most_again * chains.found)
        ratios[lobes] = chains.found / chains.again;
    return ratios;
  }

 private:
  /// Sums of all light of a kind, and of what is scattered before it comes to the lens: where a
  /// lamp is seen in a few pixels, it may be most of the light, and hardly any of the image.
  struct Light {
    double all = 0, scattered = 0;

    void add(double light, bool is_scattered) {
      all += light;
      if (is_scattered) scattered += light;
    }
  };
  struct Chains {
    Light rare;                   ///< The rare light along them.
    double found = 1, again = 1;  ///< Chains that were found, and the sum of their found_again.
  };

  static BidirectionalSettings settings(const PathRules& rules,
                                        const std::shared_ptr<const ManifoldGuide>& all) {
    BidirectionalSettings settings;
    settings.rules = rules;
    settings.manifolds = all;
    return settings;
  }

  /// Whether this rare light is a part of all that is worth its multiple of the searches.
  bool is_part(double multiple, double rare, double all) const {
    const double search = static_cast<double>(searching_.total()),
                 least = least_rare * (1 + search / static_cast<double>(rays_.total()));
    return rare >= multiple * least * all;
  }
  /// Whether such chains have enough of the light that is seen, or of that which is scattered.
  bool matter(const Chains& chains) const {
    return is_part(least_part, chains.rare.all, light_.all) ||
           is_part(least_part, chains.rare.scattered, light_.scattered) ||
           chains.rare.scattered >= least_part_of_rare * rare_.scattered;
  }

  void learn(const Connection& c) {
    paths_.assemble(c, path_);
    compute_terms(*scene_, path_, {true, paths_.settings().rules.strict_normals}, terms_);
    // weighted by the balance heuristic, so that sums are those of all techniques
    const double light = luminance(c.contribution) * c.own_share / c.survival * c.found_again;
    if (!std::isfinite(light)) return;
    const bool scattered = !(c.certainty > 0);
    light_.add(light, scattered);
    const ExtraTechnique technique = manifolds_.technique(path_, terms_);
    if (!(technique.count > 0)) return;
    Chains& chains = classes_[lobes_of(&path_[0], technique.s - 1)];
    const MisWeights weights = mis_weights(terms_, technique, Heuristic::balance);
    if (1 - weights.balance < rare_share) {
      chains.rare.add(light, scattered);
      rare_.add(light, scattered);
    }
    if (scattered && weights.balance == 1) hidden_ += light;
    if (c.searches == 0) return;
    ++chains.found;
    chains.again += c.found_again;
  }

  const Scene* scene_;
  uint64_t most_rays_;
  ManifoldSampler manifolds_;
  BidirectionalSampler paths_;
  std::unordered_map<uint64_t, Chains> classes_;
  Light light_, rare_;
  double hidden_ = 0;  ///< Scattered light that no other technique finds.
  uint64_t taken_ = 0;
  RayCounts rays_, searching_;
  Path path_;
  PathTerms terms_;
};

}  // namespace

std::shared_ptr<const ManifoldPhotons> send_photons(const Scene& scene, uint64_t most_rays) {
  auto photons = std::make_shared<ManifoldPhotons>();
  ManifoldSampler seeds(scene, std::make_shared<ManifoldGuide>(scene));
  RayCounts rays;
  for (uint64_t i = 0; i < ManifoldPhotons::most && rays.total() < most_rays; ++i) {
    Rng rng(1, Purpose::manifold, i);
    seeds.send_photon(rng, rays, *photons);
  }
  photons->divide();
  return photons;
}

std::shared_ptr<const ManifoldGuide> learn_manifolds(const Scene& scene, const PathRules& rules,
                                                     uint64_t most_rays) {
  constexpr uint64_t first_samples = 1024, samples = 8192;
  constexpr int most_searches = 256;  // what is found more rarely would take most of the time
  auto guide = std::make_shared<ManifoldGuide>(scene);
  if (!guide->useful()) return nullptr;
  guide->follow(send_photons(scene, most_rays / 2));
  const auto all = std::make_shared<ManifoldGuide>(*guide);
  all->set_most_searches(most_searches);
  ManifoldLessons lessons(scene, rules, all, most_rays);
  lessons.take(first_samples);
  if (!lessons.pay(0.5)) return nullptr;
  lessons.take(samples);
  if (!lessons.pay(1)) return nullptr;
  auto ratios = lessons.ratios();
  if (ratios.empty()) return nullptr;
  guide->choose(std::move(ratios));
  return guide;
}

}  // namespace mlt
