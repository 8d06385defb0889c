#include <tiny_obj_loader.h>

#include <algorithm>
#include <istream>
#include <span>
#include <streambuf>
#include <string>
#include <vector>

#include "files/formats/obj.h"
#include "files/formats/obj_scanner.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// Large enough for one call to cost nothing, small enough to stay in the cache while its shapes are made.
constexpr std::size_t piece_size = std::size_t{1} << 18;

/// Reads characters in place: std::istringstream would copy them.
class InPlace : public std::streambuf {
 public:
  explicit InPlace(std::span<char> text) { setg(text.data(), text.data(), text.data() + text.size()); }
};

std::vector<tinyobj::shape_t> load_shapes(std::span<char> text, const std::filesystem::path& path) {
  InPlace buffer(text);
  std::istream stream(&buffer);
  tinyobj::attrib_t vertices;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;  // it warns of indices without a vertex: the scanner has checked them
  const bool triangulate = false;
  if (!tinyobj::LoadObj(&vertices, &shapes, &materials, &warning, &error, &stream, nullptr, triangulate)) {
    throw Error(shown(path), "tinyobjloader refuses it (" + printable(error) + ")", "export it anew as plain OBJ");
  }
  return shapes;
}

void add_face(MeshParts& parts, const tinyobj::index_t* corner, std::size_t count) {
  const auto id = [&](std::size_t i) { return static_cast<ElementId>(corner[i % count].vertex_index); };
  for (std::size_t i = 0; i < count; ++i) {
    parts.links.push_back({id(i), id(i + 1)});
  }
  if (count == 3) {
    parts.triangles.push_back({id(0), id(1), id(2)});
    return;
  }
  parts.polygons.push_back(static_cast<ElementId>(count));
  for (std::size_t i = 0; i < count; ++i) {
    parts.polygons.push_back(id(i));
  }
}

void add_shape(MeshParts& parts, const tinyobj::shape_t& shape) {
  const auto* corner = shape.mesh.indices.data();
  for (const std::size_t count : shape.mesh.num_face_vertices) {
    add_face(parts, corner, count);
    corner += count;
  }
  corner = shape.lines.indices.data();
  for (const int count : shape.lines.num_line_vertices) {
    for (int i = 1; i < count; ++i) {
      parts.links.push_back(
          {static_cast<ElementId>(corner[i - 1].vertex_index), static_cast<ElementId>(corner[i].vertex_index)});
    }
    corner += count;
  }
}

/// Piece by piece, so that what tinyobjloader makes of a line, a dozen times its size, is never there for all lines.
void add_shapes(MeshParts& parts, std::string& text, const std::filesystem::path& path, const Progress& progress) {
  for (std::size_t begin = 0; begin < text.size();) {
    progress.report(double(begin) / double(text.size()));
    const std::size_t end =
        std::min(text.find('\n', std::min(begin + piece_size, text.size() - 1)), text.size() - 1) + 1;
    for (const auto& shape : load_shapes(std::span(text).subspan(begin, end - begin), path)) {
      add_shape(parts, shape);
    }
    begin = end;
  }
}

}  // namespace

MeshPointer read_obj(std::string_view text, const std::filesystem::path& path, const ReadOptions& options,
                     const Progress& progress) {
  ObjText file = scan_obj(text, path, progress.part(0, 0.5));
  MeshParts parts;
  parts.rest = std::move(file.vertices);
  add_shapes(parts, file.faces_and_lines, path, progress.part(0.5, 0.8));
  parts.space_dimension = chosen_space(parts, options.space_dimension, file.space, path);
  return build_mesh(std::move(parts), progress.part(0.8, 1));
}

}  // namespace chainmail
