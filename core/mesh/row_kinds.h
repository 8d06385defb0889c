#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/progress.h"

namespace chainmail {

struct Mesh;

/// Fills the table of rest vectors of a mesh that has few: the distinct ones, and which one each entry of the
/// neighbour table has. A mesh with more than Mesh::shape_limit of them keeps both tables empty.
void number_shapes(Mesh& mesh, const Progress& progress);

/// The kinds of rows of the neighbour table. Two rows are of one kind if their neighbours are as far from their
/// elements in id, and their rest vectors are the same if they are numbered. A lattice has few kinds, 27 in a solid:
/// its passes read one byte per element instead of a row.
struct RowKinds {
  static constexpr std::size_t limit = 256;

  /// The kind of each element; empty if there are more than `limit`.
  std::vector<std::uint8_t> of;
  /// Kind k has the entries [first[k] .. first[k + 1]).
  std::vector<std::uint32_t> first;
  /// Of each entry: the id of the neighbour less that of the element, modulo 2³².
  std::vector<std::uint32_t> offset;
  /// Of each entry: the number of its rest vector (Mesh::entry_shape); empty if they are not numbered.
  std::vector<std::uint16_t> shape;

  bool known() const { return !of.empty(); }
};

/// Returns the kinds of the rows of a mesh whose neighbour table is complete. Gives up early for an irregular mesh.
RowKinds find_row_kinds(const Mesh& mesh, const Progress& progress);

}  // namespace chainmail
