#include "files/results/summary.h"

#include <map>
#include <nlohmann/json.hpp>

#include "files/formats/mesh_state.h"
#include "files/results/json_kind.h"
#include "files/text/text.h"
#include "report/table/format.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const auto& figure) { return figure ? Json(*figure) : Json(); }

Json to_json(const Point& point) { return {point.x(), point.y(), point.z()}; }

Json to_json(const Defects& defects) {
  return {{"duplicate_vertices", defects.duplicates.size()},
          {"loose_points", defects.loose.size()},
          {"holes", defects.holes.size()},
          {"hole_edges", defects.hole_edges()},
          {"non_manifold_edges", defects.non_manifold.size()},
          {"inverted_cells", defects.inverted.size()}};
}

Json counts_of(const Mesh& mesh, const Defects& defects) {
  return {{"elements", mesh.element_count()},
          {"links", mesh.link_count()},
          {"triangles", mesh.triangles.size()},
          {"defects", to_json(defects)}};
}

std::string passes_of(std::size_t count, std::size_t all) {
  return all == 1 ? "the pass" : std::to_string(count) + " of " + std::to_string(all) + " passes";
}

std::string coordinates_of(const Point& point) {
  std::string text;
  for (int k = 0; k < 3; ++k) {
    text += k == 0 ? "(" : ", ";
    append_number(text, point[k]);
  }
  return text + ")";
}

void write_pass(std::ostream& out, const DeformSummary::Pass& pass) {
  const auto point = [&out](const Point& at) { out << '(' << at.x() << ", " << at.y() << ", " << at.z() << ')'; };
  pass.handle.size() == 1 ? out << "element " << pass.handle.front() : out << pass.handle.size() << " elements";
  out << " to ";
  point(pass.target);
  if (pass.rotation.degrees != 0) {
    out << ", rotated by " << pass.rotation.degrees << " degrees about ";
    point(pass.rotation.axis);
  }
  out << ", " << pass.checked << " checked, " << pass.moved << " moved, " << pass.milliseconds << " ms";
  if (pass.stopped_at) {
    out << (pass.remark.empty() ? ", stopped by pins at " : ", stopped at ");
    point(*pass.stopped_at);
  }
  out << (pass.remark.empty() ? "" : ", ") << pass.remark << '\n';
}

void add_cells(Json& json, const std::optional<CellFigures>& found) {
  if (found) {
    json["cells"] = found->cells;
    json["parts"] = found->parts;
    json["volume"] = {{"rest", found->rest_volume}, {"now", found->volume}};
    json["worst_quality"] = or_null(found->worst_quality);
  }
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
  summary.cells = cell_figures(mesh, {}, rest_positions(mesh));
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
  Json json{{"elements", summary.elements},
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
  add_cells(json, summary.cells);
  out << of_kind(json_kinds::info, json).dump(2) << '\n';
}

void write_json(std::ostream& out, const RepairResult& repair) {
  const Json json{{"before", counts_of(*repair.before, repair.defects_before)},
                  {"after", counts_of(*repair.mesh, repair.defects)}};
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
  Json json{{"algorithm", info(summary.algorithm).name},
            {"elements", summary.elements},
            {"links", summary.links},
            {"passes", std::move(passes)},
            {"violation", {{"max", violation.max}, {"rms", violation.rms}, {"fraction", violation.fraction}}},
            {"energy", summary.energy},
            {"displacement", {{"max", summary.displacement.max}, {"rms", summary.displacement.rms}}}};
  if (summary.volume_change || summary.inverted_cells || summary.largest_stretch) {
    json["shape"] = {{"volume_change", or_null(summary.volume_change)},
                     {"inverted_cells", or_null(summary.inverted_cells)},
                     {"largest_stretch", or_null(summary.largest_stretch)}};
  }
  if (const auto& found = summary.equilibrium) {
    json["equilibrium"] = {{"violation", found->violation},
                           {"residual", found->residual},
                           {"energy_gap", or_null(found->gap)},
                           {"regions_bind", found->binds},
                           {"iterations", found->iterations}};
  }
  if (const auto& local = summary.local) {
    Json milliseconds = Json::array();
    for (const auto& pass : summary.passes) {
      milliseconds.push_back(pass.relaxation_ms);
    }
    json["relaxation"] = {
        {"milliseconds", std::move(milliseconds)}, {"nodes", local->nodes}, {"estimate", local->estimate}};
  }
  add_cells(json, summary.cells);
  out << of_kind(json_kinds::deform, json).dump(2) << '\n';
}

std::vector<std::string> notes_of(const DeformSummary& summary) {
  std::map<std::string, std::size_t> remarks;
  std::size_t stopped = 0;
  const DeformSummary::Pass* last = nullptr;
  for (const auto& pass : summary.passes) {
    if (!pass.remark.empty()) {
      ++remarks[pass.remark];
    }
    if (pass.stopped_at) {
      ++stopped;
      last = &pass;
    }
  }
  const std::size_t all = summary.passes.size();
  std::vector<std::string> notes;
  notes.reserve(remarks.size() + 1);
  for (const auto& [remark, count] : remarks) {
    notes.push_back(passes_of(count, all) + ": " + remark);
  }
  if (last != nullptr) {
    notes.push_back(passes_of(stopped, all) + " stopped before the target; the last at " +
                    coordinates_of(*last->stopped_at) + " instead of " + coordinates_of(last->target));
  }
  return notes;
}

void write_text(std::ostream& out, const MeshSummary& summary) {
  std::string length;
  append_number(length, summary.mean_link_length);
  out << "elements          " << summary.elements << '\n'
      << "links             " << summary.links << '\n'
      << "triangles         " << summary.triangles << '\n'
      << "tetrahedra        " << summary.tetrahedra << '\n'
      << "hexahedra         " << summary.hexahedra << '\n'
      << "object dimension  " << summary.object_dimension << '\n'
      << "space dimension   " << summary.space_dimension << '\n'
      << "parts             " << summary.components << '\n'
      << "bounds            " << coordinates_of(summary.bounds[0]) << " to " << coordinates_of(summary.bounds[1])
      << '\n'
      << "mean link length  " << length << '\n';
  for (const auto& [title, words] :
       {std::pair("read as           ", summary.remark), std::pair("note              ", in_words(summary.flaws)),
        std::pair("defects           ", joined_words(in_words(summary.defects), ", "))}) {
    if (!words.empty()) {
      out << title << words << '\n';
    }
  }
}

void write_text(std::ostream& out, const RepairResult& repair) {
  out << "repaired  " << (repair.done.empty() ? "nothing" : joined_words(repair.done, ", ")) << '\n';
  if (!repair.defects.empty()) {
    out << "left      " << joined_words(in_words(repair.defects), ", ") << '\n';
  }
  if (const auto outlines = repair.defects.outlines; outlines > 0) {
    out << "open      " << counted(outlines, "border: the outline", "borders: outlines") << " of an open surface\n";
  }
}

void write_text(std::ostream& out, const DeformSummary& summary) {
  out << info(summary.algorithm).offered_name() << " on " << summary.elements << " elements, " << summary.links
      << " links\n";
  for (std::size_t i = 0; i < summary.passes.size(); ++i) {
    out << "pass " << i << ": ";
    write_pass(out, summary.passes[i]);
  }
  out << "violation: max " << summary.violation.max << " rest lengths, RMS " << summary.violation.rms << ", "
      << 100 * summary.violation.fraction << "% of links\n";
  if (const auto& found = summary.equilibrium) {
    out << "equilibrium: residual " << found->residual << " after " << found->iterations << " iterations, ";
    if (found->gap) {
      out << "energy about " << 100 * *found->gap << "% above the least, ";
    }
    out << "largest violation " << found->violation << " rest lengths, valid regions "
        << (found->binds ? "bind" : "do not bind") << '\n';
  }
  if (const auto& local = summary.local) {
    out << "relaxed with " << local->nodes << " unknown positions: about " << 100 * local->estimate
        << "% from the equilibrium\n";
  }
}

void write_text(std::ostream& out, const CalibrationOptions& options, const CalibrationResult& result) {
  const Material& material = options.elastic.material;
  out << info(options.algorithm).label << " comes closest to neo-Hookean FEM on the same cells (Young's modulus "
      << report::figure(material.young) << ", Poisson's ratio " << report::figure(material.poisson) << ") with\n  "
      << report::region_in_words(result.softness) << ", ";
  if (info(options.scheme).sweeps) {
    out << result.sweeps << " sweeps per move\n";
  } else {
    out << report::energy_in_words(result.softness) << ", at equilibrium (" << info(options.energy).name
        << " energy)\n";
  }
}

}  // namespace chainmail
