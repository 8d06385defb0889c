#include "document/selection.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/application.h"

namespace chainmail {

std::vector<ElementId> combined(const std::vector<ElementId>& before, const std::vector<ElementId>& hit,
                                SelectionMode mode) {
  if (mode == SelectionMode::replace) {
    return hit;
  }
  std::vector<ElementId> result;
  if (mode == SelectionMode::add) {
    std::set_union(before.begin(), before.end(), hit.begin(), hit.end(), std::back_inserter(result));
  } else {
    std::set_difference(before.begin(), before.end(), hit.begin(), hit.end(), std::back_inserter(result));
  }
  return result;
}

std::vector<LinkId> linksAmong(const Mesh& mesh, const Cuts& cuts, const std::vector<ElementId>& elements) {
  std::vector<bool> selected(mesh.element_count());
  for (const ElementId e : elements) {
    selected[e] = true;
  }
  std::vector<LinkId> links;
  for (const ElementId e : elements) {
    for (EntryId entry = mesh.first_entry[e]; entry < mesh.first_entry[e + 1]; ++entry) {
      const ElementId other = mesh.neighbours[entry];
      // Each link is in two rows: take it from its smaller end.
      if (other > e && selected[other] && !cuts.is_cut(mesh.entry_link[entry])) {
        links.push_back(mesh.entry_link[entry]);
      }
    }
  }
  std::sort(links.begin(), links.end());
  return links;
}

void Selection::set(std::vector<ElementId> elements) {
  if (elements != elements_) {
    links_ = linksAmong(*contents_.object->mesh, contents_.object->cuts, elements);
    elements_ = std::move(elements);
    Application::guarded([this] { emit changed(); });
  }
}

void Selection::followCuts() {
  if (!empty()) {
    links_ = linksAmong(*contents_.object->mesh, contents_.object->cuts, elements_);
    Application::guarded([this] { emit changed(); });
  }
}

void Highlight::set(const Marks& marks) {
  if (marks != marks_) {
    marks_ = marks;
    Application::guarded([this] { emit changed(); });
  }
}

void Highlight::add(std::span<const LinkId> links) {
  if (!links.empty()) {
    marks_.links.insert(marks_.links.end(), links.begin(), links.end());
    emit changed();
  }
}

}  // namespace chainmail
