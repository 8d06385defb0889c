#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "body/snapshot.h"
#include "files/session/lesson.h"
#include "files/text/outputs.h"
#include "files/text/regular_file.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "simulate/command.h"
#include "solver/deformer.h"

namespace chainmail {

/// The newest version of the format.
inline constexpr unsigned session_version = 2;

/// The content of a window, to be saved and restored: an object, its moves, and the positions of its elements in each
/// panel.
struct Session : ObjectState {
  struct Panel {
    Algorithm algorithm = Algorithm::natural_queue;
    /// Precision of the coordinates in `positions`. In single precision they are floats.
    Precision precision = Precision::single_precision;
    Snapshot positions;
  };

  std::string name;  // name of the object, as in titles; a file has its first limits::name_bytes bytes
  /// If not empty, a file that has the mesh: the session is then written with this name in place of the mesh.
  std::string mesh_file;
  commands::SetRelaxation relaxation;
  ElasticOptions elastic;
  std::vector<Panel> panels;  // 1 to limits::session_panels
  /// Moves since the object was at rest and whole. The first `moves_done` are done; the others were undone and can be
  /// redone.
  std::vector<Command> moves;
  std::size_t moves_done = 0;
  Lesson lesson;  // captions over the moves, if there are any
  /// A JSON object that only the window reads: cameras, layout.
  std::string ui = "{}";
};

/// Returns the mesh with which the moves of a session begin: the one before all splits.
MeshPointer first_mesh(const Session& session);
/// Returns the mesh that is written: the first one, or the present one if the moves are left out.
MeshPointer written_mesh(const Session& session);

/// Writes a session as JSON, with numbers in the fewest digits that read back exactly:
///
///     {"format": "chainmail session", "version": 2, "name": …,
///      "mesh": {"elements": n, "space": 1 to 3, "lattice": {"size": [w, h, d], "spacing": s},
///        "rest": [x, y, z of each element…], "links": [a, b of each link…], "triangles": [three ids each…],
///        "polygons": [count, id…], "tetrahedra": [four ids each…],
///        "hexahedra": [eight ids each…],
///        "texture": {"size": [w, h, d], "channels": 1 or 4, "box": [lowest x, y, z, highest x, y, z],
///          "texels": bytes in base 64}},
///      "cuts": [a, b of each cut link…], "pins": [id…],
///      "softness": {each number of softness_numbers,
///        "energy": "isotropic", "axial", "corotated" or "material",
///        "frame": {"kind": "object" or "given", "rotation": [x, y, z: the axis times the angle in radians]},
///        "own": [both ends and all numbers of each link with its own…]},
///      "relaxation": {"on": false, "scheme": "mean", "link" or "equilibrium", "step": 1,
///        "local": true if it is fine only where needed},
///      "elastic": {each member of ElasticOptions, which material.h describes},
///      "panels": [{"algorithm": "exact", "precision": "float" or "double", "from_rest": true,
///        "frame": [rotation, as above], "runs": [first, end of each run of elements that are given…], "held": [their
///        coordinates…]}],
///      "moves": {as in files/session/moves.h}, "moves_done": how many of them,
///      "lesson": {"title": …, "steps": [{"title": …, "text": …, "until": number of moves that are carried out,
///        "algorithms": [name for each panel], "candidate": n, "colour": …, "show": …, "dock": …, "tool": …}]},
///      "ui": {…}}
///
/// "mesh" is the object before the first split in "moves". All other members are about the object after the moves that
/// are done. In place of all its members, "mesh" may hold "file", the name of a mesh or a picture, and for a picture
/// "across", the number of elements along its width. "lesson" is left out without steps, and in a step all but "title",
/// "text" and "until" may be left out.
///
/// "frame" of "softness" is left out for the axes of the world. "frame" of a panel is there if its coordinates are
/// those of turned axes.
///
/// "moves" are left out above limits::session_moves; "lattice", "hexahedra" and "texture" if there are none; and
/// "elastic" if it is the standard one. If the neighbours are not in ascending order, "counts" (of each element) and
/// "neighbours" (its ids) take the place of "links". In version 1, "softness" has c, s and h only, and its energy is
/// isotropic. Throws Error for a number that is not finite, and Cancelled.
void write_session(std::ostream& out, const Session& session, const Progress& progress = {});

/// Writes a session into a file. A failed write leaves the file as it was.
void save_session(const std::filesystem::path& path, const Session& session, const Progress& progress = {},
                  Readers readers = Readers::as_usual);

/// Opens the mesh that a session names, in the folder of the session or elsewhere. The name has no folder. `across` is
/// the number of elements along the width of a picture; 0 if the session does not say it.
using MeshOpener = std::function<MeshPointer(const std::string& name, std::uint32_t across, const Progress& progress)>;

/// Reads a session. Throws Error, with the member, for anything that write_session does not write, and for a newer
/// version; and Cancelled. Without `open`, a session that names its mesh is refused.
Session read_session(RegularFile file, const Progress& progress = {}, const MeshOpener& open = {});
Session read_session(const std::filesystem::path& path, const Progress& progress = {}, const MeshOpener& open = {});
/// Reads a session from the text of a file. `path` appears in errors.
Session parse_session(std::string_view text, const std::filesystem::path& path, const Progress& progress = {},
                      const MeshOpener& open = {});

}  // namespace chainmail
