#include <string>

#include "files/dat.h"
#include "files/space.h"
#include "files/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

std::string header(const Mesh& mesh) {
  const auto& [width, height, depth] = mesh.lattice->size;
  std::string text = "# size " + std::to_string(width);
  if (height > 1 || depth > 1) {
    text += " " + std::to_string(height);
  }
  if (depth > 1) {
    text += " " + std::to_string(depth);
  }
  text += "\n# spacing ";
  append_number(text, mesh.lattice->spacing);
  return text + "\n" + space_comment(mesh, rest_positions(mesh));
}

void append_row(std::string& text, const Mesh& mesh, const Cuts& cuts, ElementId element) {
  std::string neighbours;
  std::uint64_t count = 0;
  for (EntryId entry = mesh.first_entry[element]; entry < mesh.first_entry[element + 1]; ++entry) {
    if (!cuts.is_cut(mesh.entry_link[entry])) {
      neighbours += ' ';
      append_number(neighbours, std::uint64_t{mesh.neighbours[entry]});
      ++count;
    }
  }
  append_number(text, std::uint64_t{element});
  text += ' ';
  append_number(text, count);
  text += neighbours + '\n';
}

}  // namespace

void write_dat(std::ostream& out, const Mesh& mesh, const Cuts& cuts) {
  if (!mesh.lattice) {
    throw Error(".dat", "it holds lattices alone, and this mesh stands in none", "save it as .obj");
  }
  out << header(mesh);
  std::string row;
  for (ElementId element = 0; element < mesh.element_count(); ++element) {
    row.clear();
    append_row(row, mesh, cuts, element);
    out << row;
  }
}

}  // namespace chainmail
