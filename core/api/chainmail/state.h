#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "chainmail/body.h"
#include "chainmail/deformer.h"
#include "chainmail/handle.h"
#include "chainmail/mesh.h"

namespace chainmail::api {

/// A value of a state.
using StateValue =
    std::variant<bool, std::int64_t, double, std::string, std::vector<std::uint32_t>, std::vector<double>>;

/// What an object consists of, as values by name, for checkpoints and for other processes: write and read them in any
/// form that keeps every bit. Names and values belong to the version of the library. A state may come from outside:
/// each load_… function throws Error if a value is missing, damaged or does not fit the mesh. Real numbers that
/// are whole may be given as ids.
using State = std::map<std::string, StateValue, std::less<>>;

/// Returns the state of a mesh, with the order of neighbours, on which results depend. Throws Error if the library was
/// built without nlohmann/json.
State save(const Mesh& mesh);
/// Returns an equal mesh, which is another object.
Mesh load_mesh(State state);

/// Returns the state of a body without its mesh.
State save(const Body& body);
/// Returns a body whose next moves are, bit for bit, those of the one that was saved.
Body load_body(const Mesh& mesh, State state);

/// Returns the state of a snapshot without its mesh.
State save(const Snapshot& snapshot);
/// Returns an equal snapshot.
Snapshot load_snapshot(const Mesh& mesh, State state);

/// Returns the state of a handle without its mesh.
State save(const Handle& handle);
/// Returns an equal handle.
Handle load_handle(const Mesh& mesh, State state);

/// Returns the state of a deformer without its body; its job is not part of it. The next move of this one may have to
/// prepare again. Throws Error for a method of your own (register_method()).
State save(Deformer& deformer);
/// Throws Error if a state is not that of a deformer of this body or of a copy of it.
void check_deformer(const Body& body, const State& state);
/// Continues, with a copy of its body and the same method, as the deformer that was saved, bit for bit. Throws Error if
/// the method is another one, or if the state does not fit the body; nothing has changed then.
void load(Deformer& deformer, State state);

}  // namespace chainmail::api
