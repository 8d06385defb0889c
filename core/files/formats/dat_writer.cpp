#include <string>

#include "files/formats/dat.h"
#include "files/formats/mesh_state.h"
#include "files/formats/space.h"
#include "files/text/text.h"
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

void write_row(TextBlocks& text, const Mesh& mesh, const Cuts& cuts, ElementId element) {
  const auto cut = [&](EntryId entry) { return cuts.is_cut(mesh.entry_link[entry]); };
  const EntryId first = mesh.first_entry[element], last = mesh.first_entry[element + 1];
  std::uint32_t count = 0;
  for (EntryId entry = first; entry < last; ++entry) {
    count += cut(entry) ? 0 : 1;
  }
  text << element << ' ' << count;
  for (EntryId entry = first; entry < last; ++entry) {
    if (!cut(entry)) {
      text << ' ' << mesh.neighbours[entry];
    }
  }
  text << '\n';
}

}  // namespace

void write_dat(std::ostream& out, const Mesh& mesh, const Cuts& cuts, const Progress& progress) {
  if (!mesh.lattice) {
    throw Error(".dat", "it holds lattices alone, and this mesh stands in none", "save it as .obj");
  }
  out << header(mesh);
  TextBlocks text(out);
  for (ElementId element = 0; element < mesh.element_count(); ++element) {
    progress.report(element, mesh.element_count());
    write_row(text, mesh, cuts, element);
  }
  text.flush();
}

}  // namespace chainmail
