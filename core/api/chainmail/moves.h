#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "chainmail/job.h"
#include "chainmail/mesh.h"

namespace chainmail::api {

struct Access;

/// Moves of a mesh that the workbench recorded. Copies share the data.
class RecordedMoves {
 public:
  /// Number of passes.
  std::size_t pass_count() const;
  /// The mesh after the moves: another one if they split the object.
  const Mesh& last_mesh() const;

 private:
  friend struct Access;
  struct Impl;
  explicit RecordedMoves(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// Reads recorded moves (JSON, see `chainmail compare --help`) of a mesh. Throws Error, with the number of the command,
/// if the file is damaged or the moves do not fit the mesh, or if the library was built without nlohmann/json; and
/// Cancelled.
RecordedMoves read_moves(const std::filesystem::path& path, const Mesh& mesh, const Job& job = {});

}  // namespace chainmail::api
