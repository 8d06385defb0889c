#include "files/results/peer_json.h"

#include <algorithm>

#include "files/results/json_kind.h"
#include "files/text/described_json.h"
#include "files/text/json_fields.h"
#include "files/text/text.h"
#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;
using Read = nlohmann::json;

Json points_json(const std::vector<Point>& points) {
  Json all = Json::array();
  for (const Point& point : points) {
    all.push_back({point.x(), point.y(), point.z()});
  }
  return all;
}

Json cells_json(const Mesh& mesh) { return mesh.tetrahedra.empty() ? Json(mesh.triangles) : Json(mesh.tetrahedra); }

/// Reads cases and answers. Every member is checked: they come from other programs.
class PeerReader {
 public:
  explicit PeerReader(const std::filesystem::path& path) : fields_(shown(path)) {}

  report::PeerCase read_case(const Read& json) const {
    check_kind(json, json_kinds::peer_case);
    report::PeerCase object;
    object.name = printable(fields_.text(json, "name"));
    object.description = printable(fields_.text(json, "description"));
    object.mesh = mesh(json);
    const ElementId count = object.mesh->element_count();
    object.pins = ids(fields_.array(json, "pins"), count);
    object.handle = ids(fields_.array(json, "handle"), count);
    for (const Read& move : fields_.array(json, "moves")) {
      object.moves.push_back(points(move));
      check(object.moves.back().size() == object.handle.size(),
            "a move does not have a position for each element of "
            "'handle'");
    }
    check(!object.handle.empty() && !object.moves.empty(), "'handle' or 'moves' is empty");
    object.reference = points(fields_.array(json, "reference"));
    check(object.reference.size() == count, "'reference' does not have a position for each element");
    const Read& material = fields_.object(json, "material");
    for (const Member<ElasticOptions>& member : members_of<ElasticOptions>) {
      if (is_in_cases(member)) {
        const Read& given = fields_.member(material, std::string(member.key));
        member.set(object.elastic, 0, values_of(fields_, given, member).front());
      }
    }
    object.reference_change = number_if_any(json, "reference_change");
    return object;
  }

  report::PeerAnswer read_answer(const Read& json) const {
    check_kind(json, json_kinds::peer_answer);
    report::PeerAnswer answer;
    answer.solver = printable(fields_.text(json, "solver"));
    answer.case_name = printable(fields_.text(json, "case"));
    answer.positions = points(fields_.array(json, "positions"));
    answer.factorize_ms = time_if_any(json, "factorize_ms");
    answer.grab_ms = time_if_any(json, "grab_ms");
    if (json.contains("moves_ms")) {
      for (const Read& ms : fields_.array(json, "moves_ms")) {
        answer.moves_ms.push_back(time(ms));
      }
    }
    return answer;
  }

 private:
  void check(bool is_right, const std::string& problem) const {
    if (!is_right) {
      fields_.fail(problem, "see the page Suite of the manual for the format");
    }
  }

  void check_kind(const Read& json, const JsonKind& kind) const {
    const auto is = [&](const char* key, const Read& value) { return json.contains(key) && json[key] == value; };
    check(json.is_object() && is("kind", kind.kind()), "it is not a " + kind.kind());
    check(is("schema_version", kind.schema_version),
          "its format does not have the version " + std::to_string(kind.schema_version));
  }

  double time(const Read& json) const {
    const double ms = fields_.number(json);
    check(ms >= 0, "a time is below 0");
    return ms;
  }
  std::optional<double> number_if_any(const Read& json, const char* key) const {
    return json.contains(key) ? std::optional(fields_.number(json[key])) : std::nullopt;
  }
  std::optional<double> time_if_any(const Read& json, const char* key) const {
    return json.contains(key) ? std::optional(time(json[key])) : std::nullopt;
  }

  std::vector<Point> points(const Read& json) const {
    check(json.is_array(), "a list of positions is not a list");
    std::vector<Point> points;
    for (const Read& one : json) {
      check(one.is_array() && one.size() == 3, "a position does not have three coordinates");
      points.emplace_back(fields_.number(one[0]), fields_.number(one[1]), fields_.number(one[2]));
    }
    return points;
  }

  std::vector<ElementId> ids(const Read& json, std::size_t count) const {
    std::vector<ElementId> ids;
    for (const Read& one : json) {
      check(one.is_number_unsigned() && one.get<std::uint64_t>() < count,
            "an id is not a whole number from 0 to the number of elements");
      ids.push_back(one.get<ElementId>());
    }
    std::vector<ElementId> sorted = ids;
    std::ranges::sort(sorted);
    check(std::ranges::adjacent_find(sorted) == sorted.end(), "an id appears twice in a list");
    return ids;
  }

  MeshPointer mesh(const Read& json) const {
    MeshParts parts;
    parts.rest = points(fields_.array(json, "positions"));
    for (const Read& one : fields_.array(json, "cells")) {
      check(one.is_array() && (one.size() == 3 || one.size() == 4), "a cell does not have three or four corners");
      const std::vector<ElementId> corners = ids(one, parts.rest.size());
      if (corners.size() == 3) {
        parts.triangles.push_back({corners[0], corners[1], corners[2]});
      } else {
        parts.tetrahedra.push_back({corners[0], corners[1], corners[2], corners[3]});
      }
    }
    check(parts.triangles.empty() != parts.tetrahedra.empty(),
          "'cells' is empty, or has cells of three and of four corners");
    add_links_along_edges(parts);
    const int dimension = parts.triangles.empty() ? 3 : 2;
    MeshPointer mesh = build_mesh(std::move(parts));
    check(mesh->space_dimension == dimension, "its triangles do not lie in a plane, or its tetrahedra do");
    return mesh;
  }

  JsonFields fields_;
};

template <class Result>
Result read_peer(const std::filesystem::path& path, const std::string& content,
                 Result (PeerReader::*read)(const Read&) const) {
  return (PeerReader(path).*read)(parse_json(read_text(path, content), path, content));
}

}  // namespace

bool is_in_cases(const MemberInfo& member) {
  return member.number == parameters::poisson || member.key == "law" || is_of_law(member);
}

void write_json(std::ostream& out, const report::PeerCase& object) {
  Json json{{"name", object.name},
            {"description", object.description},
            {"material", Json::object()},
            {"pins", object.pins},
            {"handle", object.handle}};
  add_members(json["material"], object.elastic, is_in_cases);
  if (object.reference_change) {
    json["reference_change"] = *object.reference_change;
  }
  std::vector<Point> rest;
  for (ElementId e = 0; e < object.mesh->element_count(); ++e) {
    rest.push_back(object.mesh->rest_position(e));
  }
  json["positions"] = points_json(rest);
  json["cells"] = cells_json(*object.mesh);
  json["moves"] = Json::array();
  for (const std::vector<Point>& move : object.moves) {
    json["moves"].push_back(points_json(move));
  }
  json["reference"] = points_json(object.reference);
  out << of_kind(json_kinds::peer_case, json).dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
}

report::PeerCase read_peer_case(const std::filesystem::path& path) {
  return read_peer(path, "a case for other solvers", &PeerReader::read_case);
}

report::PeerAnswer read_peer_answer(const std::filesystem::path& path) {
  return read_peer(path, "an answer of another solver", &PeerReader::read_answer);
}

}  // namespace chainmail
