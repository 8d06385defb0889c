#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "files/session/lesson_json.h"
#include "files/session/moves.h"
#include "files/session/object_json.h"
#include "files/session/session.h"
#include "files/session/session_mesh.h"
#include "files/text/described_json.h"
#include "files/text/limits.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "simulate/move_history.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

constexpr std::array packed_keys{PackedKey{"links", 1},     PackedKey{"counts", 1},   PackedKey{"neighbours", 1},
                                 PackedKey{"triangles", 1}, PackedKey{"polygons", 1}, PackedKey{"tetrahedra", 1},
                                 PackedKey{"hexahedra", 1}, PackedKey{"cuts", 1},     PackedKey{"pins", 1},
                                 PackedKey{"runs", 1},      PackedKey{"rest", 0},     PackedKey{"own", 0},
                                 PackedKey{"held", 0}};

class SessionReader {
 public:
  SessionReader(const PackedJson& json, const std::filesystem::path& path, const MeshOpener& open)
      : path_(path),
        file_(shown(path)),
        fields_(file_, &json.arrays),
        tree_(json.tree),
        moves_(json.text),
        open_(open) {}

  Session read(const Progress& progress);

 private:
  /// True if the version knows kinds of energy. Before, all energy was isotropic.
  bool has_energy() const { return version_ >= 2; }
  void check_kind();
  void take_mesh(const Progress& progress);
  MeshPointer named_mesh(const Json& object, const Progress& progress);
  void take_cuts();
  void take_pins();
  void take_softness();
  void take_own(Softness& softness, const Json& object);
  template <class Struct>
  Struct members(const char* key);
  void take_elastic();
  void take_panels();
  void take_moves(const Progress& progress);
  void take_lesson();
  Session::Panel panel(const Json& object);
  Snapshot positions(const Json& object, Precision precision) const;

  const std::filesystem::path& path_;
  std::string file_;
  ObjectFields fields_;  // of the file, then of each member
  const Json& tree_;
  std::string_view moves_;
  const MeshOpener& open_;
  std::uint64_t version_ = session_version;
  EnergyKind absent_energy_ = link_energy;
  Session result_;
};

void SessionReader::check_kind() {
  const bool is_session = tree_.is_object() && tree_.contains("format") && tree_["format"] == Json("chainmail session");
  if (!is_session) {
    fields_.fail("it is not a session", "use a file that the workbench saved");
  }
  version_ = fields_.version(tree_, session_version);
  absent_energy_ = has_energy() ? link_energy : EnergyKind::isotropic;
  fields_.check_keys(tree_, {"format", "version", "name", "mesh", "cuts", "pins", "softness", "relaxation", "elastic",
                             "panels", "moves", "moves_done", "lesson", "ui"});
}

/// Opens the mesh that the session names. Its name must not lead out of a folder.
MeshPointer SessionReader::named_mesh(const Json& object, const Progress& progress) {
  fields_.check_keys(object, {"file", "across"});
  const std::string name = fields_.text(object, "file", limits::name_bytes);
  if (name.empty() || name.find_first_of("/\\") != std::string::npos || name[0] == '.') {
    fields_.fail("'file' is not the plain name of a file", "put the mesh next to the session and write its name only");
  }
  const auto across = object.contains("across") ? fields_.whole(object, "across", 1, element_limit) : 0;
  if (!open_) {
    fields_.fail("it is in another file, '" + name + "'", "open the session in the workbench and save it there");
  }
  return open_(name, static_cast<std::uint32_t>(across), progress);
}

void SessionReader::take_mesh(const Progress& progress) {
  const Json& mesh = fields_.object(tree_, "mesh");
  fields_.say_at(file_ + ": mesh");
  result_.mesh = mesh.contains("file") ? named_mesh(mesh, progress) : read_session_mesh(fields_, mesh, progress);
  fields_.say_at(file_);
}

void SessionReader::take_cuts() {
  const auto& ends = fields_.elements(tree_, "cuts", result_.mesh->element_count()).ids;
  fields_.check_groups(ends.size(), 2, "cuts");
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    result_.cuts.push_back(fields_.link(*result_.mesh, ends[i], ends[i + 1]));
  }
  std::sort(result_.cuts.begin(), result_.cuts.end());
  if (std::adjacent_find(result_.cuts.begin(), result_.cuts.end()) != result_.cuts.end()) {
    fields_.fail("'cuts' contains a link twice", "give each link once");
  }
}

void SessionReader::take_pins() {
  result_.pins = fields_.elements(tree_, "pins", result_.mesh->element_count()).ids;
  std::sort(result_.pins.begin(), result_.pins.end());
  if (std::adjacent_find(result_.pins.begin(), result_.pins.end()) != result_.pins.end()) {
    fields_.fail("'pins' contains an element twice", "give each element once");
  }
}

void SessionReader::take_softness() {
  const Json& object = fields_.object(tree_, "softness");
  fields_.say_at(file_ + ": softness");
  fields_.check_keys(object, softness_keys({"own"}));
  std::optional<RegionAxes> principal;
  Softness softness = fields_.softness(object, *result_.mesh, absent_energy_, principal);
  take_own(softness, object);
  result_.softness = std::make_shared<const Softness>(std::move(softness));
}

void SessionReader::take_own(Softness& softness, const Json& object) {
  const auto& own = fields_.packed(object, "own").reals;
  const std::size_t in_row = 2 + (has_energy() ? softness_numbers.size() : region_numbers);
  fields_.check_groups(own.size(), in_row, "own");
  std::vector<ElementId> ends;
  std::vector<double> numbers;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (i % in_row >= 2) {
      numbers.push_back(own[i]);
    } else if (own[i] >= 0 && own[i] < result_.mesh->element_count() && own[i] == std::floor(own[i])) {
      ends.push_back(static_cast<ElementId>(own[i]));
    } else {
      fields_.fail("'own' names an element that does not exist in its link " + std::to_string(i / in_row),
                   "ids are whole numbers from 0");
    }
  }
  fields_.add_own(softness.links, *result_.mesh, ends, numbers);
}

/// Reads a described struct from a member.
template <class Struct>
Struct SessionReader::members(const char* key) {
  const Json& object = fields_.object(tree_, key);
  fields_.say_at(file_ + ": " + key);
  fields_.check_keys(object, keys_of<Struct>());
  const Struct result = read_members<Struct>(fields_, object);
  fields_.say_at(file_);
  return result;
}

void SessionReader::take_elastic() {
  if (tree_.contains("elastic")) {
    result_.elastic = members<ElasticOptions>("elastic");
    fields_.say_at(file_ + ": elastic");
    fields_.here([&] { check(result_.elastic); });
    fields_.say_at(file_);
  }
}

Snapshot SessionReader::positions(const Json& object, Precision precision) const {
  const RegionAxes axes =
      object.contains("frame") ? RegionAxes(AxesKind::given, fields_.point(object, "frame")) : RegionAxes();
  check(axes, *result_.mesh);
  return snapshot_of({fields_.boolean(object, "from_rest"), fields_.packed(object, "runs").ids,
                      fields_.packed(object, "held").reals, axes},
                     *result_.mesh, precision);
}

Session::Panel SessionReader::panel(const Json& object) {
  if (!object.is_object()) {
    fields_.fail("it is not an object", "write it in { }");
  }
  fields_.check_keys(object, {"algorithm", "precision", "from_rest", "frame", "runs", "held"});
  const Algorithm algorithm = fields_.algorithm(fields_.member(object, "algorithm"));
  constexpr std::array<std::string_view, 2> precisions{"float", "double"};
  const auto precision = Precision(fields_.choice(fields_.member(object, "precision"), "precision", precisions));
  return fields_.here([&]() -> Session::Panel {
    check(algorithm, *result_.mesh);
    return {algorithm, precision, positions(object, precision)};
  });
}

void SessionReader::take_panels() {
  const Json& panels = fields_.array(tree_, "panels");
  if (panels.empty() || panels.size() > limits::session_panels) {
    fields_.fail("it has " + std::to_string(panels.size()) + " panels",
                 "give 1 to " + std::to_string(limits::session_panels));
  }
  for (const Json& one : panels) {
    fields_.say_at(file_ + ": panel " + std::to_string(result_.panels.size()));
    result_.panels.push_back(panel(one));
  }
}

void SessionReader::take_moves(const Progress& progress) {
  if (!tree_.contains("moves")) {
    return;
  }
  const std::string_view text = moves_.empty() ? "null" : moves_;  // a number or a text is not a list of moves
  result_.moves = read_moves(text, path_, file_ + ": moves", result_.mesh, progress, absent_energy_);
  result_.moves_done = fields_.whole(tree_, "moves_done", 0, result_.moves.size());
  if (!has_energy() && !result_.moves.empty()) {  // its moves began with isotropic energy
    result_.moves.insert(result_.moves.begin(), commands::SetSoftness{Softness{{}, {}, EnergyKind::isotropic}});
    result_.moves_done += result_.moves_done > 0 ? 1 : 0;
  }
}

void SessionReader::take_lesson() {
  if (tree_.contains("lesson")) {
    result_.lesson = read_lesson(tree_["lesson"], file_, *result_.mesh, result_.moves.size());
  }
}

Session SessionReader::read(const Progress& progress) {
  check_kind();
  result_.name = one_line(fields_.text(tree_, "name", limits::name_bytes));
  take_mesh(progress.part(0, 0.8));
  take_moves(progress.part(0.8, 0.9));
  // The file has the mesh with which the moves begin.
  result_.mesh = last_mesh(result_.mesh, std::span(result_.moves).first(result_.moves_done));
  take_cuts();
  take_pins();
  result_.ui = fields_.object(tree_, "ui").dump();
  take_softness();
  fields_.say_at(file_);
  result_.relaxation = members<commands::SetRelaxation>("relaxation");
  take_elastic();
  progress.report(0.9);
  take_panels();
  take_lesson();
  return std::move(result_);
}

}  // namespace

Session parse_session(std::string_view text, const std::filesystem::path& path, const Progress& progress,
                      const MeshOpener& open) {
  PackedJson json;
  // Recorded moves stay text, because they are read after the mesh.
  const JsonForm form{
      .content = "a session that the workbench saved", .packed = packed_keys, .unpacked = "ui", .text = "moves"};
  scan_json(text, path, shown(path), form, json, progress.part(0, 0.6));
  return SessionReader(json, path, open).read(progress.part(0.6, 1));
}

Session read_session(RegularFile file, const Progress& progress, const MeshOpener& open) {
  const std::filesystem::path path = file.path();
  return parse_session(read_text(std::move(file), "a session", progress.part(0, 0.1)), path, progress.part(0.1, 1),
                       open);
}

Session read_session(const std::filesystem::path& path, const Progress& progress, const MeshOpener& open) {
  return read_session(RegularFile(path), progress, open);
}

}  // namespace chainmail
