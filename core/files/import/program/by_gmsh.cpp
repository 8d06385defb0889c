#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <string_view>

#include "files/formats/divided_cells.h"
#include "files/formats/msh.h"
#include "files/import/program/gmsh_session.h"
#include "files/import/program/tasks.h"
#include "mesh/error.h"

namespace chainmail::import {
namespace {

constexpr std::size_t beginning_bytes = 16;  // more than the longest sign

/// Gmsh recognises a mesh by its first byte: after a blank line or a byte order mark it runs the file as a script.
bool begins_as_msh(std::string_view text) {
  static constexpr std::array<std::string_view, 3> signs{"$MeshFormat", "$NOD", "$Comments"};
  return std::any_of(signs.begin(), signs.end(), [text](std::string_view sign) { return text.starts_with(sign); });
}

/// Throws Error if a .msh file does not begin like a mesh. Gmsh runs any other file as a script,
/// which may start programs and write files.
void check_beginning(const std::filesystem::path& path) {
  std::array<char, beginning_bytes> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), beginning_bytes);
  if (!begins_as_msh({bytes.data(), static_cast<std::size_t>(file.gcount())})) {
    throw Error("", "it does not begin as a Gmsh mesh, with $MeshFormat or $NOD",
                "export it again as a mesh; scripts are not run");
  }
}

/// The counts that a file states, or 0.
struct FileCounts {
  std::uint64_t points = 0;
  std::uint64_t elements = 0;  // lines, faces, cells and anything else that it counts with them
};

/// Longer lines contain numbers or binary data, and are skipped.
constexpr std::size_t longest_line = 80;

std::uint64_t first_number(const std::string& line, int nth) {
  std::istringstream words(line);
  std::uint64_t number = 0;
  for (int i = 0; i < nth; ++i) {
    words >> number;
  }
  return words ? number : 0;
}

/// Adds up the counts. take() receives each line that may begin with a keyword, and the line after it.
class Counter {
 public:
  void take(const std::string& line, const std::string& next) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    format_4_ = format_4_ || (word == "$MeshFormat" && next.starts_with('4'));
    const std::uint64_t number = first_number(next, format_4_ ? 2 : 1);
    if (word == "$Nodes") {
      counts_.points = number;
    } else if (word == "$Elements") {
      counts_.elements += number;
    }
  }

  const FileCounts& counts() const { return counts_; }

 private:
  FileCounts counts_;
  bool format_4_ = false;
};

/// Finds the counts of a .msh file, because libraries silently skip what they do not know.
FileCounts count_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Counter counter;
  std::string line, next;
  std::getline(file, line);
  while (file) {
    std::getline(file, next);
    if (line.size() <= longest_line && !line.empty()) {
      counter.take(line, next);
    }
    line.swap(next);
  }
  return counter.counts();
}

/// Maps tags to elements, in the order of the tags, and stores their positions.
class Points {
 public:
  explicit Points(MeshParts& parts) {
    std::vector<double> places, unused;
    gmsh::model::mesh::getNodes(tags_, places, unused);
    if (tags_.size() > element_limit) {
      refuse("there are more than " + std::to_string(element_limit) + " points", "use a smaller mesh");
    }
    std::vector<std::size_t> order(tags_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [this](auto i, auto j) { return tags_[i] < tags_[j]; });
    for (const std::size_t i : order) {
      parts.rest.emplace_back(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    }
    std::sort(tags_.begin(), tags_.end());
  }

  std::size_t size() const { return tags_.size(); }
  ElementId of(std::size_t tag) const {
    const auto found = std::lower_bound(tags_.begin(), tags_.end(), tag);
    if (found == tags_.end() || *found != tag) {
      refuse("point " + std::to_string(tag) + " is used but does not exist", "export it again");
    }
    return static_cast<ElementId>(found - tags_.begin());
  }

 private:
  std::vector<std::size_t> tags_;
};

template <std::size_t Size>
void take(std::vector<std::array<ElementId, Size>>& groups, const std::vector<std::size_t>& nodes,
          const Points& points) {
  for (std::size_t i = 0; i + Size <= nodes.size(); i += Size) {
    std::array<ElementId, Size> group;
    std::transform(nodes.begin() + std::ptrdiff_t(i), nodes.begin() + std::ptrdiff_t(i + Size), group.begin(),
                   [&](std::size_t tag) { return points.of(tag); });
    groups.push_back(group);
  }
}

DividedKind divided_kind(int type) {
  const MshType* const known = msh_type(type);
  if (known == nullptr || !known->divided) {
    refuse("it contains elements of higher order or of an uncommon kind (Gmsh's type " + std::to_string(type) + ")",
           "save it with elements of first or second order");
  }
  return *known->divided;
}

void take_divided(ImportedMesh& mesh, DividedKind kind, const std::vector<std::size_t>& nodes, const Points& points) {
  const std::size_t size = corner_count(kind);
  std::vector<ElementId> corners(size);
  for (std::size_t i = 0; i + size <= nodes.size(); i += size) {
    std::transform(nodes.begin() + std::ptrdiff_t(i), nodes.begin() + std::ptrdiff_t(i + size), corners.begin(),
                   [&](std::size_t tag) { return points.of(tag); });
    add_divided(mesh, kind, corners);
  }
}

void take_type(ImportedMesh& mesh, int type, const std::vector<std::size_t>& nodes, const Points& points) {
  MeshParts& parts = mesh.parts;
  switch (type) {
    case msh_point:
      return;
    case msh_line:
      return take(parts.links, nodes, points);
    case msh_triangle:
      return take(parts.triangles, nodes, points);
    case msh_quadrangle:
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (i % 4 == 0) {
          parts.polygons.push_back(4);
        }
        parts.polygons.push_back(points.of(nodes[i]));
      }
      return;
    case msh_tetrahedron:
      return take(parts.tetrahedra, nodes, points);
    case msh_hexahedron:
      return take(parts.hexahedra, nodes, points);
    default:
      return take_divided(mesh, divided_kind(type), nodes, points);
  }
}

}  // namespace

ImportedMesh read_by_gmsh(const std::filesystem::path& path) {
  check_beginning(path);
  GmshSession session;
  session.open(path);
  ImportedMesh mesh;
  const Points points(mesh.parts);
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes);
  std::size_t taken = 0;
  for (std::size_t i = 0; i < types.size(); ++i) {
    take_type(mesh, types[i], nodes[i], points);
    taken += tags[i].size();
  }
  const FileCounts stated = count_in(path);
  if (stated.elements > taken) {
    refuse("Gmsh reads only " + std::to_string(taken) + " of its " + std::to_string(stated.elements) +
               " lines, faces and cells",
           "save it as another kind of this format, or as .msh");
  }
  mesh.unused = stated.points > points.size() ? stated.points - points.size() : 0;
  return mesh;
}

}  // namespace chainmail::import
