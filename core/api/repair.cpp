#include "chainmail/repair.h"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "api/access.h"
#include "chainmail/text.h"
#include "files/mesh/fill.h"
#include "files/repair/repair.h"
#include "files/repair/simplify.h"
#ifdef CHAINMAIL_HAS_JSON
#include "files/results/summary.h"
#endif

namespace chainmail::api {

struct Repair::Impl {
  Mesh before, mesh;
  Defects defects_before, defects;
  std::vector<std::string> done;
};

namespace {

std::string number_of(std::size_t count, const char* one, const char* several) {
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

/// Repairs a mesh step by step, and describes what was done.
class Repairing {
 public:
  explicit Repairing(const Mesh& mesh)
      : mesh_(Access::pointer(mesh)), softness_(Access::impl(mesh).softness), defects_(find_defects(*mesh_)) {}

  void weld(double tolerance, const Progress& progress) {
    const ElementId before = mesh_->element_count();
    if (tolerance > 0 || !defects_.duplicates.empty()) {
      take(inner::weld(*mesh_, tolerance, progress));
    }
    if (const ElementId count = before - mesh_->element_count(); count > 0) {
      done_.push_back(number_of(count, "duplicate vertex welded", "duplicate vertices welded"));
    }
  }
  void remove_loose(const Progress& progress) {
    if (const auto count = defects_.loose.size(); count > 0) {
      take(inner::remove_loose(*mesh_, progress));
      done_.push_back(number_of(count, "loose point removed", "loose points removed"));
    }
  }
  void close_holes(const Progress& progress) {
    if (!defects_.holes.empty()) {
      const std::size_t before = defects_.holes.size(), triangles = mesh_->triangles.size();
      take(inner::close_holes(*mesh_, defects_.holes, progress));
      done_.push_back(number_of(before - std::min(before, defects_.holes.size()), "hole", "holes") + " closed with " +
                      number_of(mesh_->triangles.size() - triangles, "triangle", "triangles"));
    }
  }
  void turn_cells(const Progress& progress) {
    if (const auto count = defects_.inverted.size(); count > 0) {
      take(inner::turn_cells(*mesh_, defects_.inverted, progress));
      done_.push_back(number_of(count, "cell turned", "cells turned"));
    }
  }

  const Defects& defects() const { return defects_; }
  Repair finished(const Mesh& before, Defects defects_before) {
    return Access::make<Repair>(before, Access::mesh(std::move(mesh_), std::move(softness_)), std::move(defects_before),
                                std::move(defects_), std::move(done_));
  }

 private:
  void take(const Repaired& repaired) {
    softness_ = softness_after(softness_, *mesh_, repaired);
    mesh_ = repaired.mesh;
    defects_ = find_defects(*mesh_);
  }

  MeshPointer mesh_;
  OwnSoftness softness_;
  Defects defects_;
  std::vector<std::string> done_;
};

}  // namespace

std::string describe(const Mesh& mesh) {
  const auto& impl = Access::impl(mesh);
  const auto bounds = mesh.bounds();
  std::ostringstream out;
  out << "elements          " << mesh.element_count() << '\n'
      << "links             " << mesh.link_count() << '\n'
      << "triangles         " << impl.mesh->triangles.size() << '\n'  // with those of polygons
      << "tetrahedra        " << mesh.tetrahedra().size() << '\n'
      << "hexahedra         " << mesh.hexahedra().size() << '\n'
      << "object dimension  " << mesh.object_dimension() << '\n'
      << "space dimension   " << mesh.space_dimension() << '\n'
      << "parts             " << mesh.part_count() << '\n'
      << "bounds            " << in_words(bounds[0]) << " to " << in_words(bounds[1]) << '\n'
      << "mean link length  " << digits_of(mesh.mean_rest_length()) << '\n';
  const std::string defects = joined_words(inner::in_words(find_defects(*impl.mesh)), ", ");
  for (const auto& [title, words] :
       {std::pair("read as           ", impl.conversion), std::pair("note              ", impl.flaw_words),
        std::pair("defects           ", defects)}) {
    if (!words.empty()) {
      out << title << words << '\n';
    }
  }
  return std::move(out).str();
}

const Mesh& Repair::mesh() const { return impl_->mesh; }

std::string Repair::text() const {
  const auto& [before, mesh, defects_before, defects, done] = *impl_;
  std::string text = "repaired  " + (done.empty() ? "nothing" : joined_words(done, ", ")) + '\n';
  if (!defects.empty()) {
    text += "left      " + joined_words(inner::in_words(defects), ", ") + '\n';
  }
  if (defects.outlines > 0) {
    text += "open      " + number_of(defects.outlines, "border: the outline", "borders: outlines") +
            " of an open surface\n";
  }
  return text;
}

#ifdef CHAINMAIL_HAS_JSON

std::string describe_json(const Mesh& mesh) {
  const auto& impl = Access::impl(mesh);
  const OpenedMesh opened{impl.mesh, {}, impl.flaws, impl.conversion};
  return written([&](std::ostream& out) { write_json(out, summarize(opened)); });
}

std::string Repair::json() const {
  RepairSummary summary{summarize(*Access::pointer(impl_->before)), summarize(*Access::pointer(impl_->mesh))};
  summary.before.defects = impl_->defects_before;
  summary.after.defects = impl_->defects;
  return written([&](std::ostream& out) { write_json(out, summary); });
}

#else

std::string describe_json(const Mesh& /*mesh*/) { refuse_without("nlohmann/json", "describe_json"); }
std::string Repair::json() const { refuse_without("nlohmann/json", "repair"); }

#endif

Repair repair(const Mesh& mesh, const RepairOptions& options, const Job& job) {
  return guarded([&] {
    const Progress progress = Access::progress(job);
    Repairing repairing(mesh);
    Defects before = repairing.defects();
    if (options.weld) {
      repairing.weld(options.tolerance, progress.part(0, 0.2));
    }
    if (options.loose) {
      repairing.remove_loose(progress.part(0.2, 0.4));
    }
    if (options.holes) {
      repairing.close_holes(progress.part(0.4, 1));
    }
    if (options.cells) {
      repairing.turn_cells(progress.part(0.9, 1));
    }
    return repairing.finished(mesh, std::move(before));
  });
}

static_assert(fewest_simplified == inner::fewest_simplified);

Mesh simplify(const Mesh& surface, std::uint64_t elements, const Job& job) {
  return guarded(
      [&] { return Access::mesh(inner::simplify(*Access::pointer(surface), elements, Access::progress(job))); });
}

Mesh fill(const Mesh& surface, std::optional<double> size, const Job& job) {
  return guarded([&] {
    const double length = size.value_or(surface.mean_rest_length());
    return Access::mesh(inner::fill(*Access::pointer(surface), length, Access::progress(job)));
  });
}

}  // namespace chainmail::api
