#include "files/session/session_mesh.h"

#include <algorithm>
#include <array>
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

/// Reads the members of a mesh one after another.
class SessionMeshReader {
 public:
  SessionMeshReader(const ObjectFields& fields, const Json& object)
      : fields_(fields), object_(object), count_(fields.whole(object, "elements", 1, element_limit)) {}

  MeshPointer read(const Progress& progress) {
    fields_.check_keys(object_, {"elements", "space", "lattice", "rest", "links", "counts", "neighbours", "triangles",
                                 "polygons", "tetrahedra", "hexahedra", "texture"});
    parts_.space_dimension = static_cast<int>(fields_.whole(object_, "space", 1, 3));
    take_rest(progress.part(0, 0.1));
    take_lattice();
    const bool ordered = !object_.contains("links");
    ordered ? take_neighbours(progress.part(0.1, 0.2)) : take_links();
    const std::size_t links = parts_.links.size();
    progress.report(0.2);
    take_faces();
    progress.report(0.3);
    take_texture();
    MeshPointer mesh = fields_.here([&] { return build_mesh(std::move(parts_), progress.part(0.4, 1)); });
    if (!ordered && mesh->link_count() != links) {
      fields_.fail("'links' contains a link twice", "give each link once");
    }
    return mesh;
  }

 private:
  void take_rest(const Progress& progress) {
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
  void take_lattice() {
    if (!object_.contains("lattice")) {
      return;
    }
    const Json& json = fields_.object(object_, "lattice");
    fields_.check_keys(json, {"size", "spacing"});
    Lattice lattice{size(json, count_), fields_.number(fields_.member(json, "spacing"), parameters::spacing)};
    if (double(lattice.size[0]) * lattice.size[1] * lattice.size[2] != double(count_)) {
      fields_.fail("the size of the lattice does not give " + std::to_string(count_) + " elements",
                   "write its size [w, h, d]");
    }
    for (ElementId e = 0; e < count_; ++e) {
      if (parts_.rest[e] != lattice.position(e)) {
        fields_.fail("element " + std::to_string(e) + " is not at its position in the lattice",
                     "leave the lattice out");
      }
    }
    parts_.lattice = lattice;
  }
  void take_links() {
    parts_.links = groups<2>("links");
    for (const auto& [a, b] : parts_.links) {
      if (a == b) {
        fields_.fail("element " + std::to_string(a) + " is linked to itself", "remove that link");
      }
    }
  }
  void take_neighbours(const Progress& progress) {
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
  void take_faces() {
    parts_.triangles = groups<3>("triangles");
    parts_.tetrahedra = groups<4>("tetrahedra");
    if (object_.contains("hexahedra")) {  // older programs do not write them
      parts_.hexahedra = groups<8>("hexahedra");
    }
    const auto& all = parts_.polygons = fields_.packed(object_, "polygons").ids;
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
  void take_texture() {
    if (!object_.contains("texture")) {
      return;
    }
    const Json& json = fields_.object(object_, "texture");
    fields_.check_keys(json, {"size", "channels", "box", "texels"});
    Texture texture{size(json, UINT32_MAX), static_cast<int>(fields_.whole(json, "channels", 1, 4)), {}, box(json)};
    const auto& [width, height, depth] = texture.size;
    const double bytes = double(texture.channels) * width * height * depth;
    if (bytes == 0 || (texture.channels != 1 && texture.channels != 4)) {
      fields_.fail("the texture has no size [w, h, d] of texels with 1 or 4 channels", "give both");
    }
    const Json& text = fields_.member(json, "texels");
    auto texels = text.is_string() ? from_base64(text.get_ref<const std::string&>()) : std::nullopt;
    if (!texels || double(texels->size()) != bytes) {
      fields_.fail("'texels' does not contain one byte for each channel of each texel", "write them in base 64");
    }
    texture.texels = std::move(*texels);
    parts_.texture = std::make_shared<const Texture>(std::move(texture));
  }
  /// Returns the member `size`: three whole numbers. They are 0 if it is anything else.
  std::array<std::uint32_t, 3> size(const Json& object, std::uint64_t most) const {
    const Json& json = fields_.array(object, "size");
    std::array<std::uint32_t, 3> size{};
    for (std::size_t k = 0; k < 3 && json.size() == 3; ++k) {
      const bool fits = json[k].is_number_unsigned() && json[k].get<std::uint64_t>() <= most;
      size[k] = fits ? json[k].get<std::uint32_t>() : 0;
    }
    return size;
  }
  std::array<Point, 2> box(const Json& texture) const {
    const Json& numbers = fields_.array(texture, "box");
    if (numbers.size() != 6) {
      fields_.fail("'box' contains " + std::to_string(numbers.size()) + " numbers",
                   "give its lowest and its highest corner");
    }
    std::array<Point, 2> box;
    for (std::size_t i = 0; i < 6; ++i) {
      box[i / 3][static_cast<Eigen::Index>(i % 3)] = fields_.number(numbers[i]);
    }
    const Point extent = box[1] - box[0];
    if (!(extent.x() > 0 && extent.y() > 0 && extent.z() >= 0)) {
      fields_.fail("'box' is not the box of a texture", "give its lowest and its highest corner");
    }
    return box;
  }
  template <std::size_t Size>
  std::vector<std::array<ElementId, Size>> groups(const char* key) const {
    return fields_.groups<Size>(fields_.elements(object_, key, count_).ids, key);
  }

  const ObjectFields& fields_;
  const Json& object_;
  std::uint64_t count_;  // of elements
  MeshParts parts_;
};

}  // namespace

MeshPointer read_session_mesh(const ObjectFields& fields, const nlohmann::json& object, const Progress& progress) {
  return SessionMeshReader(fields, object).read(progress);
}

}  // namespace chainmail
