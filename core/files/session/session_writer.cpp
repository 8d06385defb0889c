#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "files/session/lesson_json.h"
#include "files/session/moves.h"
#include "files/session/object_json.h"
#include "files/session/session.h"
#include "files/text/base64.h"
#include "files/text/described_json.h"
#include "files/text/limits.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "simulate/move_history.h"

namespace chainmail {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Formats numbers in the fewest digits that read back, through a double, as the same number of the precision.
class Digits {
 public:
  std::string_view operator()(double number, Precision precision) {
    if (!std::isfinite(number)) {
      throw Error("session", "a coordinate is not a finite number", "reset the object first");
    }
    if (number == 0 && std::signbit(number)) {
      return "-0.0";  // -0 would be a whole number
    }
    const auto single = static_cast<float>(number);
    if (precision == Precision::single_precision) {
      const std::string_view shorter = text(single);
      double back = 0;
      std::from_chars(shorter.data(), shorter.data() + shorter.size(), back);
      // The text is rounded twice, to a double and then to a float, so it could become a neighbour of the float.
      if (static_cast<float>(back) == single) {
        return shorter;
      }
    }
    return text(number);
  }

 private:
  template <class Number>
  std::string_view text(Number number) {
    return {digits_.data(), std::to_chars(digits_.data(), digits_.data() + digits_.size(), number).ptr};
  }

  std::array<char, 32> digits_;
};

/// Returns the size of a command, in units of one drag.
std::size_t weight(const Command& command) {
  return std::visit(
      [](const auto& one) -> std::size_t {
        if constexpr (requires { one.split; }) {
          const SplitEdit& edit = one.split->edit();
          return 1 + edit.elements.size() + edit.triangles.size() + edit.tetrahedra.size() + edit.hexahedra.size();
        } else if constexpr (requires { one.links; }) {
          return 1 + one.links.size();
        } else if constexpr (requires { one.elements; }) {
          return 1 + one.elements.size();
        } else if constexpr (requires { one.softness; }) {
          return 1 + one.softness->links.size();
        } else {
          return 1;
        }
      },
      command);
}

/// True if a session has moves and not too many to save.
bool moves_fit(const std::vector<Command>& moves) {
  std::size_t all = 0;
  std::uint64_t parts = 0;
  for (const Command& command : moves) {
    all += weight(command);
    const auto* split = std::get_if<commands::Split>(&command);
    parts += split == nullptr ? 0 : split->split->old_size() + split->split->edit().elements.size();
  }
  return all > 0 && all <= limits::session_moves && parts <= limits::split_parts;
}

class SessionWriter {
 public:
  SessionWriter(std::ostream& out, const Session& session)
      : out_(out), session_(session), mesh_(*session.mesh), has_moves_(moves_fit(session.moves)) {}

  void write(const Progress& progress) {
    const std::string name = OrderedJson(shortened(session_.name, limits::name_bytes))
                                 .dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    out_ << "{\"format\": \"chainmail session\", \"version\": " << std::uint32_t{session_version}
         << ", \"name\": " << name << ",\n";
    if (session_.mesh_file.empty()) {
      write_mesh(*written_mesh(session_), progress.part(0, 0.5));
    } else {
      out_ << "\"mesh\": " << OrderedJson{{"file", session_.mesh_file}}.dump();
    }
    write_state();
    out_ << ",\n\"panels\": [";
    const auto share = 0.45 / double(session_.panels.size());
    for (std::size_t i = 0; i < session_.panels.size(); ++i) {
      if (i > 0) {
        out_ << ',';
      }
      write_panel(session_.panels[i], progress.part(0.5 + share * double(i), 0.5 + share * double(i + 1)));
    }
    out_ << "]";
    write_moves(progress.part(0.95, 1));
    out_ << ",\n\"ui\": " << session_.ui << "}\n";
    out_.flush();
  }

 private:
  static constexpr std::size_t in_line = 24;  // numbers in one line

  void write_mesh(const Mesh& mesh, const Progress& progress) {
    out_ << "\"mesh\": {\"elements\": " << mesh.element_count()
         << ", \"space\": " << static_cast<std::uint32_t>(mesh.space_dimension);
    if (mesh.lattice) {
      const OrderedJson lattice{{"size", mesh.lattice->size}, {"spacing", mesh.lattice->spacing}};
      out_ << ", \"lattice\": " << lattice.dump();
    }
    Point point;
    write_array("rest", std::size_t{3} * mesh.element_count(), progress.part(0, 0.3), [&](std::size_t i) {
      if (i % 3 == 0) {
        point = mesh.rest_position(static_cast<ElementId>(i / 3));
      }
      out_ << digits_(point[static_cast<Eigen::Index>(i % 3)], Precision::double_precision);
    });
    write_links(mesh, progress.part(0.3, 0.8));
    write_groups<3>("triangles", std::span(mesh.triangles).first(mesh.own_triangles), progress.part(0.8, 0.9));
    write_ids("polygons", mesh.polygons);
    write_groups<4>("tetrahedra", mesh.tetrahedra, progress.part(0.9, 1));
    if (!mesh.hexahedra.empty()) {
      write_groups<8>("hexahedra", mesh.hexahedra, progress);
    }
    if (mesh.texture) {
      out_ << ",\n\"texture\": ";
      write_texture(*mesh.texture, progress.part(0.9, 1));
    }
    out_ << "}";
  }
  /// Writes links as pairs, or row by row if the neighbours are not in ascending order.
  void write_links(const Mesh& mesh, const Progress& progress) {
    bool ascending = true;
    for (ElementId e = 0; e < mesh.element_count() && ascending; ++e) {
      progress.part(0, 0.1).report(e, mesh.element_count());
      ascending = std::ranges::is_sorted(mesh.neighbours_of(e));
    }
    if (ascending) {
      write_groups<2>("links", mesh.links, progress.part(0.1, 1));
      return;
    }
    write_array("counts", mesh.element_count(), progress.part(0.1, 0.3), [&](std::size_t e) {
      out_ << static_cast<std::uint32_t>(mesh.neighbours_of(static_cast<ElementId>(e)).size());
    });
    write_ids("neighbours", mesh.neighbours, progress.part(0.3, 1));
  }
  /// Writes a texture as an object whose texels are bytes in base 64.
  void write_texture(const Texture& texture, const Progress& progress) {
    const auto& [low, high] = texture.box;
    const OrderedJson json{{"size", texture.size},
                           {"channels", texture.channels},
                           {"box", {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()}}};
    const std::string text = json.dump();
    out_ << std::string_view(text).substr(0, text.size() - 1) << ", \"texels\": \"";
    Base64Writer texels(out_);
    for (std::size_t i = 0; i < texture.texels.size(); ++i) {
      progress.report(i, texture.texels.size());
      texels.add(texture.texels[i]);
    }
    texels.finish();
    out_ << "\"}";
  }
  void write_state() {
    write_array("cuts", 2 * session_.cuts.size(), {},
                [&](std::size_t i) { out_ << mesh_.links[session_.cuts[i / 2]][i % 2]; });
    write_ids("pins", session_.pins);
    write_softness();
    write_members("relaxation", session_.relaxation);
    if (session_.elastic != ElasticOptions()) {
      write_members("elastic", session_.elastic);
    }
  }
  void write_softness() {
    OrderedJson json;
    add_softness(json, *session_.softness);
    const std::string text = json.dump();
    out_ << ",\n\"softness\": " << std::string_view(text).substr(0, text.size() - 1);
    constexpr std::size_t in_row = 2 + softness_numbers.size();
    auto own = session_.softness->links.begin();
    write_array("own", in_row * session_.softness->links.size(), {}, [&](std::size_t i) {
      const auto& [link, softness] = *own;
      const std::size_t column = i % in_row;
      const double value =
          column < 2 ? double(mesh_.links[link][column]) : softness.*softness_numbers[column - 2].value;
      out_ << digits_(value, Precision::double_precision);
      own = column + 1 == in_row ? std::next(own) : own;
    });
    out_ << "}";
  }
  /// Writes a described struct as an object.
  template <class Struct>
  void write_members(const char* key, const Struct& all) {
    OrderedJson object;
    add_members(object, all);
    out_ << ",\n\"" << std::string_view(key) << "\": " << object.dump();
  }
  void write_moves(const Progress& progress) {
    if (has_moves_) {
      std::ostringstream moves;
      chainmail::write_moves(moves, session_.moves, mesh_, progress);
      out_ << ",\n\"moves\": " << std::string_view(moves.str())
           << ",\"moves_done\": " << static_cast<std::uint32_t>(session_.moves_done);
    }
    const bool moves_left_out = !session_.moves.empty() && !has_moves_;
    if (!session_.lesson.steps.empty() && !moves_left_out) {
      out_ << ",\n\"lesson\": " << std::string_view(lesson_json(session_.lesson));
    }
  }
  void write_panel(const Session::Panel& panel, const Progress& progress) {
    const PositionRuns runs = runs_of(panel.positions, mesh_);
    out_ << "\n{\"algorithm\": \"" << info(panel.algorithm).name << "\", \"precision\": \"" << name(panel.precision)
         << "\", \"from_rest\": " << std::string_view(runs.from_rest ? "true" : "false");
    if (runs.axes.is_turned()) {
      const Point& turn = runs.axes.rotation();
      out_ << ", \"frame\": [" << digits_(turn.x(), Precision::double_precision);
      out_ << ", " << digits_(turn.y(), Precision::double_precision);
      out_ << ", " << digits_(turn.z(), Precision::double_precision) << "]";
    }
    write_ids("runs", runs.runs);
    write_array("held", runs.held.size(), progress,
                [&](std::size_t i) { out_ << digits_(runs.held[i], panel.precision); });
    out_ << "}";
  }
  /// Writes a member and its numbers; `put(i)` writes number i.
  template <class Put>
  void write_array(const char* key, std::size_t size, const Progress& progress, Put put) {
    out_ << ",\n\"" << std::string_view(key) << "\": [";
    for (std::size_t i = 0; i < size; ++i) {
      progress.report(i, size);
      if (i > 0) {
        out_ << ',';
      }
      if (i % in_line == 0 && size > in_line) {
        out_ << '\n';
      }
      put(i);
    }
    out_ << ']';
  }
  void write_ids(const char* key, std::span<const std::uint32_t> ids, const Progress& progress = {});
  template <std::size_t Size>
  void write_groups(const char* key, std::span<const std::array<ElementId, Size>> groups, const Progress& progress) {
    write_array(key, Size * groups.size(), progress, [&](std::size_t i) { out_ << groups[i / Size][i % Size]; });
  }

  TextBlocks out_;
  const Session& session_;
  const Mesh& mesh_;  // the present one
  const bool has_moves_;
  Digits digits_;
};

void SessionWriter::write_ids(const char* key, std::span<const std::uint32_t> ids, const Progress& progress) {
  write_array(key, ids.size(), progress, [&](std::size_t i) { out_ << ids[i]; });
}

}  // namespace

MeshPointer first_mesh(const Session& session) {
  const MeshPointer first = first_mesh(session.moves);
  return first ? first : session.mesh;
}

MeshPointer written_mesh(const Session& session) {
  return moves_fit(session.moves) ? first_mesh(session) : session.mesh;
}

void write_session(std::ostream& out, const Session& session, const Progress& progress) {
  SessionWriter(out, session).write(progress);
}

void save_session(const std::filesystem::path& path, const Session& session, const Progress& progress,
                  Readers readers) {
  write_file(
      path, [&](std::ostream& out) { write_session(out, session, progress); }, readers);
}

}  // namespace chainmail
