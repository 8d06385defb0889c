#include "files/results/summary.h"

#include <nlohmann/json.hpp>

#include "files/results/json_kind.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Point& point) { return {point.x(), point.y(), point.z()}; }

Json to_json(const Defects& defects) {
  return {{"duplicate_vertices", defects.duplicates.size()},
          {"loose_points", defects.loose.size()},
          {"holes", defects.holes.size()},
          {"hole_edges", defects.hole_edges()},
          {"non_manifold_edges", defects.non_manifold.size()},
          {"inverted_cells", defects.inverted.size()}};
}

Json counts_of(const MeshSummary& summary) {
  return {{"elements", summary.elements},
          {"links", summary.links},
          {"triangles", summary.triangles},
          {"defects", to_json(summary.defects)}};
}

}  // namespace

MeshSummary summarize(const Mesh& mesh) {
  MeshSummary summary;
  summary.elements = mesh.element_count();
  summary.links = mesh.link_count();
  summary.triangles = mesh.triangles.size();
  summary.tetrahedra = mesh.tetrahedra.size();
  summary.hexahedra = mesh.hexahedra.size();
  summary.object_dimension = mesh.object_dimension;
  summary.space_dimension = mesh.space_dimension;
  summary.components = mesh.part_count;
  summary.bounds = bounds(mesh);
  summary.mean_link_length = mesh.mean_link_length;
  return summary;
}

MeshSummary summarize(const OpenedMesh& opened) {
  MeshSummary summary = summarize(*opened.mesh);
  summary.flaws = opened.flaws;
  summary.defects = find_defects(*opened.mesh);
  summary.remark = opened.remark;
  return summary;
}

void write_json(std::ostream& out, const MeshSummary& summary) {
  const MeshFlaws& flaws = summary.flaws;
  const Json json{{"elements", summary.elements},
                  {"links", summary.links},
                  {"triangles", summary.triangles},
                  {"tetrahedra", summary.tetrahedra},
                  {"hexahedra", summary.hexahedra},
                  {"object_dimension", summary.object_dimension},
                  {"space_dimension", summary.space_dimension},
                  {"components", summary.components},
                  {"bounds", {to_json(summary.bounds[0]), to_json(summary.bounds[1])}},
                  {"mean_link_length", summary.mean_link_length},
                  {"left_out",
                   {{"unused", flaws.unused},
                    {"collapsed", flaws.collapsed},
                    {"doubled", flaws.doubled},
                    {"lines", flaws.skipped}}},
                  {"joined", flaws.joined},
                  {"flaws", {{"flat", flaws.flat}, {"inverted", flaws.inverted}, {"coincident", flaws.coincident}}},
                  {"defects", to_json(summary.defects)}};
  out << of_kind(json_kinds::info, json).dump(2) << '\n';
}

void write_json(std::ostream& out, const RepairSummary& summary) {
  const Json json{{"before", counts_of(summary.before)}, {"after", counts_of(summary.after)}};
  out << of_kind(json_kinds::repair, json).dump(2) << '\n';
}

void write_json(std::ostream& out, const DeformSummary& summary) {
  Json passes = Json::array();
  for (const auto& pass : summary.passes) {
    Json one = pass.handle.size() == 1 ? Json{{"element", pass.handle.front()}} : Json{{"elements", pass.handle}};
    one["target"] = to_json(pass.target);
    if (pass.rotation.degrees != 0) {
      one["rotate"] = {{"axis", to_json(pass.rotation.axis)}, {"degrees", pass.rotation.degrees}};
    }
    one["checked"] = pass.checked;
    one["moved"] = pass.moved;
    one["milliseconds"] = pass.milliseconds;
    if (pass.stopped_at) {
      one["stopped_at"] = to_json(*pass.stopped_at);
    }
    if (!pass.remark.empty()) {
      one["remark"] = pass.remark;
    }
    passes.push_back(std::move(one));
  }
  const auto& violation = summary.violation;
  Json json{{"algorithm", summary.algorithm},
            {"elements", summary.elements},
            {"links", summary.links},
            {"passes", std::move(passes)},
            {"violation", {{"max", violation.max}, {"rms", violation.rms}, {"fraction", violation.fraction}}},
            {"energy", summary.energy},
            {"displacement", {{"max", summary.displacement.max}, {"rms", summary.displacement.rms}}}};
  if (summary.volume_change || summary.inverted_cells || summary.largest_stretch) {
    const auto or_null = [](const auto& figure) { return figure ? Json(*figure) : Json(); };
    json["shape"] = {{"volume_change", or_null(summary.volume_change)},
                     {"inverted_cells", or_null(summary.inverted_cells)},
                     {"largest_stretch", or_null(summary.largest_stretch)}};
  }
  if (const auto& found = summary.equilibrium) {
    json["equilibrium"] = {{"violation", found->violation},
                           {"residual", found->residual},
                           {"energy_gap", found->gap ? Json(*found->gap) : Json()},
                           {"regions_bind", found->binds},
                           {"iterations", found->iterations}};
  }
  out << of_kind(json_kinds::deform, json).dump(2) << '\n';
}

}  // namespace chainmail
