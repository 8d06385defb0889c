#include <nlohmann/json.hpp>

#include "files/session/moves.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;

Json links_of(const std::vector<LinkId>& links, const Mesh& mesh) {
  Json result = Json::array();
  for (const LinkId link : links) {
    result.push_back(mesh.links[link]);
  }
  return result;
}

/// A command as JSON, null for what is left out.
class MoveWriter {
 public:
  explicit MoveWriter(const Mesh& mesh) : mesh_(mesh) {}

  Json operator()(const commands::Grab& one) const { return {{"do", "grab"}, {"element", one.element}}; }
  Json operator()(const commands::Drag& one) const {
    return {{"do", "drag"}, {"target", {one.target.x(), one.target.y(), one.target.z()}}};
  }
  Json operator()(const commands::Release&) const { return {{"do", "release"}}; }
  Json operator()(const commands::Cut& one) const { return {{"do", "cut"}, {"links", links_of(one.links, mesh_)}}; }
  Json operator()(const commands::Uncut& one) const { return {{"do", "uncut"}, {"links", links_of(one.links, mesh_)}}; }
  Json operator()(const commands::Pin& one) const { return {{"do", "pin"}, {"elements", one.elements}}; }
  Json operator()(const commands::Unpin& one) const { return {{"do", "unpin"}, {"elements", one.elements}}; }
  Json operator()(const commands::Reset&) const { return {{"do", "reset"}}; }
  Json operator()(const commands::SetSoftness& one) const {
    const auto& [compression, stretch, shear] = one.softness->global;
    Json json{{"do", "softness"}, {"compression", compression}, {"stretch", stretch}, {"shear", shear}};
    for (const auto& [link, of_link] : one.softness->links) {
      const auto [a, b] = mesh_.links[link];
      json["links"].push_back({a, b, of_link.compression, of_link.stretch, of_link.shear});
    }
    return json;
  }
  Json operator()(const commands::Relax& one) const {
    const char* scheme = one.scheme == RelaxationScheme::link ? "link" : "mean";
    return {{"do", "relax"}, {"sweeps", one.sweeps}, {"step", one.step}, {"scheme", scheme}};
  }
  Json operator()(const commands::ReplaceMesh&) const { refuse(); }
  Json operator()(const commands::SetPositions&) const { refuse(); }
  Json operator()(const commands::RestoreState&) const { refuse(); }
  Json operator()(const commands::SetRelaxation&) const { return {}; }
  Json operator()(const commands::SetElastic&) const { return {}; }
  Json operator()(const commands::MoveControlPoint&) const { return {}; }
  Json operator()(const commands::SetAlgorithm&) const { return {}; }
  Json operator()(const commands::KeepState&) const { return {}; }
  Json operator()(const commands::DropState&) const { return {}; }

 private:
  [[noreturn]] static void refuse() {
    throw Error("moves", "the object was exchanged, or taken back, within them",
                "record them on one object without undo");
  }

  const Mesh& mesh_;
};

}  // namespace

void write_moves(std::ostream& out, const std::vector<Command>& commands, const Mesh& mesh, const Progress& progress) {
  out << "{\"version\": 1, \"commands\": [";
  const char* before = "\n";
  for (std::size_t i = 0; i < commands.size(); ++i) {
    progress.report(i, commands.size());
    if (const Json json = std::visit(MoveWriter(mesh), commands[i]); !json.is_null()) {
      out << before << json.dump();
      before = ",\n";
    }
  }
  out << "\n]}\n";
}

}  // namespace chainmail
