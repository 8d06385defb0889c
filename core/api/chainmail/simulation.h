#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "chainmail/body.h"
#include "chainmail/deformer.h"
#include "chainmail/handle.h"
#include "chainmail/mesh.h"
#include "chainmail/moves.h"

namespace chainmail::api {

struct Access;

/// Gives single links their own softness from a file: CSV rows `a,b,compression,stretch,shear`, where a and b are the
/// ends of a link, or with all of softness_numbers(). Throws Error, with the line, and if the library was built without
/// nlohmann/json; nothing has changed then.
void read_softness(const std::filesystem::path& path, Body& body);

/// Largest number of iterations of the scheme `equilibrium`, for users who do not choose.
inline constexpr int usual_iterations = 200;

/// An object that carries out moves as the workbench does, with one method, and notes what each pass did. One thread at
/// a time may use it. The functions that move throw Error, and nothing has moved then.
class Simulation {
 public:
  /// Takes mesh, precision, cuts, pins, softness and elasticity of a body, at rest. Throws Error if there is no such
  /// method, or if it does not work on the mesh.
  Simulation(const Body& body, std::string_view method);
  /// Moves the simulation; `other` may then only be assigned to or destroyed.
  Simulation(Simulation&& other) noexcept;
  /// Moves the simulation; `other` may then only be assigned to or destroyed.
  Simulation& operator=(Simulation&& other) noexcept;
  ~Simulation();

  /// Sets what follows each pass: at most this many sweeps or iterations of relaxation. Throws Error for a step out of
  /// its range.
  void set_relaxation(int most, const RelaxOptions& options = {});
  /// Turns on or off that passes are traced.
  void set_tracing(bool on);
  /// Sets what is called after each pass.
  void set_watcher(std::function<void()> watcher);

  /// The mesh. Recorded moves may have split it.
  const Mesh& mesh() const;
  /// Position of an element (mesh units).
  Vector3 position(ElementId element) const;

  /// Carries out recorded moves of this mesh.
  void replay(const RecordedMoves& moves);
  /// Cuts the link between two elements. Throws Error if they are not linked.
  void cut(ElementId a, ElementId b);
  /// Pins elements at their current positions. Throws Error if one is grabbed.
  void pin(const std::vector<ElementId>& elements);
  /// Grabs an element, drags it to a position (mesh units) in equal steps of one pass each, and releases it.
  void move(ElementId element, const Vector3& target, std::uint32_t steps = 1);
  /// Grabs elements that move as one rigid body.
  void grab(const std::vector<ElementId>& elements);
  /// Moves what is grabbed, from where it is, in equal steps of one pass each. Throws Error if nothing is grabbed.
  void move_handle(const Motion& motion, std::uint32_t steps = 1);
  /// Releases what is grabbed, if anything.
  void release();

  /// Returns what each pass did and the figures of the object now, for readers.
  std::string text() const;
  /// Returns the same as JSON, as `chainmail deform --json` writes it. Throws Error if the library was built without
  /// nlohmann/json.
  std::string json() const;
  /// Returns the candidates of the traced passes as CSV: `pass,order,element,sponsor,moved`.
  std::string trace_csv() const;
  /// Returns what did not go as requested: passes that did not converge or stopped before their target. Usually empty.
  std::vector<std::string> notes() const;

 private:
  friend struct Access;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes the object with its cuts at its current positions, in the format of the ending of `name`; see write_mesh() of
/// a body.
void write_mesh(std::ostream& out, const std::filesystem::path& name, const Simulation& simulation);

}  // namespace chainmail::api
