#include "io/batches.h"

#include "io/node_properties.h"

#include <algorithm>

namespace mlt {
namespace {

bool is_batch(const Node& node) { return node.family == "sensor" && node.type == "batch"; }

/// Copies of a film are found by no reference.
void forget_ids(Node& node) {
  node.id.clear();
  for (Node& child : node.children) forget_ids(child);
}

int64_t width_of(const Node& film, const Registry& registry) {
  if (const auto width = number_of(film, "width")) return static_cast<int64_t>(*width);
  const Schema& schema = registry.find("film", film.type, film.where).schema;
  return std::get<int64_t>(schema.find("width")->default_value);
}

/// The film of one of `count` views of a batch.
Node film_of_view(const Node& batch, size_t count, const NodeIndex& index,
                  const Registry& registry) {
  Node film{"film", "hdrfilm", "", "", batch.where, {}, {}};
  for (const Node& child : batch.children) {
    const Node& meant = child.family == "ref" ? find_node(index, child.type, child.where) : child;
    if (meant.family == "film") film = meant;
  }
  forget_ids(film);
  const int64_t width = width_of(film, registry), views = static_cast<int64_t>(count);
  if (width % views != 0)
    throw SceneError(at(film.where,
                        "the film is {} pixels wide, which the {} sensors of the batch cannot "
                        "share; choose a multiple of {}",
                        width, views, views));
  set_property(film, "width", width / views);
  return film;
}

/// Appends the views of a batch.
void take_apart(const Node& batch, const NodeIndex& index, const Registry& registry,
                std::vector<Node>& children) {
  std::vector<Node> views;
  for (const Node& child : batch.children)
    if (child.family == "sensor") views.push_back(child);
  if (views.empty())
    throw SceneError(at(batch.where, "sensor 'batch' has no sensors inside; put some into it"));
  const Node film = film_of_view(batch, views.size(), index, registry);
  for (Node& view : views) {
    auto& parts = view.children;
    const auto is_film = [](const Node& part) { return part.family == "film"; };
    parts.erase(std::remove_if(parts.begin(), parts.end(), is_film), parts.end());
    parts.push_back(film);
    children.push_back(std::move(view));
  }
}

}  // namespace

Node without_batches(const Node& scene, const Registry& registry) {
  if (std::none_of(scene.children.begin(), scene.children.end(), is_batch)) return scene;
  const NodeIndex index = index_nodes(scene);
  Node apart = scene;
  apart.children.clear();
  for (const Node& child : scene.children)
    if (is_batch(child))
      take_apart(child, index, registry, apart.children);
    else
      apart.children.push_back(child);
  return apart;
}

}  // namespace mlt
