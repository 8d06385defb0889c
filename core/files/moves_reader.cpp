#include <map>
#include <set>
#include <string>

#include "files/move_fields.h"
#include "files/moves.h"
#include "files/text.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

constexpr int version_read = 1;
constexpr std::uint64_t most_sweeps = 1'000'000;

class MovesReader {
 public:
  MovesReader(const std::string& where, const Mesh& mesh) : where_(where), fields_(where_, mesh) {}

  std::vector<Command> read(const Json& json);

 private:
  void check_version(const Json& json) const;
  Command command(const Json& object);
  Command grab(const Json& object);
  Command drag(const Json& object);
  Command release(const Json& object);
  Command cut(const Json& object) { return commands::Cut{fields_.links(object)}; }
  Command uncut(const Json& object) { return commands::Uncut{fields_.links(object)}; }
  Command pin(const Json& object);
  Command unpin(const Json& object);
  Command softness(const Json& object);
  Command reset(const Json& object);
  Command relax(const Json& object);

  std::string where_;
  MoveFields fields_;  // of the file, then of each command
  // As a simulation would stand here.
  std::optional<ElementId> grabbed_;
  std::set<ElementId> pinned_;
};

Command MovesReader::grab(const Json& object) {
  fields_.check_keys(object, {"do", "element"});
  const ElementId one = fields_.element(fields_.member(object, "element"));
  if (pinned_.contains(one)) {
    fields_.fail("element " + std::to_string(one) + " is pinned by then and may not move", "unpin it first");
  }
  grabbed_ = one;
  return commands::Grab{one};
}

Command MovesReader::drag(const Json& object) {
  fields_.check_keys(object, {"do", "target"});
  if (!grabbed_) {
    fields_.fail("no element is grabbed by then", "grab one first");
  }
  const Json& target = fields_.array(object, "target");
  if (target.size() != 3) {
    fields_.fail("'target' does not have three coordinates", "write [x, y, z]");
  }
  return commands::Drag{{fields_.number(target[0]), fields_.number(target[1]), fields_.number(target[2])}};
}

Command MovesReader::release(const Json& object) {
  fields_.check_keys(object, {"do"});
  grabbed_.reset();
  return commands::Release{};
}

Command MovesReader::pin(const Json& object) {
  const auto pins = fields_.elements(object);
  if (grabbed_ && std::find(pins.begin(), pins.end(), *grabbed_) != pins.end()) {
    fields_.fail("element " + std::to_string(*grabbed_) + " is in the hand by then", "release it first");
  }
  pinned_.insert(pins.begin(), pins.end());
  return commands::Pin{pins};
}

Command MovesReader::unpin(const Json& object) {
  const auto pins = fields_.elements(object);
  for (const ElementId one : pins) {
    pinned_.erase(one);
  }
  return commands::Unpin{pins};
}

Command MovesReader::softness(const Json& object) {
  fields_.check_keys(object, {"do", "compression", "stretch", "shear", "links"});
  const auto member = [&](const char* key) -> const Json& { return fields_.member(object, key); };
  Softness result{fields_.softness(member("compression"), member("stretch"), member("shear")), {}};
  if (!object.contains("links")) {
    return commands::SetSoftness{result};
  }
  for (const Json& one : fields_.array(object, "links")) {
    const LinkId link = fields_.link(one, 5);
    if (!result.links.emplace(link, fields_.softness(one[2], one[3], one[4])).second) {
      fields_.fail("the link " + one[0].dump() + "-" + one[1].dump() + " is given twice", "remove one of them");
    }
  }
  return commands::SetSoftness{result};
}

Command MovesReader::reset(const Json& object) {
  fields_.check_keys(object, {"do"});
  return commands::Reset{};
}

Command MovesReader::relax(const Json& object) {
  fields_.check_keys(object, {"do", "sweeps", "step", "scheme"});
  const Json& sweeps = fields_.member(object, "sweeps");
  if (!sweeps.is_number_unsigned() || sweeps.get<std::uint64_t>() > most_sweeps) {
    fields_.fail("'sweeps' is not a whole number up to " + std::to_string(most_sweeps), "write how many there are");
  }
  const double step = object.contains("step") ? fields_.number(object["step"]) : 1;
  if (!(step > 0 && step <= 1)) {
    fields_.fail("'step' does not lie above 0 and up to 1", "1 goes all the way");
  }
  const Json scheme = object.value("scheme", Json("mean"));
  if (scheme != "mean" && scheme != "link") {
    fields_.fail("'scheme' is not known", "use mean or link");
  }
  return commands::Relax{sweeps.get<std::uint32_t>(), step,
                         scheme == "link" ? RelaxationScheme::link : RelaxationScheme::mean};
}

Command MovesReader::command(const Json& object) {
  static const std::map<std::string, Command (MovesReader::*)(const Json&)> known{
      {"grab", &MovesReader::grab},   {"drag", &MovesReader::drag},         {"release", &MovesReader::release},
      {"cut", &MovesReader::cut},     {"uncut", &MovesReader::uncut},       {"pin", &MovesReader::pin},
      {"unpin", &MovesReader::unpin}, {"softness", &MovesReader::softness}, {"reset", &MovesReader::reset},
      {"relax", &MovesReader::relax}};
  if (!object.is_object()) {
    fields_.fail("it is not an object", "write {\"do\": …}");
  }
  const Json& what = fields_.member(object, "do");
  const auto found = known.find(what.is_string() ? what.get<std::string>() : "");
  if (found == known.end()) {
    fields_.fail("'do' names no command", "use grab, drag, release, cut, uncut, pin, unpin, softness, relax or reset");
  }
  return (this->*found->second)(object);
}

void MovesReader::check_version(const Json& json) const {
  if (!json.is_object()) {
    fields_.fail("it holds no moves", "give recorded moves");
  }
  const Json& version = fields_.member(json, "version");
  if (!version.is_number_unsigned() || version.get<std::uint64_t>() != version_read) {
    fields_.fail("its version is not " + std::to_string(version_read), "record the moves again with this program");
  }
  fields_.check_keys(json, {"version", "commands"});
}

std::vector<Command> MovesReader::read(const Json& json) {
  check_version(json);
  std::vector<Command> result;
  for (const Json& one : fields_.array(json, "commands")) {
    fields_.say_at(where_ + ": command " + std::to_string(result.size()));
    result.push_back(command(one));
  }
  return result;
}

}  // namespace

std::vector<Command> read_moves(const nlohmann::json& json, const std::string& where, const Mesh& mesh) {
  return MovesReader(where, mesh).read(json);
}

std::vector<Command> read_moves(std::string_view text, const std::filesystem::path& path, const Mesh& mesh) {
  return read_moves(parse_moves(text, path), shown(path), mesh);
}

std::vector<Command> read_moves(const std::filesystem::path& path, const Mesh& mesh) {
  return read_moves(read_text(path, "recorded moves"), path, mesh);
}

}  // namespace chainmail
