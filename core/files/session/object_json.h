#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "body/softness.h"
#include "files/text/json_fields.h"
#include "mesh/mesh.h"
#include "solver/algorithms.h"

namespace chainmail {

/// Checks and returns the members that describe an object, in sessions and recorded moves.
class ObjectFields : public JsonFields {
 public:
  using JsonFields::JsonFields;

  /// Returns the same for a part of the file, which is in its errors.
  ObjectFields at(const std::string& part) const;
  /// Throws Error if there is no element with this id.
  void check_element(std::uint64_t id, std::uint64_t count, const std::string& key) const;
  /// Returns a packed array whose ids are all below a number of elements.
  const PackedArray& elements(const Json& object, const std::string& key, std::uint64_t count,
                              std::initializer_list<std::size_t> widths = {0}) const;
  /// Returns ids in groups, which must be whole.
  template <std::size_t Size>
  std::vector<std::array<ElementId, Size>> groups(const std::vector<ElementId>& ids, const std::string& key) const {
    check_groups(ids.size(), Size, key);
    std::vector<std::array<ElementId, Size>> result(ids.size() / Size);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      result[i / Size][i % Size] = ids[i];
    }
    return result;
  }
  LinkId link(const Mesh& mesh, ElementId a, ElementId b) const;
  Algorithm algorithm(const Json& name) const;
  /// Returns the softness of all links, without that of single ones. `energy` is the kind of energy if the object names
  /// none. Principal axes without a rotation are found in the mesh, which takes time in proportion to its size, and are
  /// kept in `principal`.
  Softness softness(const Json& object, const Mesh& mesh, EnergyKind energy,
                    std::optional<RegionAxes>& principal) const;
  /// Adds the softness of single links: of each link two ends, and the same count of numbers.
  void add_own(OwnSoftness& all, const Mesh& mesh, std::span<const ElementId> ends,
               std::span<const double> numbers) const;

 private:
  RegionAxes axes(const Json& object, const Mesh& mesh, std::optional<RegionAxes>& principal) const;
};

/// Returns the keys that ObjectFields::softness reads, and others.
std::vector<std::string> softness_keys(const std::vector<std::string>& others);
/// Adds the softness of all links to an object, as ObjectFields::softness reads it.
void add_softness(nlohmann::ordered_json& object, const Softness& softness);

}  // namespace chainmail
