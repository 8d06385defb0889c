#include "chainmail/state.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "api/access.h"
#ifdef CHAINMAIL_HAS_JSON  // the checks of a mesh are those of sessions
#include "files/session/flat_mesh.h"
#endif

namespace chainmail::api {

#ifdef CHAINMAIL_HAS_JSON

namespace {

constexpr const char* state_of_mesh = "state of a mesh";

[[noreturn]] void refuse_part(std::string_view name) {
  throw Error(state_of_mesh, "its part '" + std::string(name) + "' is missing or damaged", "save the mesh again");
}

/// Moves a value out of a state. Throws Error if it is missing or of another type.
template <class Value>
Value taken(State& state, std::string_view name) {
  const auto found = state.find(name);
  auto* const value = found == state.end() ? nullptr : std::get_if<Value>(&found->second);
  if (value == nullptr) {
    refuse_part(name);
  }
  return std::move(*value);
}

using Ids = std::vector<std::uint32_t>;
using Reals = std::vector<double>;

void put_softness(State& state, const OwnSoftness& softness) {
  Ids links;
  Reals numbers;
  for (const auto& [link, own] : softness) {
    links.push_back(link);
    for (const inner::SoftnessNumber& one : inner::softness_numbers) {
      numbers.push_back(own.*one.value);
    }
  }
  state["own_links"] = std::move(links);
  state["own_softness"] = std::move(numbers);
}

OwnSoftness softness_from(State& state, const inner::Mesh& mesh) {
  const Ids links = taken<Ids>(state, "own_links");
  const Reals numbers = taken<Reals>(state, "own_softness");
  inner::check_links(mesh, links);
  Ids ascending = links;
  std::ranges::sort(ascending);
  if (std::ranges::adjacent_find(ascending) != ascending.end()) {
    refuse_part("own_links");
  }
  if (numbers.size() != links.size() * inner::softness_numbers.size()) {
    refuse_part("own_softness");
  }
  auto number = numbers.begin();
  std::vector<OwnSoftness::Entry> entries;
  for (const LinkId link : links) {
    inner::LinkSoftness softness;
    for (const inner::SoftnessNumber& one : inner::softness_numbers) {
      softness.*one.value = *number++;
    }
    inner::check(softness);
    entries.emplace_back(link, softness);
  }
  return own_softness_of(std::move(entries));
}

}  // namespace

State save(const Mesh& mesh) {
  const auto& [pointer, softness, remark] = Access::impl(mesh);
  FlatMesh flat = flat_mesh_of(*pointer);
  State state;
  state["rest"] = std::move(flat.rest);
  state["first_entry"] = std::move(flat.first_entry);
  state["neighbours"] = std::move(flat.neighbours);
  state["triangles"] = std::move(flat.triangles);
  state["polygons"] = std::move(flat.polygons);
  state["tetrahedra"] = std::move(flat.tetrahedra);
  state["hexahedra"] = std::move(flat.hexahedra);
  state["lattice"] = flat.lattice ? Ids(flat.lattice->size.begin(), flat.lattice->size.end()) : Ids();
  state["spacing"] = flat.lattice ? flat.lattice->spacing : 0.0;
  state["space_dimension"] = flat.space_dimension;
  put_softness(state, softness);
  state["remark"] = remark;
  return state;
}

Mesh load_mesh(State state) {
  FlatMesh flat{.rest = taken<Reals>(state, "rest"),
                .first_entry = taken<Ids>(state, "first_entry"),
                .neighbours = taken<Ids>(state, "neighbours"),
                .triangles = taken<Ids>(state, "triangles"),
                .polygons = taken<Ids>(state, "polygons"),
                .tetrahedra = taken<Ids>(state, "tetrahedra"),
                .hexahedra = taken<Ids>(state, "hexahedra"),
                .lattice = {},
                .space_dimension = taken<std::int64_t>(state, "space_dimension")};
  const auto spacing = taken<double>(state, "spacing");
  if (const Ids size = taken<Ids>(state, "lattice"); size.size() == 3) {
    flat.lattice = Lattice{{size[0], size[1], size[2]}, spacing};
  } else if (!size.empty()) {
    refuse_part("lattice");
  }
  return guarded([&] {
    MeshPointer mesh = checked_mesh(std::move(flat), state_of_mesh);
    OwnSoftness softness = softness_from(state, *mesh);
    return Access::mesh(std::move(mesh), std::move(softness), taken<std::string>(state, "remark"));
  });
}

#else

State save(const Mesh& /*mesh*/) { refuse_without("nlohmann/json", "state of a mesh"); }
Mesh load_mesh(State /*state*/) { refuse_without("nlohmann/json", "state of a mesh"); }

#endif

}  // namespace chainmail::api
