#include "elastic/material.h"
#include "files/schema/command_schemas.h"
#include "files/session/lesson.h"
#include "files/session/moves.h"
#include "files/session/session.h"
#include "files/session/softness_presets.h"
#include "files/text/limits.h"
#include "simulate/command.h"

namespace chainmail::schema {
namespace {

Json preset() {
  const Json name = with(non_empty_text("one line", limits::preset_name_bytes), "pattern", "^[^ ](.*[^ ])?$");
  const Json one = object(joined({{{"name", name}}, region()}), described<LinkSoftness>(is_optional));
  return object({{"version", one_of(Json::array({presets_version}))}, {"presets", array_of(one)}});
}

Json moves() {
  const Json version = whole(1, newest_moves_version,
                             "2 if moves split the object, 3 if relaxation ran between them, 4 if they split cells");
  const Json command = commands_of(std::type_identity<Command>());
  return object({{"version", version}, {"commands", array_of(command)}}, {}, "recorded moves, from rest");
}

/// The mesh before all splits.
Json mesh_with(const Members& links) {
  const Json size = array_of(from_one(), "along each axis", 3, 3);
  const Json texture = object({{"size", size},
                               {"channels", one_of({1, 4})},
                               {"box", numbers(6, "lowest x, y, z, then highest x, y, z (mesh units)")},
                               {"texels", with(text("bytes in base 64"), "contentEncoding", "base64")}});
  const Json lattice = object({{"size", size}, {"spacing", schema_of(parameters::spacing)}}, {}, "grid of elements");
  const Members parts{{"elements", from_one("number of elements")},
                      {"space", whole(1, 3, "number of coordinates")},
                      {"rest", array_of(number(), "x, y, z of each element at rest (mesh units)")},
                      {"triangles", ids("three ids of each triangle")},
                      {"polygons", ids("a count, then as many ids, of each polygon")},
                      {"tetrahedra", ids("four ids of each tetrahedron")}};
  return object(joined({parts, links}),
                {{"hexahedra", ids("eight ids of each hexahedron")}, {"lattice", lattice}, {"texture", texture}});
}

Json mesh() {
  const Json name = with(text("name of a mesh or a picture in the same folder"), "pattern", R"(^[^./\\][^/\\]*$)");
  const Member across{"across", from_one("number of elements along the width of a picture")};
  return any_of({object({{"file", name}}, {across}, "a mesh in another file"),
                 mesh_with({{"links", ids("both ends of each link")}}),
                 mesh_with({{"counts", ids("number of neighbours of each element")},
                            {"neighbours", ids("neighbours of each element, in the file's order")}})});
}

Json panel() {
  return object({{"algorithm", algorithm()},
                 {"precision", one_of(precision_names, "of the coordinates")},
                 {"from_rest", boolean("true if the coordinates are displacements from rest")},
                 {"runs", ids("first and end of each run of elements that are given")},
                 {"held", array_of(number(), "coordinates of these elements (mesh units)")}},
                {{"frame", point(rotation_vector)}});
}

Json lesson() {
  const auto name = [](std::string_view help = {}) { return non_empty_text(help, limits::name_bytes); };
  const Json step = object({{"title", name()},
                            {"text", non_empty_text({}, limits::caption_bytes)},
                            {"until", count("number of recorded moves that are carried out at the end of the step")}},
                           {{"algorithms", array_of(algorithm(), "of panels", lesson_panels_least, lesson_panels_most)},
                            {"candidate", id("number of candidates of the last pass that are shown")},
                            {"colour", name("colours of the elements")},
                            {"show", name("what the panels show")},
                            {"dock", name("dock that opens")},
                            {"tool", name("tool that is chosen")}});
  return object({{"title", name()}, {"steps", array_of(step, {}, 1, limits::lesson_steps)}});
}

Json session() {
  const Member own{"own", array_of(number(), "both ends and the numbers of each link with its own softness")};
  const Json all = object(
      {{"format", {{"const", "chainmail session"}}},
       {"version", {{"const", session_version}}},
       {"name", text("name of the object")},
       {"mesh", mesh()},
       {"cuts", ids("both ends of each cut link")},
       {"pins", ids("ids of the pinned elements")},
       {"softness", object(joined({region(), {own}}), optional_softness())},
       {"relaxation", object(described<commands::SetRelaxation>(), described<commands::SetRelaxation>(is_optional))},
       {"panels", array_of(panel(), {}, 1, limits::session_panels)},
       {"ui", about("state of the window: only the workbench reads it", {{"type", "object"}})}},
      {{"elastic", object(described<ElasticOptions>(), described<ElasticOptions>(is_optional))},
       {"moves", moves()},
       {"moves_done", count("number of moves that are done; the others can be redone")},
       {"lesson", lesson()}});
  return with(all, "dependencies", {{"moves", Json::array({"moves_done"})}});
}

}  // namespace

Members schemas_of_files() {
  return {document("preset", "Presets of softness", preset()), document("moves", "Recorded moves", moves()),
          document("session", "Session of the workbench", session())};
}

}  // namespace chainmail::schema
