#include "mesh/row_kinds.h"

#include <map>
#include <utility>

#include "mesh/mesh.h"

namespace chainmail {
namespace {

class KindFinder {
 public:
  explicit KindFinder(const Mesh& mesh) : mesh_(mesh) { kinds_.first.push_back(0); }

  /// Returns false if there are too many kinds.
  bool add(ElementId element) {
    // In a lattice, most elements are of the same kind as the one before.
    std::size_t kind = kinds_.of.empty() ? kinds_.first.size() : kinds_.of.back();
    if (!is_of(element, kind)) {
      kind = find_or_add(element);
    }
    kinds_.of.push_back(static_cast<std::uint8_t>(kind));
    return kind < RowKinds::limit;
  }

  RowKinds take() { return std::move(kinds_); }

 private:
  using Row = std::vector<std::uint32_t>;  // the offsets, then the shapes

  bool has_shapes() const { return !mesh_.entry_shape.empty(); }

  bool is_of(ElementId element, std::size_t kind) const {
    const auto row = mesh_.neighbours_of(element);
    if (kind + 1 >= kinds_.first.size() || kinds_.first[kind + 1] - kinds_.first[kind] != row.size()) {
      return false;
    }
    const std::size_t at = kinds_.first[kind], first = mesh_.first_entry[element];
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i] - element != kinds_.offset[at + i] ||
          (has_shapes() && mesh_.entry_shape[first + i] != kinds_.shape[at + i])) {
        return false;
      }
    }
    return true;
  }

  /// Returns the number of the kind, or the limit if there are too many.
  std::size_t find_or_add(ElementId element) {
    Row row;
    for (const ElementId neighbour : mesh_.neighbours_of(element)) {
      row.push_back(neighbour - element);
    }
    const std::size_t count = row.size(), first = mesh_.first_entry[element];
    for (std::size_t i = 0; i < count && has_shapes(); ++i) {
      row.push_back(mesh_.entry_shape[first + i]);
    }
    const auto [found, is_new] = numbers_.try_emplace(std::move(row), numbers_.size());
    if (is_new && found->second < RowKinds::limit) {
      const Row& added = found->first;
      kinds_.offset.insert(kinds_.offset.end(), added.begin(), added.begin() + std::ptrdiff_t(count));
      kinds_.shape.insert(kinds_.shape.end(), added.begin() + std::ptrdiff_t(count), added.end());
      kinds_.first.push_back(static_cast<std::uint32_t>(kinds_.offset.size()));
    }
    return found->second;
  }

  const Mesh& mesh_;
  RowKinds kinds_;
  std::map<Row, std::size_t> numbers_;
};

}  // namespace

RowKinds find_row_kinds(const Mesh& mesh, const Progress& progress) {
  KindFinder finder(mesh);
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    progress.report(e, mesh.element_count());
    if (!finder.add(e)) {
      return {};
    }
  }
  return finder.take();
}

}  // namespace chainmail
