// The table of strategies as one picture (Veach 1997, figs. 10.2 and 10.3): the images of all
// techniques (s, t) of bidirectional path tracing, paths of k edges in row k, the number s of
// vertices from the light growing to the right. Above, what each technique finds alone; below, with
// the weights of multiple importance sampling, what it brings to the render: those images add up to
// it.
#pragma once

#include "integrator/integrator.h"

#include <optional>
#include <vector>

namespace mlt {

struct TechniqueName {
  int s = 0, t = 0;
  bool weighted = false;
};

/// "weighted.s1.t2" in its parts; nullopt for the name of another layer.
std::optional<TechniqueName> parse_technique(const std::string& layer);

/// Linear RGB with the labels at 0 and 1; each image is made smaller by a whole factor until it has
/// `most_width` pixels at the most, scaled by 2^exposure, and clipped to [0, 1]. Techniques that no
/// scene of this kind can use (t = 0 with a pinhole) are left out. nullopt if no layer is the image
/// of a technique.
std::optional<Image> technique_pyramid(const std::vector<NamedImage>& layers, double exposure,
                                       int most_width = 200);

}  // namespace mlt
