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
      : path_(path), fields_(shown(path), &json.arrays), tree_(json.tree), moves_(json.text), open_(open) {}

  Session read(const Progress& progress) {
    check_kind();
    result_.name = one_line(fields_.text(tree_, "name", limits::name_bytes));
    const Json& mesh = fields_.object(tree_, "mesh");
    const ObjectFields of_mesh = fields_.at("mesh");
    result_.mesh = mesh.contains("file") ? named_mesh(of_mesh, mesh, progress.part(0, 0.8))
                                         : read_session_mesh(of_mesh, mesh, progress.part(0, 0.8));
    take_moves(progress.part(0.8, 0.9));
    // The file has the mesh with which the moves begin.
    result_.mesh = last_mesh(result_.mesh, std::span(result_.moves).first(result_.moves_done));
    take_cuts_and_pins();
    result_.ui = fields_.object(tree_, "ui").dump();
    take_softness();
    result_.relaxation = members<commands::SetRelaxation>("relaxation");
    if (tree_.contains("elastic")) {
      result_.elastic = members<ElasticOptions>("elastic");
      fields_.at("elastic").here([&] { check(result_.elastic); });
    }
    progress.report(0.9);
    take_panels();
    if (tree_.contains("lesson")) {
      result_.lesson = read_lesson(fields_.at("lesson"), tree_["lesson"], *result_.mesh, result_.moves.size());
    }
    return std::move(result_);
  }

 private:
  /// True if the version knows kinds of energy. Before, all energy was isotropic.
  bool has_energy() const { return version_ >= 2; }
  EnergyKind absent_energy() const { return has_energy() ? link_energy : EnergyKind::isotropic; }
  void check_kind() {
    const bool is_session =
        tree_.is_object() && tree_.contains("format") && tree_["format"] == Json("chainmail session");
    if (!is_session) {
      fields_.fail("it is not a session", "use a file that the workbench saved");
    }
    version_ = fields_.version(tree_, session_version);
    fields_.check_keys(tree_, {"format", "version", "name", "mesh", "cuts", "pins", "softness", "relaxation", "elastic",
                               "panels", "moves", "moves_done", "lesson", "ui"});
  }
  /// Opens the mesh that the session names. Its name must not lead out of a folder.
  MeshPointer named_mesh(const ObjectFields& fields, const Json& object, const Progress& progress) const {
    fields.check_keys(object, {"file", "across"});
    const std::string name = fields.text(object, "file", limits::name_bytes);
    if (name.empty() || name.find_first_of("/\\") != std::string::npos || name[0] == '.') {
      fields.fail("'file' is not the plain name of a file", "put the mesh next to the session and write its name only");
    }
    const auto across = object.contains("across") ? fields.whole(object, "across", 1, element_limit) : 0;
    if (!open_) {
      fields.fail("it is in another file, '" + name + "'", "open the session in the workbench and save it there");
    }
    return open_(name, static_cast<std::uint32_t>(across), progress);
  }
  /// Sorts ids, which must be different.
  template <class Id>
  void sort_once(std::vector<Id>& ids, const char* problem) const {
    std::ranges::sort(ids);
    if (std::ranges::adjacent_find(ids) != ids.end()) {
      fields_.fail(problem, "give each once");
    }
  }
  void take_cuts_and_pins() {
    const std::uint64_t count = result_.mesh->element_count();
    const auto& ends = fields_.elements(tree_, "cuts", count).ids;
    for (const auto& [a, b] : fields_.groups<2>(ends, "cuts")) {
      result_.cuts.push_back(fields_.link(*result_.mesh, a, b));
    }
    sort_once(result_.cuts, "'cuts' contains a link twice");
    result_.pins = fields_.elements(tree_, "pins", count).ids;
    sort_once(result_.pins, "'pins' contains an element twice");
  }
  void take_softness() {
    const Json& object = fields_.object(tree_, "softness");
    const ObjectFields fields = fields_.at("softness");
    fields.check_keys(object, softness_keys({"own"}));
    std::optional<RegionAxes> principal;
    Softness softness = fields.softness(object, *result_.mesh, absent_energy(), principal);
    const auto& own = fields.packed(object, "own").reals;
    const std::size_t in_row = 2 + (has_energy() ? softness_numbers.size() : region_numbers);
    fields.check_groups(own.size(), in_row, "own");
    std::vector<ElementId> ends;
    std::vector<double> numbers;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (i % in_row >= 2) {
        numbers.push_back(own[i]);
      } else if (own[i] >= 0 && own[i] < result_.mesh->element_count() && own[i] == std::floor(own[i])) {
        ends.push_back(static_cast<ElementId>(own[i]));
      } else {
        fields.fail("'own' names an element that does not exist in its link " + std::to_string(i / in_row),
                    "ids are whole numbers from 0");
      }
    }
    fields.add_own(softness.links, *result_.mesh, ends, numbers);
    result_.softness = std::make_shared<const Softness>(std::move(softness));
  }
  /// Reads a described struct from a member.
  template <class Struct>
  Struct members(const char* key) const {
    const Json& object = fields_.object(tree_, key);
    fields_.at(key).check_keys(object, keys_of<Struct>());
    return read_members<Struct>(fields_.at(key), object);
  }
  void take_panels() {
    const Json& panels = fields_.array(tree_, "panels");
    if (panels.empty() || panels.size() > limits::session_panels) {
      fields_.fail("it has " + std::to_string(panels.size()) + " panels",
                   "give 1 to " + std::to_string(limits::session_panels));
    }
    for (const Json& one : panels) {
      const ObjectFields fields = fields_.at("panel " + std::to_string(result_.panels.size()));
      result_.panels.push_back(fields.here([&] { return panel(fields, one); }));
    }
  }
  Session::Panel panel(const ObjectFields& fields, const Json& object) const {
    fields.check_keys(object, {"algorithm", "precision", "from_rest", "frame", "runs", "held"});
    const Algorithm algorithm = fields.algorithm(fields.member(object, "algorithm"));
    const auto precision = Precision(fields.choice(fields.member(object, "precision"), "precision", precision_names));
    check(algorithm, *result_.mesh);
    RegionAxes axes;
    if (object.contains("frame")) {
      axes = {AxesKind::given, fields.point(object, "frame")};
      check(axes, *result_.mesh);
    }
    return {algorithm, precision,
            snapshot_of({fields.boolean(object, "from_rest"), fields.packed(object, "runs").ids,
                         fields.packed(object, "held").reals, axes},
                        *result_.mesh, precision)};
  }
  void take_moves(const Progress& progress) {
    if (!tree_.contains("moves")) {
      return;
    }
    const std::string_view text = moves_.empty() ? "null" : moves_;  // a number or a text is not a list of moves
    result_.moves = read_moves(text, path_, fields_.at("moves").where(), result_.mesh, progress, absent_energy());
    result_.moves_done = fields_.whole(tree_, "moves_done", 0, result_.moves.size());
    if (!has_energy() && !result_.moves.empty()) {  // its moves began with isotropic energy
      result_.moves.insert(result_.moves.begin(), commands::SetSoftness{Softness{{}, {}, EnergyKind::isotropic}});
      result_.moves_done += result_.moves_done > 0 ? 1 : 0;
    }
  }

  const std::filesystem::path& path_;
  ObjectFields fields_;
  const Json& tree_;
  std::string_view moves_;
  const MeshOpener& open_;
  std::uint64_t version_ = session_version;
  Session result_;
};

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
