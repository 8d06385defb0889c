#include "files/formats/dat.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "files/formats/neighbour_rows.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// The content of a .dat file, line by line. Rows are not yet checked against each other.
struct DatRows {
  struct Row {
    ElementId id;
    std::size_t line;
    std::size_t first, last;  // range of its neighbours in `neighbours`
  };

  std::vector<Row> rows;
  std::vector<ElementId> neighbours;  // neighbours of all rows, in the order of the file
  std::optional<Stated<std::array<std::uint32_t, 3>>> size;
  std::optional<Stated<double>> spacing;
  std::optional<Stated<int>> space;
  std::size_t last_line = 0;
};

/// Parses the lines of a .dat file. Throws Error, with the line, if a row or a comment is malformed, if two comments
/// contradict each other, or if an element is linked to itself.
class DatParser {
 public:
  explicit DatParser(const std::filesystem::path& path) : path_(path) {}

  DatRows parse(std::string_view text, const Progress& progress);

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, line_), problem, remedy);
  }
  template <class Value>
  void state(std::optional<Stated<Value>>& known, const Value& value, const std::string& what) const;
  void read_comment(std::string_view line);
  void read_size(std::string_view numbers);
  void read_spacing(std::string_view numbers);
  void read_row(std::string_view line);
  ElementId read_id(std::string_view word) const;
  std::uint32_t read_count(std::string_view word) const;

  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  DatRows result_;
};

template <class Value>
void DatParser::state(std::optional<Stated<Value>>& known, const Value& value, const std::string& what) const {
  if (known && known->value != value) {
    fail("the " + what + " differs from that of line " + std::to_string(known->line), "write it once");
  }
  known = Stated<Value>{value, line_};
}

void DatParser::read_size(std::string_view numbers) {
  std::array<std::uint32_t, 3> size{1, 1, 1};
  int count = 0;
  for (auto word = take_word(numbers); !word.empty(); word = take_word(numbers)) {
    const auto number = parse_count(word);
    if (!number || *number == 0 || count == 3) {
      fail("the size must be one to three whole numbers above 0", "write '# size W [H [D]]'");
    }
    size[count++] = *number;
  }
  state(result_.size, size, "size");
}

void DatParser::read_spacing(std::string_view numbers) {
  const auto number = parse_number(take_word(numbers));
  if (!number || !(*number > 0) || !take_word(numbers).empty()) {
    fail("the spacing is not one number above 0", "write '# spacing S'");
  }
  state(result_.spacing, *number, "spacing");
}

void DatParser::read_comment(std::string_view line) {
  if (const auto size = stated(line, "size")) {
    read_size(*size);
  } else if (const auto spacing = stated(line, "spacing")) {
    read_spacing(*spacing);
  } else if (const auto space = stated_space(line, path_, line_)) {
    state(result_.space, *space, "space dimension");
  }
}

ElementId DatParser::read_id(std::string_view word) const {
  const auto id = parse_count(word);
  if (!id) {
    fail(in_quotes(word) + " is not an element's id", "use a whole number from 0");
  }
  return *id;
}

std::uint32_t DatParser::read_count(std::string_view word) const {
  if (word.empty()) {
    fail("the row ends before the count", "write 'id count neighbour…'");
  }
  const auto count = parse_count(word);
  if (!count) {
    fail(in_quotes(word) + " is not a count of neighbours", "write 'id count neighbour…'");
  }
  return *count;
}

void DatParser::read_row(std::string_view line) {
  line = line.substr(0, line.find('#'));
  const auto first = take_word(line);
  if (first.empty()) {
    return;
  }
  if (result_.rows.size() == element_limit) {
    fail("there are more than " + std::to_string(element_limit) + " rows", "use a smaller mesh");
  }
  DatRows::Row row{read_id(first), line_, result_.neighbours.size(), 0};
  const std::uint32_t count = read_count(take_word(line));
  for (auto word = take_word(line); !word.empty(); word = take_word(line)) {
    result_.neighbours.push_back(read_id(word));
    if (result_.neighbours.back() == row.id) {
      fail("element " + std::to_string(row.id) + " is linked to itself", "remove that neighbour");
    }
  }
  row.last = result_.neighbours.size();
  if (const std::size_t listed = row.last - row.first; listed != count) {
    fail("the count says " + std::to_string(count) + " neighbours, but the row lists " + std::to_string(listed),
         "correct the count or the list");
  }
  result_.rows.push_back(row);
}

DatRows DatParser::parse(std::string_view text, const Progress& progress) {
  Lines lines(text);
  while (lines.next()) {
    line_ = lines.number();
    lines.report(progress);
    read_comment(lines.line());
    read_row(lines.line());
  }
  result_.last_line = line_;
  return std::move(result_);
}

/// Chooses the lattice and sorts the rows by element.
class DatReader {
 public:
  DatReader(const DatRows& file, const std::filesystem::path& path, const ReadOptions& options)
      : file_(file), path_(path), options_(options) {}

  ImportedMesh read(const Progress& progress);

 private:
  using Row = DatRows::Row;

  [[noreturn]] void fail(std::size_t line, const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, line), problem, remedy);
  }
  /// Returns what an error about a value names: the option of this name if it was given, else the line of the file.
  template <class Option, class InFile>
  std::string origin_of(const char* name, const Option& option, const InFile& in_file) const {
    return option ? name : in_file ? shown(path_, in_file->line) : shown(path_);
  }
  void choose_size();
  void choose_lattice();
  std::vector<const Row*> rows_by_id() const;
  void place_rows(const std::vector<const Row*>& rows, const Progress& progress);
  void check_links(const std::vector<const Row*>& rows, const Progress& progress) const;

  const DatRows& file_;
  const std::filesystem::path& path_;
  const ReadOptions& options_;
  Lattice lattice_;
  MeshParts parts_;
};

std::string row_name(ElementId id) { return "element " + std::to_string(id); }

std::string lattice_size_text(const Lattice& lattice) {
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
                "use --size WxH[xD], write '# size W [H [D]]' into the file, or name it WxH[xD].dat");
  }
}

void DatReader::choose_lattice() {
  choose_size();
  lattice_.spacing = options_.spacing ? *options_.spacing : file_.spacing ? file_.spacing->value : 1;
  const auto& size = lattice_.size;
  if (double(size[0]) * size[1] * size[2] > double(element_limit)) {
    throw Error(
        origin_of("size", options_.size, file_.size),
        "the size " + lattice_size_text(lattice_) + " is more than " + std::to_string(element_limit) + " elements",
        "use a smaller mesh");
  }
  if (!(lattice_.spacing * *std::max_element(size.begin(), size.end()) < coordinate_limit)) {
    throw Error(origin_of("spacing", options_.spacing, file_.spacing), "the spacing is too large",
                options_.spacing ? "use a smaller spacing" : "scale the mesh down");
  }
}

/// Returns the row of each element. Throws Error if an element has no row, or two.
std::vector<const DatRows::Row*> DatReader::rows_by_id() const {
  const std::uint64_t count = lattice_.element_count();
  // The file may state any size, so no more memory is taken than for its rows.
  std::vector<const Row*> of(std::min<std::uint64_t>(count, file_.rows.size()), nullptr);
  for (const Row& row : file_.rows) {
    if (row.id >= count) {
      fail(row.line, row_name(row.id) + " lies outside the size " + lattice_size_text(lattice_),
           "use an id from 0 to " + std::to_string(count - 1));
    }
    if (row.id < of.size()) {
      if (of[row.id] != nullptr) {
        fail(row.line, row_name(row.id) + " already has a row in line " + std::to_string(of[row.id]->line),
             "write one row for each element");
      }
      of[row.id] = &row;
    }
  }
  const auto missing = std::find(of.begin(), of.end(), nullptr);
  if (missing != of.end() || of.size() < count) {
    fail(file_.last_line,
         "the file ends without a row for element " + std::to_string(missing - of.begin()) + " (" +
             std::to_string(file_.rows.size()) + " rows, but the size is " + lattice_size_text(lattice_) + ")",
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

ImportedMesh DatReader::read(const Progress& progress) {
  if (file_.rows.empty()) {
    throw Error(shown(path_), "it contains no rows", "write a row 'id count neighbour…' for each element");
  }
  choose_lattice();
  const auto rows = rows_by_id();
  place_rows(rows, progress.part(0, 0.4));
  check_links(rows, progress.part(0.4, 1));
  parts_.rest.reserve(file_.rows.size());
  for (ElementId element = 0; element < file_.rows.size(); ++element) {
    parts_.rest.push_back(lattice_.position(element));
  }
  parts_.lattice = lattice_;
  return {.parts = std::move(parts_), .space = file_.space, .checked = true};
}

std::string dat_header(const Mesh& mesh) {
  const auto& [width, height, depth] = mesh.lattice->size;
  std::string text = "# size " + std::to_string(width);
  if (height > 1 || depth > 1) {
    text += " " + std::to_string(height);
  }
  if (depth > 1) {
    text += " " + std::to_string(depth);
  }
  text += "\n# spacing ";
  append_number(text, mesh.lattice->spacing);
  return text + "\n" + space_comment(mesh, rest_positions(mesh));
}

void write_dat_row(TextBlocks& text, const Mesh& mesh, const Cuts& cuts, ElementId element) {
  const auto cut = [&](EntryId entry) { return cuts.is_cut(mesh.entry_link[entry]); };
  const EntryId first = mesh.first_entry[element], last = mesh.first_entry[element + 1];
  std::uint32_t count = 0;
  for (EntryId entry = first; entry < last; ++entry) {
    count += cut(entry) ? 0 : 1;
  }
  text << element << ' ' << count;
  for (EntryId entry = first; entry < last; ++entry) {
    if (!cut(entry)) {
      text << ' ' << mesh.neighbours[entry];
    }
  }
  text << '\n';
}

}  // namespace

ImportedMesh read_dat(std::string_view text, const std::filesystem::path& path, const ReadOptions& options,
                      const Progress& progress) {
  const DatRows rows = DatParser(path).parse(text, progress.part(0, 0.5));
  return DatReader(rows, path, options).read(progress.part(0.5, 1));
}

void write_dat(std::ostream& out, const MeshState& state, const Progress& progress) {
  if (!state.mesh.lattice) {
    throw Error(".dat", "the format can only store lattices, and this mesh has none", "save it as .obj");
  }
  out << dat_header(state.mesh);
  TextBlocks text(out);
  const ElementId count = state.mesh.element_count();
  for (ElementId element = 0; element < count; ++element) {
    progress.report(element, count);
    write_dat_row(text, state.mesh, state.cuts, element);
  }
  text.flush();
}

}  // namespace chainmail
