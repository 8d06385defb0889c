#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "files/session/move_fields.h"
#include "files/session/moves.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

constexpr int version_read = 1;
constexpr std::uint64_t most_sweeps = 1'000'000;

/// Checks commands one after another, as a simulation at rest would take them.
class MovesReader {
 public:
  MovesReader(const std::string& where, const Mesh& mesh) : where_(where), fields_(where_, mesh) {}

  std::vector<Command> read(std::string_view text, const std::filesystem::path& path, const Progress& progress);

 private:
  using Members = MoveMembers;

  void check_head(const Json& head) const;
  void take(const Json& value, const Members& of);
  Command command(const Members& of);
  Command grab(const Members& of);
  Command drag(const Members& of);
  Command release(const Members& of);
  Command cut(const Members& of) { return commands::Cut{fields_.links(of)}; }
  Command uncut(const Members& of) { return commands::Uncut{fields_.links(of)}; }
  Command pin(const Members& of);
  Command unpin(const Members& of);
  Command softness(const Members& of);
  Command reset(const Members& of);
  Command relax(const Members& of);

  std::string where_;
  MoveFields fields_;  // of the file, then of each command
  std::vector<Command> commands_;
  std::optional<Error> fault_;  // of the first command that is wrong; what is wrong with the whole file comes before
  // The state that the simulation would be in.
  std::optional<ElementId> grabbed_;
  std::set<ElementId> pinned_;
};

Command MovesReader::grab(const Members& of) {
  fields_.check_keys(of.members, {"do", "element"});
  const ElementId one = fields_.element(fields_.member(of.members, "element"));
  if (pinned_.contains(one)) {
    fields_.fail("element " + std::to_string(one) + " is pinned by then and may not move", "unpin it first");
  }
  grabbed_ = one;
  return commands::Grab{one};
}

Command MovesReader::drag(const Members& of) {
  fields_.check_keys(of.members, {"do", "target"});
  if (!grabbed_) {
    fields_.fail("no element is grabbed by then", "grab one first");
  }
  const Json& target = fields_.array(of.members, "target");
  if (target.size() != 3) {
    fields_.fail("'target' does not have three coordinates", "write [x, y, z]");
  }
  return commands::Drag{{fields_.number(target[0]), fields_.number(target[1]), fields_.number(target[2])}};
}

Command MovesReader::release(const Members& of) {
  fields_.check_keys(of.members, {"do"});
  grabbed_.reset();
  return commands::Release{};
}

Command MovesReader::pin(const Members& of) {
  const auto pins = fields_.elements(of);
  if (grabbed_ && std::find(pins.begin(), pins.end(), *grabbed_) != pins.end()) {
    fields_.fail("element " + std::to_string(*grabbed_) + " is in the hand by then", "release it first");
  }
  pinned_.insert(pins.begin(), pins.end());
  return commands::Pin{pins};
}

Command MovesReader::unpin(const Members& of) {
  const auto pins = fields_.elements(of);
  for (const ElementId one : pins) {
    pinned_.erase(one);
  }
  return commands::Unpin{pins};
}

Command MovesReader::softness(const Members& of) {
  fields_.check_keys(of.members, {"do", "compression", "stretch", "shear", "links"});
  const auto member = [&](const char* key) -> const Json& { return fields_.member(of.members, key); };
  Softness result{fields_.softness(member("compression"), member("stretch"), member("shear")), {}};
  if (!of.members.contains("links")) {
    return commands::SetSoftness{result};
  }
  const NumberList& links = fields_.list(of, "links");
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Json one = links.at(i);
    const LinkId link = fields_.link(one, 5);
    if (!result.links.emplace(link, fields_.softness(one[2], one[3], one[4])).second) {
      fields_.fail("the link " + one[0].dump() + "-" + one[1].dump() + " is given twice", "remove one of them");
    }
  }
  return commands::SetSoftness{result};
}

Command MovesReader::reset(const Members& of) {
  fields_.check_keys(of.members, {"do"});
  return commands::Reset{};
}

Command MovesReader::relax(const Members& of) {
  fields_.check_keys(of.members, {"do", "sweeps", "step", "scheme"});
  const Json& sweeps = fields_.member(of.members, "sweeps");
  if (!sweeps.is_number_unsigned() || sweeps.get<std::uint64_t>() > most_sweeps) {
    fields_.fail("'sweeps' is not a whole number up to " + std::to_string(most_sweeps), "write how many there are");
  }
  const double step = of.members.contains("step") ? fields_.number(of.members["step"]) : 1;
  if (!(step > 0 && step <= 1)) {
    fields_.fail("'step' does not lie above 0 and up to 1", "1 goes all the way");
  }
  const Json scheme = of.members.value("scheme", Json("mean"));
  if (scheme != "mean" && scheme != "link") {
    fields_.fail("'scheme' is not known", "use mean or link");
  }
  return commands::Relax{sweeps.get<std::uint32_t>(), step,
                         scheme == "link" ? RelaxationScheme::link : RelaxationScheme::mean};
}

Command MovesReader::command(const Members& of) {
  static const std::map<std::string, Command (MovesReader::*)(const Members&)> known{
      {"grab", &MovesReader::grab},   {"drag", &MovesReader::drag},         {"release", &MovesReader::release},
      {"cut", &MovesReader::cut},     {"uncut", &MovesReader::uncut},       {"pin", &MovesReader::pin},
      {"unpin", &MovesReader::unpin}, {"softness", &MovesReader::softness}, {"reset", &MovesReader::reset},
      {"relax", &MovesReader::relax}};
  const Json& what = fields_.member(of.members, "do");
  const auto found = known.find(what.is_string() ? what.get<std::string>() : "");
  if (found == known.end()) {
    fields_.fail("'do' names no command", "use grab, drag, release, cut, uncut, pin, unpin, softness, relax or reset");
  }
  return (this->*found->second)(of);
}

void MovesReader::take(const Json& value, const Members& of) {
  if (fault_) {
    return;
  }
  fields_.say_at(where_ + ": command " + std::to_string(commands_.size()));
  try {
    if (!value.is_object()) {
      fields_.fail("it is not an object", "write {\"do\": …}");
    }
    commands_.push_back(command(of));
  } catch (const Error& error) {
    fault_ = error;
  }
}

void MovesReader::check_head(const Json& head) const {
  if (!head.is_object()) {
    fields_.fail("it holds no moves", "give recorded moves");
  }
  const Json& version = fields_.member(head, "version");
  if (!version.is_number_unsigned() || version.get<std::uint64_t>() != version_read) {
    fields_.fail("its version is not " + std::to_string(version_read), "record the moves again with this program");
  }
  fields_.check_keys(head, {"version", "commands"});
  fields_.array(head, "commands");
}

std::vector<Command> MovesReader::read(std::string_view text, const std::filesystem::path& path,
                                       const Progress& progress) {
  MovesScan scan(text, path, where_, [this](const Json& value, const Members& of) { take(value, of); });
  scan.scan(progress);
  fields_.say_at(where_);
  check_head(scan.head());
  if (fault_) {
    throw Error(*fault_);
  }
  return std::move(commands_);
}

}  // namespace

std::vector<Command> read_moves(std::string_view text, const std::filesystem::path& path, const std::string& where,
                                const Mesh& mesh, const Progress& progress) {
  return MovesReader(where, mesh).read(text, path, progress);
}

std::vector<Command> read_moves(std::string_view text, const std::filesystem::path& path, const Mesh& mesh,
                                const Progress& progress) {
  return read_moves(text, path, shown(path), mesh, progress);
}

std::vector<Command> read_moves(const std::filesystem::path& path, const Mesh& mesh, const Progress& progress) {
  return read_moves(read_text(path, "recorded moves", progress.part(0, 0.1)), path, mesh, progress.part(0.1, 1));
}

}  // namespace chainmail
