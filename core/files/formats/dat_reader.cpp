#include <algorithm>
#include <string>
#include <vector>

#include "files/formats/dat.h"
#include "files/formats/dat_rows.h"
#include "files/formats/neighbour_rows.h"
#include "files/formats/space.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

class DatReader {
 public:
  DatReader(DatRows file, const std::filesystem::path& path, const ReadOptions& options)
      : file_(std::move(file)), path_(path), options_(options) {}

  MeshPointer read(const Progress& progress);

 private:
  using Row = DatRows::Row;

  [[noreturn]] void fail(std::size_t line, const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, line), problem, remedy);
  }
  void choose_size();
  void choose_lattice();
  std::vector<const Row*> rows_by_id() const;
  void place_rows(const std::vector<const Row*>& rows, const Progress& progress);
  void check_links(const std::vector<const Row*>& rows, const Progress& progress) const;

  const DatRows file_;
  const std::filesystem::path& path_;
  const ReadOptions& options_;
  Lattice lattice_;
  MeshParts parts_;
};

std::string named(ElementId id) { return "element " + std::to_string(id); }

std::string size_text(const Lattice& lattice) {
  const auto& [width, height, depth] = lattice.size;
  return std::to_string(width) + "x" + std::to_string(height) + (depth > 1 ? "x" + std::to_string(depth) : "");
}

void DatReader::choose_size() {
  if (options_.size) {
    lattice_.size = *options_.size;
  } else if (file_.size) {
    lattice_.size = file_.size->value;
  } else if (const auto named = parse_size(path_.stem().string()); named && path_.extension() == ".dat") {
    lattice_.size = *named;
  } else {
    throw Error(shown(path_), "the size of its lattice is not known",
                "give --size WxH[xD], write '# size W [H [D]]' into the file, or name it WxH[xD].dat");
  }
}

void DatReader::choose_lattice() {
  choose_size();
  lattice_.spacing = options_.spacing ? *options_.spacing : file_.spacing ? file_.spacing->value : 1;
  const auto& size = lattice_.size;
  const std::string where = !options_.size && file_.size ? shown(path_, file_.size->line) : shown(path_);
  if (double(size[0]) * size[1] * size[2] > double(element_limit)) {
    throw Error(where,
                "the size " + size_text(lattice_) + " is more than " + std::to_string(element_limit) + " elements",
                "use a smaller mesh");
  }
  if (!(lattice_.spacing * *std::max_element(size.begin(), size.end()) < coordinate_limit)) {
    throw Error(file_.spacing ? shown(path_, file_.spacing->line) : shown(path_), "the spacing is too large",
                "scale the mesh down");
  }
}

/// The row of each element: none without one, none with two.
std::vector<const DatRows::Row*> DatReader::rows_by_id() const {
  const std::uint64_t count = lattice_.element_count();
  // Not more than the file has rows, whatever size it claims.
  std::vector<const Row*> of(std::min<std::uint64_t>(count, file_.rows.size()), nullptr);
  for (const Row& row : file_.rows) {
    if (row.id >= count) {
      fail(row.line, named(row.id) + " lies outside the size " + size_text(lattice_),
           "ids run from 0 to " + std::to_string(count - 1));
    }
    if (row.id < of.size()) {
      if (of[row.id] != nullptr) {
        fail(row.line, named(row.id) + " has a row in line " + std::to_string(of[row.id]->line),
             "give each element one row");
      }
      of[row.id] = &row;
    }
  }
  const auto missing = std::find(of.begin(), of.end(), nullptr);
  if (missing != of.end() || of.size() < count) {
    fail(file_.last_line,
         "the file ends without a row for element " + std::to_string(missing - of.begin()) + " (" +
             std::to_string(file_.rows.size()) + " rows, and the size is " + size_text(lattice_) + ")",
         "add the row or correct the size");
  }
  return of;
}

void DatReader::place_rows(const std::vector<const Row*>& rows, const Progress& progress) {
  const auto& listed = file_.neighbours;
  parts_.first_entry.push_back(0);
  parts_.neighbours.reserve(listed.size());
  parts_.first_entry.reserve(file_.rows.size() + 1);
  for (const Row* row : rows) {
    progress.report(parts_.first_entry.size(), file_.rows.size());
    parts_.neighbours.insert(parts_.neighbours.end(), listed.begin() + static_cast<std::ptrdiff_t>(row->first),
                             listed.begin() + static_cast<std::ptrdiff_t>(row->last));
    parts_.first_entry.push_back(static_cast<EntryId>(parts_.neighbours.size()));
  }
}

void DatReader::check_links(const std::vector<const Row*>& rows, const Progress& progress) const {
  if (const auto fault = find_row_fault(parts_.first_entry, parts_.neighbours, progress)) {
    fail(rows[fault->element]->line, fault->problem, fault->remedy);
  }
}

MeshPointer DatReader::read(const Progress& progress) {
  if (file_.rows.empty()) {
    throw Error(shown(path_), "it holds no rows", "write a row 'id count neighbour…' for each element");
  }
  choose_lattice();
  const auto rows = rows_by_id();
  place_rows(rows, progress.part(0, 0.2));
  check_links(rows, progress.part(0.2, 0.5));
  parts_.rest.reserve(file_.rows.size());
  for (ElementId element = 0; element < file_.rows.size(); ++element) {
    parts_.rest.push_back(lattice_.position(element));
  }
  parts_.lattice = lattice_;
  parts_.space_dimension = chosen_space(parts_, options_.space_dimension, file_.space, path_);
  return build_mesh(std::move(parts_), progress.part(0.5, 1));
}

}  // namespace

MeshPointer read_dat(std::string_view text, const std::filesystem::path& path, const ReadOptions& options,
                     const Progress& progress) {
  return DatReader(parse_dat(text, path, progress.part(0, 0.5)), path, options).read(progress.part(0.5, 1));
}

}  // namespace chainmail
