// The invariance test must fail where a mutation's density lacks a factor, or else it says nothing.
#include "mutation/chain_perturbation.h"
#include "mutation/mutation_testing.h"
#include "path/half_vector.h"
#include "path/specular_chain.h"

namespace mlt::test {
namespace {

struct Twin {
  std::string name, mutation, scene;
  std::function<BrokenTwin::Factor(const Scene&, const Mutations&)> dropped;
  uint64_t paths = 20000;
};

/// A twin whose lost factor depends on the paths alone.
Twin twin(const std::string& name, const std::string& mutation, const std::string& scene,
          const BrokenTwin::Factor& dropped) {
  return {name, mutation, scene, [=](const Scene&, const Mutations&) { return dropped; }};
}

Vec3 towards(const PathState& x, int i, int j) { return direction(x[i].at, x[j].at); }

/// Density of what was inserted, made with s vertices from the light side, for all s.
double density_of_all_ways(const Scene& scene, const PathState& y, const Edit& edit) {
  double sum = 0;
  const bool no_lens = edit.first + edit.inserted > y.edges() && scene.camera().delta_position();
  for (int s = 0; s <= edit.inserted - no_lens; ++s) {
    if (!can_sample(y.terms, edit.first + s)) continue;
    double p = 1;
    for (int i = edit.first; i < edit.first + edit.inserted; ++i) {
      if (i < edit.first + s)
        p *= i == 0 && s == 1 ? y.terms.direct : y.terms[i].from_light;
      else
        p *= y.terms[i].from_camera;
    }
    sum += p;
  }
  return sum;
}

std::vector<Twin> twins() {
  std::vector<Twin> all;
  all.push_back({"raster_per_direction", "lens", "light_in_glass",
                 [](const Scene& scene, const Mutations&) {
                   const ChainPerturbation chain(scene, StepSizes());
                   return BrokenTwin::Factor(
                       [chain](const PathState&, const PathState& y, const Edit&) {
                         return chain.raster_per_direction(y);
                       });
                 },
                 300000});
  // A chain that ends at a light.
  const auto light_edge = [](const Scene&, const Mutations&) {
    return BrokenTwin::Factor([](const PathState&, const PathState& y, const Edit& edit) {
      return edit.first == 0 ? y.terms[0].G : 1.0;
    });
  };
  all.push_back({"G_of_the_edge_from_the_light", "lens", "sphere_light", light_edge});
  all.push_back({"G_of_the_edge_from_the_light", "multi_chain", "caustic", light_edge, 300000});
  all.push_back(twin("G_of_the_last_edge", "lens", "cornell",
                     [](auto&, const PathState& y, auto&) { return y.terms[y.edges() - 1].G; }));
  all.push_back(
      {"half_vector_jacobian", "lens", "near_specular", [](const Scene& scene, const Mutations&) {
         return BrokenTwin::Factor(
             [&scene](const PathState& x, const PathState& y, const Edit& edit) {
               double product = 1;
               for (int i = edit.first + 1; i < x.edges(); ++i) {
                 if (y[i].delta()) continue;
                 const SurfacePoint& at = y[i].at;
                 const Vec3 in = at.shading.to_local(towards(y, i, i + 1));
                 const Vec3 out = at.shading.to_local(towards(y, i, i - 1));
                 const double eta = scene.bsdf(at).relative_eta(at, in);
                 product *= half_vector_jacobian(in, out, *half_vector(in, out, eta), eta);
               }
               return product;
             });
       }});
  all.push_back(
      twin("G_of_the_joint", "multi_chain", "mirrors",
           [](auto&, const PathState& y, const Edit& edit) { return y.terms[edit.first].G; }));
  all.push_back(twin(
      "cosine_at_the_start", "caustic", "cornell", [](auto&, const PathState& y, const Edit& edit) {
        return 1 / abs_cos(y[edit.first - 1].at, towards(y, edit.first - 1, edit.first));
      }));
  all.push_back(
      twin("G_of_the_chain", "caustic", "caustic", [](auto&, const PathState& y, const Edit& edit) {
        return y.terms[y.edges() - 2].G * (edit.inserted > 0);
      }));
  all.push_back(
      twin("G_from_infinity", "caustic", "sun", [](auto&, const PathState& y, const Edit& edit) {
        return edit.first == 1 ? y.terms[0].G : 1.0;
      }));
  all.push_back({"density_of_the_chain", "manifold", "point_caustic",
                 [](const Scene& scene, const Mutations&) {
                   return BrokenTwin::Factor(
                       [&scene](const PathState&, const PathState& y, const Edit& edit) {
                         const int c = edit.first - 1;
                         const int b = ChainPerturbation::chain_end(y, c, 1);
                         return SpecularChain(scene, &y[c], b - c - 1).density();
                       });
                 },
                 100000});
  // A fault of few paths.
  all.push_back(twin(
      "factor_of_long_paths", "lens", "cornell",
      [](auto&, const PathState& y, auto&) { return y.edges() > 3 ? std::exp(y.raster.x) : 1; }));
  all.push_back(twin("G_of_the_first_edge", "lens_subpath", "cornell",
                     [](auto&, const PathState& y, auto&) { return y.terms[y.edges() - 1].G; }));
  all.push_back({"stop_probability", "lens_subpath", "plastic",
                 [](const Scene& scene, const Mutations&) {
                   return BrokenTwin::Factor(
                       [&scene](const PathState&, const PathState& y, const Edit& edit) {
                         double product = 1;
                         for (int i = edit.first; i < y.edges(); ++i)
                           if (scene.bsdf(y[i].at).has_smooth() && scene.bsdf(y[i].at).has_delta())
                             product *= 0.5;
                         return product;
                       });
                 },
                 300000});
  // The choice of a gap: of its length, then of where it begins.
  all.push_back(
      twin("p_delete", "bidirectional", "caustic", [](const PathState& x, auto&, const Edit& edit) {
        const int gap = edit.deleted() + 1;
        const double length = gap == 1 ? 0.25 : gap == 2 ? 0.5 : std::pow(0.5, gap);
        return length / (x.edges() + 3 - gap);
      }));
  all.push_back(
      {"all_ways_but_one", "bidirectional", "cornell", [](const Scene& scene, const Mutations&) {
         return BrokenTwin::Factor(
             [&scene](const PathState&, const PathState& y, const Edit& edit) {
               double one = 1;  // all of it from the camera side
               for (int i = edit.first; i < edit.first + edit.inserted; ++i)
                 one *= y.terms[i].from_camera;
               return one > 0 ? density_of_all_ways(scene, y, edit) / one : 1.0;
             });
       }});
  all.push_back(twin("G_of_the_first_inserted", "bidirectional", "cornell",
                     [](auto&, const PathState& y, const Edit& edit) {
                       return edit.inserted > 0 && edit.first > 0 ? y.terms[edit.first - 1].G : 1.0;
                     }));
  all.push_back(twin("P", "multiplexed", "mirrors", [](auto&, const PathState& y, auto&) {
    return total_density(AreaMeasure{y.terms});
  }));
  all.push_back({"P_choose", "mixture", "caustic",
                 [](const Scene&, const Mutations& all) {
                   return BrokenTwin::Factor([&all](const PathState& x, auto&, auto&) {
                     double sum = 0;
                     for (size_t i = 0; i < all.size(); ++i)
                       sum += mutation_plugins()[i].weight * all[i]->suitability(x);
                     return 1 / sum;
                   });
                 },
                 100000});
  all.push_back(twin("distance", "propagation", "fog",
                     [](const PathState& x, const PathState& y, const Edit& edit) {
                       const int step = edit.inserted == 1 ? 1 : -1,
                                 b = step > 0 ? edit.first : edit.last - 1;
                       return length(x[b - step].at.p - y[b].at.p);
                     }));
  all.push_back({"cosine", "translucent", "rough_glass",
                 [](const Scene&, const Mutations&) {
                   return BrokenTwin::Factor([](const PathState&, const PathState& y, auto&) {
                     const int first = ChainPerturbation::chain_end(y, y.edges(), -1);
                     return abs_cos(y[first].at, y.terms.direction(first, -1));
                   });
                 },
                 200000});
  all.push_back({"density_of_the_chain", "wavelength", "prism",
                 [](const Scene& scene, const Mutations&) {
                   return BrokenTwin::Factor([&scene](const PathState&, const PathState& y, auto&) {
                     double product = 1;
                     for (int b = y.edges(); b > 0;) {
                       const int c = ChainPerturbation::chain_end(y, b, -1);
                       if (c < b - 1) product *= SpecularChain(scene, &y[c], b - c - 1).density();
                       b = c;
                     }
                     return product > 0 ? product : 1;
                   });
                 },
                 500000});
  all.push_back({"density_of_the_beam", "wavelength", "prism_beam",
                 [](const Scene&, const Mutations&) {
                   return BrokenTwin::Factor([](auto&, const PathState& y, auto&) {
                     double product = 1;
                     for (int i = 0; i < ChainPerturbation::chain_end(y, 0, 1); ++i)
                       product *= y.terms[i].G;
                     return product;
                   });
                 },
                 500000});
  all.push_back(twin("density_of_the_step", "wavelength", "spectral_room",
                     [](auto&, const PathState& y, auto&) { return 1 + y.path.wavelength; }));
  return all;
}

void PrintTo(const Twin& twin, std::ostream* out) {
  *out << twin.mutation << " without " << twin.name;
}

class BrokenTwins : public testing::TestWithParam<Twin> {};

TEST_P(BrokenTwins, AreFound) {
  const Twin& twin = GetParam();
  const ScenePtr scene = make_scene(twin.scene).scene;
  const PathTarget target = path_target(scene);
  const Mutations all = all_mutations(target);
  const BrokenTwin::Factor dropped = twin.dropped(*scene, all);
  Mutations spoilt;
  for (const auto& mutation : all)
    if (twin.mutation == "mixture" || twin.mutation == mutation->name())
      spoilt.push_back(std::make_shared<BrokenTwin>(mutation, dropped));
  const MixtureWeights weights =
      spoilt.size() > 1 ? default_weights() : MixtureWeights(std::vector<double>{1.0});
  AuditSettings how;
  how.paths = twin.paths;
  const AuditReport report = audit(target, spoilt, weights, how);
  EXPECT_EQ(report.verdict, Verdict::wrong) << report.text();
}

INSTANTIATE_TEST_SUITE_P(Mutations, BrokenTwins, testing::ValuesIn(twins()), [](const auto& info) {
  return info.param.mutation + "_without_" + info.param.name;
});

}  // namespace
}  // namespace mlt::test
