#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "chainmail/mesh.h"

namespace chainmail::api {

/// A value of a state.
using StateValue = std::variant<std::int64_t, double, std::string, std::vector<std::uint32_t>, std::vector<double>>;

/// What a mesh consists of, as values by name, for other processes: write and read them in any form that keeps every
/// bit. Names and values belong to the version of the library. A state may come from outside: load_mesh() throws Error
/// if a value is missing or damaged.
using State = std::map<std::string, StateValue, std::less<>>;

/// Returns the state of a mesh, with the order of neighbours, on which results depend. Throws Error if the library was
/// built without nlohmann/json.
State save(const Mesh& mesh);
/// Returns an equal mesh, which is another object.
Mesh load_mesh(State state);

}  // namespace chainmail::api
