#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "body/softness.h"
#include "equilibrium/relaxation_scheme.h"
#include "files/text/json_fields.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

inline constexpr unsigned session_version = 2;

/// The JSON of a session. Long arrays of numbers are packed, outside the tree: in the tree, the index in `ids` or
/// `reals` takes the place of an array. Recorded moves stay in the text, because they are read after the mesh.
struct SessionJson {  // NOLINT(bugprone-exception-escape): moving a tree throws nothing, which its library does not say
  nlohmann::json tree;
  std::vector<std::vector<std::uint32_t>> ids;
  std::vector<std::vector<double>> reals;
  std::string_view moves;  // the array or object `moves` in the parsed text; null in the tree
};

/// Parses the text of a session. Throws Error if it is not JSON, if an array of ids or numbers holds anything else, if
/// a key appears twice, or if the version is newer than session_version. The version is checked before the rest. Throws
/// Cancelled.
SessionJson parse_session_json(std::string_view text, const std::filesystem::path& path, const Progress& progress);

/// Checks and returns the members that describe an object.
class ObjectFields : public JsonFields {
 public:
  using JsonFields::JsonFields;

  /// Returns the numbers of a softness, named as in the table of parameters. Those of the energy may be left out.
  LinkSoftness softness(const Json& object) const;
  /// Returns the kind of energy of a softness, or `absent` if it is left out.
  EnergyKind energy(const Json& object, EnergyKind absent = link_energy) const;
  /// Returns the axes of a softness for this mesh; those of the world if they are left out. Principal axes without a
  /// rotation are found in the mesh, which takes time in proportion to its size, and are kept in `principal`.
  RegionAxes axes(const Json& object, const Mesh& mesh, std::optional<RegionAxes>& principal) const;
  /// Returns a rotation vector: the axis times the angle (radians).
  Point rotation_vector(const Json& object, const std::string& key) const;
  RelaxationScheme relaxation_scheme(const Json& name) const;
};

/// Returns the names of the members that ObjectFields::softness reads.
std::vector<std::string> softness_keys();
/// Adds the global softness, the kind of energy and axes other than those of the world to an object, as ObjectFields
/// reads them.
void add_softness(nlohmann::ordered_json& object, const Softness& softness);

/// Checks and returns the members of a session, the packed ones too.
class SessionFields : public ObjectFields {
 public:
  SessionFields(const std::string& where, const SessionJson& json) : ObjectFields(where), json_(json) {}

  const std::vector<std::uint32_t>& ids(const Json& object, const char* key) const {
    return json_.ids[packed(object, key)];
  }
  const std::vector<double>& reals(const Json& object, const char* key) const {
    return json_.reals[packed(object, key)];
  }
  /// Returns ids that are all below a number of elements.
  const std::vector<std::uint32_t>& elements(const Json& object, const char* key, std::uint64_t count) const;
  /// Requires an array to hold whole groups of `of_each` numbers.
  void check_groups(std::size_t size, std::size_t of_each, const char* key) const;
  /// Returns a whole number from 1 to `highest`.
  std::uint64_t count(const Json& object, const char* key, std::uint64_t highest) const;
  LinkId link(const Mesh& mesh, ElementId a, ElementId b) const;

 private:
  std::size_t packed(const Json& object, const char* key) const;

  const SessionJson& json_;
};

}  // namespace chainmail
