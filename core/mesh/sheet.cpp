#include "mesh/sheet.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/error.h"

namespace chainmail {
namespace {

/// Returns the coordinate of element i of n along a side (mesh units). The last one is exactly at the end.
double coordinate(std::uint32_t i, std::uint32_t n, std::uint32_t side) { return double(i) * side / (n - 1); }

void add_square(MeshParts& parts, ElementId a, std::uint32_t width) {
  const ElementId b = a + 1, c = a + width, d = c + 1;
  parts.triangles.push_back({a, b, d});
  parts.triangles.push_back({a, d, c});
  parts.links.push_back({a, d});
}

}  // namespace

std::array<std::uint32_t, 2> sheet_size(std::array<std::uint32_t, 2> picture, std::uint32_t across) {
  const double squares = std::round((across - 1.0) * picture[1] / picture[0]);
  return {across, static_cast<std::uint32_t>(std::clamp(squares, 1.0, double(element_limit))) + 1};
}

MeshPointer make_sheet(Texture picture, std::uint32_t across, const Progress& progress) {
  const std::array<std::uint32_t, 2> pixels{picture.size[0], picture.size[1]};
  if (across < 2) {
    throw Error("sheet", "it needs at least 2 elements across", "use 2 or more");
  }
  const auto [width, height] = sheet_size(pixels, across);
  const std::uint64_t count = std::uint64_t{width} * height;
  if (count > element_limit) {
    throw Error("sheet", "it would have more than " + std::to_string(element_limit) + " elements",
                "use fewer elements across");
  }
  MeshParts parts;
  parts.space_dimension = 2;
  parts.rest.reserve(count);
  parts.links.reserve(3 * count);
  parts.triangles.reserve(2 * count);
  for (ElementId e = 0; e < count; ++e) {
    progress.part(0, 0.3).report(e, count);
    const std::uint32_t x = e % width, y = e / width;
    parts.rest.emplace_back(coordinate(x, width, pixels[0]), coordinate(y, height, pixels[1]), 0);
    if (x + 1 < width) {
      parts.links.push_back({e, e + 1});
    }
    if (y + 1 < height) {
      parts.links.push_back({e, e + width});
    }
    if (x + 1 < width && y + 1 < height) {
      add_square(parts, e, width);
    }
  }
  picture.box = {Point::Zero(), Point(pixels[0], pixels[1], 0)};
  parts.texture = std::make_shared<const Texture>(std::move(picture));
  return build_mesh(std::move(parts), progress.part(0.3, 1));
}

bool is_sheet(const Mesh& mesh) {
  const auto& texture = mesh.texture;
  return texture && texture->channels == 4 && texture->size[2] == 1 && !mesh.triangles.empty() &&
         mesh.space_dimension == 2 && mesh.axes[0] == 0 && mesh.axes[1] == 1;
}

}  // namespace chainmail
