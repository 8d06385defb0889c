#include "bench/scenes.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/families.h"
#include "mesh/error.h"

namespace chainmail::bench {
namespace {

constexpr int steps_of_a_round = 32;

/// Returns the mesh with random offsets on the axes along which an element has neighbours on both sides; the outline
/// stays.
MeshPointer jittered(const Mesh& mesh) {
  std::mt19937_64 random(5);
  const auto [low, high] = bounds(mesh);
  MeshParts parts = test::placed(mesh, [&, low = low, high = high](Point p) {
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const double off = test::uniform(random, -0.3, 0.3);
      p[k] += p[k] > low[k] && p[k] < high[k] ? off : 0;
    }
    return p;
  });
  return build_mesh(std::move(parts));
}

MeshKind kind_of(const std::string& name) {
  for (const auto& info : mesh_kinds()) {
    if (info.name == name) {
      return info.kind;
    }
  }
  throw Error(name, "there is no such kind of mesh", "name one that chainmail generate knows");
}

ElementId middle(const Mesh& mesh) {
  const auto [low, high] = bounds(mesh);
  const Point centre = (low + high) / 2;
  ElementId nearest = 0;
  for (ElementId e = 1; e < mesh.element_count(); ++e) {
    if ((mesh.rest_position(e) - centre).squaredNorm() < (mesh.rest_position(nearest) - centre).squaredNorm()) {
      nearest = e;
    }
  }
  return nearest;
}

bool solid(const Mesh& mesh) {
  const auto [low, high] = bounds(mesh);
  return ((high - low).array() > 0).all();
}

/// Returns the position of the handle on its circle, relative to the element's rest position.
Point on_circle(const Mesh& mesh, double radius, double angle) {
  Point at(std::cos(angle), std::sin(angle), 0);
  if (solid(mesh)) {
    at[2] = (at[0] + at[1]) / 2;
  }
  return radius * at;
}

}  // namespace

MeshPointer make_mesh(const std::string& name) {
  const std::string prefix = "jittered_", suffix = "_3d";
  if (name.starts_with(prefix)) {
    return jittered(*make_mesh(name.substr(prefix.size())));
  }
  const bool in_space = name.ends_with(suffix);
  const std::size_t digits = name.find_first_of("0123456789");
  const MeshKind kind = kind_of(name.substr(0, digits));
  const auto side = static_cast<std::uint32_t>(std::stoul(name.substr(digits)));
  const bool cube = kind == MeshKind::block || kind == MeshKind::tetra;
  return generate({kind, {side, side, cube ? side : 1}, 1, in_space ? std::optional(3) : std::nullopt});
}

Softness mixed_softness(const Mesh& mesh) {
  std::mt19937_64 random(7);
  Softness softness{stiff, {}};
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const double give = 1e-4 * std::pow(200, test::uniform(random, 0, 1));
    softness.links.set(link, {1 - give, 1 + give, give / 2});
  }
  return softness;
}

std::string name(Drag drag) {
  return drag == Drag::local ? "local" : drag == Drag::whole_body ? "whole_body" : "whole_body_mixed";
}

Softness softness(Drag drag, const Mesh& mesh) {
  return drag == Drag::local ? Softness() : drag == Drag::whole_body ? Softness{stiff, {}} : mixed_softness(mesh);
}

DragPath path_of(Drag drag, const Mesh& mesh) {
  const auto [low, high] = bounds(mesh);
  const bool local = drag == Drag::local;
  const double local_radius = solid(mesh) ? 1 : 2.5;
  const double radius = local ? local_radius : (high - low).maxCoeff() / 8;
  DragPath path{local ? middle(mesh) : 0, {}};
  const Point centre = mesh.rest_position(path.element);
  for (int i = 0; i < steps_of_a_round; ++i) {
    path.targets.emplace_back(centre + on_circle(mesh, radius, 2 * std::numbers::pi * i / steps_of_a_round));
  }
  return path;
}

}  // namespace chainmail::bench
