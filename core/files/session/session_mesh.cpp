#include "files/session/session_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>

#include "files/formats/neighbour_rows.h"
#include "files/text/base64.h"
#include "mesh/error.h"
#include "mesh/texture.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

std::array<Point, 2> read_texture_box(const ObjectFields& fields, const nlohmann::json& texture) {
  const auto& numbers = fields.array(texture, "box");
  if (numbers.size() != 6) {
    fields.fail("'box' contains " + std::to_string(numbers.size()) + " numbers",
                "give its lowest and its highest corner");
  }
  std::array<Point, 2> box;
  for (std::size_t i = 0; i < 6; ++i) {
    box[i / 3][static_cast<Eigen::Index>(i % 3)] = fields.number(numbers[i]);
  }
  const Point extent = box[1] - box[0];
  if (!(box[0].cwiseAbs().maxCoeff() <= coordinate_limit && box[1].cwiseAbs().maxCoeff() <= coordinate_limit) ||
      !(extent.x() > 0 && extent.y() > 0 && extent.z() >= 0)) {
    fields.fail("'box' is not the box of a texture", "give its lowest and its highest corner");
  }
  return box;
}

/// Reads the texture of a mesh, if it has one.
std::shared_ptr<const Texture> read_texture(const ObjectFields& fields, const Json& mesh, const Progress& progress) {
  if (!mesh.contains("texture")) {
    return nullptr;
  }
  progress.report(0);
  const auto& json = fields.object(mesh, "texture");
  fields.check_keys(json, {"size", "channels", "box", "texels"});
  const auto& size = fields.array(json, "size");
  Texture texture;
  double bytes = double(fields.whole(json, "channels", 1, 4));
  texture.channels = static_cast<int>(bytes);
  for (std::size_t k = 0; k < 3; ++k) {
    const bool whole = size.size() == 3 && size[k].is_number_unsigned() && size[k].get<std::uint64_t>() <= UINT32_MAX;
    texture.size[k] = whole ? size[k].get<std::uint32_t>() : 0;
    bytes *= texture.size[k];
  }
  if (bytes == 0 || (texture.channels != 1 && texture.channels != 4)) {
    fields.fail("the texture has no size [w, h, d] of texels with 1 or 4 channels", "give both");
  }
  texture.box = read_texture_box(fields, json);
  const auto& text = fields.member(json, "texels");
  auto texels = text.is_string() ? from_base64(text.get_ref<const std::string&>()) : std::nullopt;
  if (!texels || double(texels->size()) != bytes) {
    fields.fail("'texels' does not contain one byte for each channel of each texel", "write them in base 64");
  }
  texture.texels = std::move(*texels);
  return std::make_shared<const Texture>(std::move(texture));
}

class SessionMeshReader {
 public:
  SessionMeshReader(const ObjectFields& fields, const Json& object)
      : fields_(fields), object_(object), count_(fields.whole(object, "elements", 1, element_limit)) {}

  MeshPointer read(const Progress& progress);

 private:
  void take_rest(const Progress& progress);
  void take_lattice();
  void take_links(const Progress& progress);
  void take_neighbours(const Progress& progress);
  void take_faces(const Progress& progress);
  void check_polygons() const;
  template <std::size_t Size>
  std::vector<std::array<ElementId, Size>> groups(const char* key, const Progress& progress) const;

  const ObjectFields& fields_;
  const Json& object_;
  std::uint64_t count_;  // of elements
  MeshParts parts_;
};

void SessionMeshReader::take_rest(const Progress& progress) {
  const auto& rest = fields_.packed(object_, "rest").reals;
  if (rest.size() != 3 * count_) {
    fields_.fail("'rest' contains " + std::to_string(rest.size()) + " numbers, but " + std::to_string(count_) +
                     " elements have " + std::to_string(3 * count_),
                 "give three coordinates of each element");
  }
  parts_.rest.reserve(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    progress.report(i, count_);
    const Point point(rest[3 * i], rest[3 * i + 1], rest[3 * i + 2]);
    if (!(point.cwiseAbs().maxCoeff() <= coordinate_limit)) {
      fields_.fail("'rest' puts element " + std::to_string(i) + " beyond 1e100", "scale the mesh down");
    }
    parts_.rest.push_back(point);
  }
}

/// Requires that all elements have the positions of the lattice.
void SessionMeshReader::take_lattice() {
  if (!object_.contains("lattice")) {
    return;
  }
  const Json& json = fields_.object(object_, "lattice");
  fields_.check_keys(json, {"size", "spacing"});
  const Json& size = fields_.array(json, "size");
  Lattice lattice;
  lattice.spacing = fields_.number(fields_.member(json, "spacing"), parameters::spacing);
  double product = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool whole = size.size() == 3 && size[k].is_number_unsigned() && size[k].get<std::uint64_t>() <= count_;
    lattice.size[k] = whole ? size[k].get<std::uint32_t>() : 0;
    product *= lattice.size[k];
  }
  if (product != double(count_)) {
    fields_.fail("the size of the lattice does not give " + std::to_string(count_) + " elements",
                 "write its size [w, h, d]");
  }
  for (ElementId e = 0; e < count_; ++e) {
    if (parts_.rest[e] != lattice.position(e)) {
      fields_.fail("element " + std::to_string(e) + " is not at its position in the lattice", "leave the lattice out");
    }
  }
  parts_.lattice = lattice;
}

template <std::size_t Size>
std::vector<std::array<ElementId, Size>> SessionMeshReader::groups(const char* key, const Progress& progress) const {
  const auto& ids = fields_.elements(object_, key, count_).ids;
  fields_.check_groups(ids.size(), Size, key);
  std::vector<std::array<ElementId, Size>> result(ids.size() / Size);
  for (std::size_t i = 0; i < result.size(); ++i) {
    progress.report(i, result.size());
    std::copy_n(ids.begin() + static_cast<std::ptrdiff_t>(i * Size), Size, result[i].begin());
  }
  return result;
}

void SessionMeshReader::take_links(const Progress& progress) {
  parts_.links = groups<2>("links", progress);
  for (const auto& [a, b] : parts_.links) {
    if (a == b) {
      fields_.fail("element " + std::to_string(a) + " is linked to itself", "remove that link");
    }
  }
}

void SessionMeshReader::take_neighbours(const Progress& progress) {
  const auto& counts = fields_.packed(object_, "counts").ids;
  parts_.neighbours = fields_.elements(object_, "neighbours", count_).ids;
  const auto sum = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (counts.size() != count_ || sum != parts_.neighbours.size()) {
    fields_.fail("'counts' and 'neighbours' do not match",
                 "give one count per element, and as many neighbours as the sum of the counts");
  }
  parts_.first_entry.assign(count_ + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), parts_.first_entry.begin() + 1);
  if (const auto fault = find_row_fault(parts_.first_entry, parts_.neighbours, progress)) {
    fields_.fail(fault->problem, fault->remedy);
  }
}

void SessionMeshReader::check_polygons() const {
  const auto& all = parts_.polygons;
  for (std::size_t i = 0; i < all.size(); i += std::size_t{all[i]} + 1) {
    if (all[i] < 3 || all[i] >= all.size() - i) {
      fields_.fail("'polygons' has a count of " + std::to_string(all[i]) + " at number " + std::to_string(i),
                   "write each polygon as its count, 3 or more, and as many ids");
    }
    for (std::size_t j = i + 1; j <= i + all[i]; ++j) {
      fields_.check_element(all[j], count_, "polygons");
    }
  }
}

void SessionMeshReader::take_faces(const Progress& progress) {
  parts_.triangles = groups<3>("triangles", progress);
  parts_.tetrahedra = groups<4>("tetrahedra", progress);
  if (object_.contains("hexahedra")) {  // older programs do not write them
    parts_.hexahedra = groups<8>("hexahedra", progress);
  }
  parts_.polygons = fields_.packed(object_, "polygons").ids;
  check_polygons();
}

MeshPointer SessionMeshReader::read(const Progress& progress) {
  fields_.check_keys(object_, {"elements", "space", "lattice", "rest", "links", "counts", "neighbours", "triangles",
                               "polygons", "tetrahedra", "hexahedra", "texture"});
  parts_.space_dimension = static_cast<int>(fields_.whole(object_, "space", 1, 3));
  take_rest(progress.part(0, 0.1));
  take_lattice();
  const bool ordered = !object_.contains("links");
  const std::size_t links = ordered ? 0 : fields_.packed(object_, "links").ids.size() / 2;
  ordered ? take_neighbours(progress.part(0.1, 0.2)) : take_links(progress.part(0.1, 0.2));
  take_faces(progress.part(0.2, 0.3));
  parts_.texture = read_texture(fields_, object_, progress.part(0.3, 0.4));
  MeshPointer mesh = fields_.here([&] { return build_mesh(std::move(parts_), progress.part(0.4, 1)); });
  if (!ordered && mesh->link_count() != links) {
    fields_.fail("'links' contains a link twice", "give each link once");
  }
  return mesh;
}

}  // namespace

MeshPointer read_session_mesh(const ObjectFields& fields, const nlohmann::json& object, const Progress& progress) {
  return SessionMeshReader(fields, object).read(progress);
}

}  // namespace chainmail
