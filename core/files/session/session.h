#pragma once

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "simulate/command.h"
#include "solve/snapshot.h"
#include "solve/softness.h"
#include "solve/solver.h"

namespace chainmail {

/// All there is in a window, to be put down and taken up again: an object, what was done to it, and where its elements
/// stand in each panel.
struct Session {
  struct Panel {
    Algorithm algorithm = Algorithm::natural_queue;
    /// Of the numbers in the placement: those of single precision are floats.
    Precision precision = Precision::single_precision;
    Snapshot placement;
  };

  std::string name;  // of the object, as titles show it
  MeshPointer mesh;
  std::vector<LinkId> cuts;     // ascending
  std::vector<ElementId> pins;  // ascending
  std::shared_ptr<const Softness> softness = std::make_shared<const Softness>();
  commands::SetRelaxation relaxation;
  ElasticOptions elastic;
  std::vector<Panel> panels;  // 1 to session_panels
  /// What was done since the object was at rest and whole, and how many of it: the others were taken back and lie
  /// ahead.
  std::vector<Command> moves;
  std::size_t moves_done = 0;
  /// A JSON object that is the window's alone: cameras, layout.
  std::string ui = "{}";
};

inline constexpr std::size_t session_panels = 16;
/// A session holds moves as long as they, and the links and elements that they name, are no more than these: some hours
/// of dragging.
inline constexpr std::size_t session_moves = 1'000'000;

/// What the names of sessions end in, with the dot.
inline constexpr std::string_view session_ending = ".chainmail";

/// Whether a file's ending, in any case of letters, is that of a session.
bool is_session(const std::filesystem::path& path);

/// Writes a session as JSON, numbers in the fewest digits that read back as the same:
///
///     {"format": "chainmail session", "version": 1, "name": …,
///      "mesh": {"elements": n, "space": 1 to 3, "lattice": {"size": [w, h, d], "spacing": s},
///        "rest": [x, y, z of each element…], "links": [a, b of each link…], "triangles": [three ids each…],
///        "polygons": [count, id…], "tetrahedra": [four ids each…],
///        "hexahedra": [eight ids each…],
///        "texture": {"size": [w, h, d], "channels": 1 or 4, "box": [lowest x, y, z, highest x, y, z],
///          "texels": bytes in base 64}},
///      "cuts": [a, b of each cut link…], "pins": [id…],
///      "softness": {"compression": c, "stretch": s, "shear": h, "own": [a, b, c, s, h of each link with its own…]},
///      "relaxation": {"on": false, "scheme": "mean" or "link", "step": 1},
///      "elastic": {"young": E, "poisson": v, "lattice": [control points along each axis]},
///      "panels": [{"algorithm": "exact", "precision": "float" or "double", "from_rest": true,
///        "runs": [first, end of each run of elements that are given…], "held": [their coordinates…]}],
///      "moves": {as recorded moves are written}, "moves_done": how many of them,
///      "ui": {…}}
///
/// The moves may be left out, as they are beyond session_moves, "lattice", "hexahedra" and "texture" where there
/// are none, and "elastic" where it is the standard one. Where neighbours stand in an order of their own, "counts" (of
/// each element) and "neighbours" (its ids) take the place of "links". Throws Error for a number that is not finite,
/// and Cancelled.
void write_session(std::ostream& out, const Session& session, const Progress& progress = {});

/// The same into a file, whole or not at all.
void save_session(const std::filesystem::path& path, const Session& session, const Progress& progress = {});

/// Reads a session. Throws Error, which says where, for all that write_session would not have written of an object,
/// and for a newer version than it knows; and Cancelled.
Session read_session(const std::filesystem::path& path, const Progress& progress = {});
/// The same; `path` appears in errors, and `text` is what the file holds.
Session parse_session(std::string_view text, const std::filesystem::path& path, const Progress& progress = {});

}  // namespace chainmail
