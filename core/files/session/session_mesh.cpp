#include <algorithm>
#include <cmath>
#include <numeric>

#include "files/formats/neighbour_rows.h"
#include "files/session/session_fields.h"
#include "files/session/session_texture.h"
#include "mesh/error.h"

// The mesh of a session.
namespace chainmail {

std::size_t SessionFields::packed(const Json& object, const char* key) const {
  const Json& json = member(object, key);
  if (!json.is_number_unsigned()) {
    fail("'" + std::string(key) + "' is not an array", "write it in [ ]");
  }
  return json.get<std::size_t>();
}

const std::vector<std::uint32_t>& SessionFields::elements(const Json& object, const char* key,
                                                          std::uint64_t count) const {
  const auto& result = ids(object, key);
  const auto beyond = std::find_if(result.begin(), result.end(), [count](auto id) { return id >= count; });
  if (beyond != result.end()) {
    fail("'" + std::string(key) + "' names element " + std::to_string(*beyond) + ", which is not there",
         "ids run from 0 to " + std::to_string(count - 1));
  }
  return result;
}

void SessionFields::check_groups(std::size_t size, std::size_t of_each, const char* key) const {
  if (size % of_each != 0) {
    fail("'" + std::string(key) + "' ends within a group of " + std::to_string(of_each), "give each of them whole");
  }
}

std::uint64_t SessionFields::count(const Json& object, const char* key, std::uint64_t highest) const {
  const Json& json = member(object, key);
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() == 0 || json.get<std::uint64_t>() > highest) {
    fail("'" + std::string(key) + "' is no whole number from 1 to " + std::to_string(highest), "give one");
  }
  return json.get<std::uint64_t>();
}

LinkId SessionFields::link(const Mesh& mesh, ElementId a, ElementId b) const {
  const auto found = find_link(mesh, a, b);
  if (!found) {
    fail("the elements " + std::to_string(a) + " and " + std::to_string(b) + " are not linked",
         "give the two ends of a link");
  }
  return *found;
}

namespace {

using Json = nlohmann::json;

class MeshReader {
 public:
  MeshReader(const SessionFields& fields, const Json& object)
      : fields_(fields), object_(object), count_(fields.count(object, "elements", element_limit)) {}

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

  const SessionFields& fields_;
  const Json& object_;
  std::uint64_t count_;  // of elements
  MeshParts parts_;
};

void MeshReader::take_rest(const Progress& progress) {
  const auto& rest = fields_.reals(object_, "rest");
  if (rest.size() != 3 * count_) {
    fields_.fail("'rest' holds " + std::to_string(rest.size()) + " numbers, and " + std::to_string(count_) +
                     " elements have " + std::to_string(3 * count_),
                 "give three coordinates of each element");
  }
  parts_.rest.reserve(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    progress.report(i, count_);
    const Point point(rest[3 * i], rest[3 * i + 1], rest[3 * i + 2]);
    if (!(point.cwiseAbs().maxCoeff() <= coordinate_limit)) {
      fields_.fail("'rest' places element " + std::to_string(i) + " beyond 1e100", "scale the mesh down");
    }
    parts_.rest.push_back(point);
  }
}

/// Who says that elements stand in a lattice must have them stand there.
void MeshReader::take_lattice() {
  if (!object_.contains("lattice")) {
    return;
  }
  const Json& json = fields_.object(object_, "lattice");
  fields_.check_keys(json, {"size", "spacing"});
  const Json& size = fields_.array(json, "size");
  Lattice lattice;
  lattice.spacing = fields_.number(fields_.member(json, "spacing"));
  double product = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool whole = size.size() == 3 && size[k].is_number_unsigned() && size[k].get<std::uint64_t>() <= count_;
    lattice.size[k] = whole ? size[k].get<std::uint32_t>() : 0;
    product *= lattice.size[k];
  }
  if (product != double(count_)) {
    fields_.fail("the lattice is not one of " + std::to_string(count_) + " elements", "write its size [w, h, d]");
  }
  for (ElementId e = 0; e < count_; ++e) {
    if (parts_.rest[e] != lattice.position(e)) {
      fields_.fail("element " + std::to_string(e) + " does not stand in the lattice", "leave the lattice out");
    }
  }
  parts_.lattice = lattice;
}

template <std::size_t Size>
std::vector<std::array<ElementId, Size>> MeshReader::groups(const char* key, const Progress& progress) const {
  const auto& ids = fields_.elements(object_, key, count_);
  fields_.check_groups(ids.size(), Size, key);
  std::vector<std::array<ElementId, Size>> result(ids.size() / Size);
  for (std::size_t i = 0; i < result.size(); ++i) {
    progress.report(i, result.size());
    std::copy_n(ids.begin() + static_cast<std::ptrdiff_t>(i * Size), Size, result[i].begin());
  }
  return result;
}

void MeshReader::take_links(const Progress& progress) {
  parts_.links = groups<2>("links", progress);
  for (const auto& [a, b] : parts_.links) {
    if (a == b) {
      fields_.fail("element " + std::to_string(a) + " is linked to itself", "remove that link");
    }
  }
}

void MeshReader::take_neighbours(const Progress& progress) {
  const auto& counts = fields_.ids(object_, "counts");
  parts_.neighbours = fields_.elements(object_, "neighbours", count_);
  const auto sum = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (counts.size() != count_ || sum != parts_.neighbours.size()) {
    fields_.fail("'counts' and 'neighbours' do not go together",
                 "give a count of each element, and as many neighbours as they add up to");
  }
  parts_.first_entry.assign(count_ + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), parts_.first_entry.begin() + 1);
  if (const auto fault = find_row_fault(parts_.first_entry, parts_.neighbours, progress)) {
    fields_.fail(fault->problem, fault->remedy);
  }
}

void MeshReader::check_polygons() const {
  const auto& all = parts_.polygons;
  for (std::size_t i = 0; i < all.size(); i += std::size_t{all[i]} + 1) {
    if (all[i] < 3 || all[i] >= all.size() - i) {
      fields_.fail("'polygons' has a count of " + std::to_string(all[i]) + " at number " + std::to_string(i),
                   "give each polygon as its count, 3 or more, and so many ids");
    }
    for (std::size_t j = i + 1; j <= i + all[i]; ++j) {
      if (all[j] >= count_) {
        fields_.fail("'polygons' names element " + std::to_string(all[j]) + ", which is not there",
                     "ids run from 0 to " + std::to_string(count_ - 1));
      }
    }
  }
}

void MeshReader::take_faces(const Progress& progress) {
  parts_.triangles = groups<3>("triangles", progress);
  parts_.tetrahedra = groups<4>("tetrahedra", progress);
  if (object_.contains("hexahedra")) {  // not so where an older program wrote it
    parts_.hexahedra = groups<8>("hexahedra", progress);
  }
  parts_.polygons = fields_.ids(object_, "polygons");
  check_polygons();
}

MeshPointer MeshReader::read(const Progress& progress) {
  fields_.check_keys(object_, {"elements", "space", "lattice", "rest", "links", "counts", "neighbours", "triangles",
                               "polygons", "tetrahedra", "hexahedra", "texture"});
  parts_.space_dimension = static_cast<int>(fields_.count(object_, "space", 3));
  take_rest(progress.part(0, 0.1));
  take_lattice();
  const bool ordered = !object_.contains("links");
  const std::size_t links = ordered ? 0 : fields_.ids(object_, "links").size() / 2;
  ordered ? take_neighbours(progress.part(0.1, 0.2)) : take_links(progress.part(0.1, 0.2));
  take_faces(progress.part(0.2, 0.3));
  parts_.texture = read_session_texture(fields_, object_, progress.part(0.3, 0.4));
  MeshPointer mesh;
  try {
    mesh = build_mesh(std::move(parts_), progress.part(0.4, 1));
  } catch (const Error& error) {
    throw error.at(fields_.where() + ": " + error.where());
  }
  if (!ordered && mesh->link_count() != links) {
    fields_.fail("'links' holds a link twice", "give each link once");
  }
  return mesh;
}

}  // namespace

MeshPointer read_session_mesh(const SessionFields& fields, const Json& object, const Progress& progress) {
  return MeshReader(fields, object).read(progress);
}

}  // namespace chainmail
