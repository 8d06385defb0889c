#include "files/formats/obj_scanner.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// tinyobjloader counts the corners of a face in one byte.
constexpr std::size_t most_corners = 255;

/// Statements that say nothing of elements and links.
constexpr std::array<std::string_view, 31> passed_over{
    "vn",    "vt",       "vp",       "g",    "o",    "s",      "mg",  "mtllib",     "usemtl",   "maplib", "usemap",
    "bevel", "c_interp", "d_interp", "lod",  "p",    "cstype", "deg", "bmat",       "step",     "curv",   "curv2",
    "surf",  "parm",     "trim",     "hole", "scrv", "sp",     "end", "shadow_obj", "trace_obj"};

std::optional<std::int64_t> parse_index(std::string_view word) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  return whole && number != 0 ? std::optional(number) : std::nullopt;
}

class ObjScanner {
 public:
  explicit ObjScanner(const std::filesystem::path& path) : path_(path) {}

  ObjText scan(std::string_view text, const Progress& progress);

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, line), problem, remedy);
  }
  void read_line(std::string_view line);
  void read_vertex(std::string_view rest);
  void read_corners(std::string_view line, std::string_view rest, bool is_face);
  std::int64_t read_corner(std::string_view word);
  void check_corners(bool is_face) const;
  void append_corners(char kind);

  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  ObjText result_;
  std::vector<std::int64_t> corners_;  // of the current line, from 0
  // The largest index met before its vertex, which may still come.
  std::int64_t farthest_ = 0;
  std::size_t farthest_line_ = 0;
};

void ObjScanner::read_vertex(std::string_view rest) {
  if (result_.vertices.size() == element_limit) {
    fail(line_, "there are more than " + std::to_string(element_limit) + " vertices", "use a smaller mesh");
  }
  std::array<double, 7> numbers{};  // x y z, and a weight or colours, which are not used
  std::size_t count = 0;
  for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
    const auto number = parse_number(word);
    if (!number || std::abs(*number) > coordinate_limit) {
      fail(line_, in_quotes(word) + " is not a number that a coordinate can be", "write a finite decimal number");
    }
    if (count == numbers.size()) {
      fail(line_, "a vertex has more than 7 numbers", "write 'v x y z'");
    }
    numbers[count++] = *number;
  }
  if (count < 3) {
    fail(line_, "a vertex has " + std::to_string(count) + " of its 3 coordinates", "write 'v x y z'");
  }
  result_.vertices.emplace_back(numbers[0], numbers[1], numbers[2]);
}

/// The vertex of a corner `v`, `v/t`, `v//n` or `v/t/n`, from 0.
std::int64_t ObjScanner::read_corner(std::string_view word) {
  std::array<std::string_view, 3> parts;
  std::size_t count = 0;
  for (std::string_view rest = word; count < parts.size();) {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    parts[count++] = rest.substr(0, end);
    if (end == rest.size()) {
      break;
    }
    rest.remove_prefix(end + 1);
  }
  const auto index = parse_index(parts[0]);
  const bool texture_fits = count < 2 || parse_index(parts[1]) || (count == 3 && parts[1].empty());
  const std::size_t length = parts[0].size() + parts[1].size() + parts[2].size() + count - 1;
  if (!index || !texture_fits || (count == 3 && !parse_index(parts[2])) || length != word.size()) {
    fail(line_, in_quotes(word) + " is not the index of a vertex", "indices are whole numbers from 1, or from -1 back");
  }
  const auto known = static_cast<std::int64_t>(result_.vertices.size());
  const std::int64_t vertex = *index > 0 ? *index - 1 : known + *index;
  if (vertex < 0 || vertex >= static_cast<std::int64_t>(element_limit)) {
    fail(line_, "there is no vertex " + std::to_string(*index), "use the indices of the file's vertices");
  }
  if (vertex >= known && vertex > farthest_) {
    farthest_ = vertex;
    farthest_line_ = line_;
  }
  return vertex;
}

void ObjScanner::check_corners(bool is_face) const {
  const std::size_t least = is_face ? 3 : 2;
  if (corners_.size() < least) {
    fail(line_,
         std::string(is_face ? "a face needs 3 corners" : "a line needs 2 corners") + " and has " +
             std::to_string(corners_.size()),
         "add the missing ones or remove it");
  }
  if (is_face && corners_.size() > most_corners) {
    fail(line_, "a face has more than " + std::to_string(most_corners) + " corners", "split it");
  }
  auto twice = std::adjacent_find(corners_.begin(), corners_.end());
  if (is_face && corners_.front() == corners_.back()) {
    twice = corners_.begin();
  }
  if (twice != corners_.end()) {
    fail(line_, "vertex " + std::to_string(*twice + 1) + " is linked to itself", "name each corner once");
  }
}

void ObjScanner::read_corners(std::string_view line, std::string_view rest, bool is_face) {
  corners_.clear();
  for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
    corners_.push_back(read_corner(word));
  }
  check_corners(is_face);
  if (line.find('-') == std::string_view::npos) {
    result_.faces_and_lines += line;
    result_.faces_and_lines += '\n';
  } else {
    append_corners(is_face ? 'f' : 'l');
  }
}

void ObjScanner::append_corners(char kind) {
  std::string& text = result_.faces_and_lines;
  text += kind;
  for (const std::int64_t corner : corners_) {
    text += ' ';
    append_number(text, std::uint64_t(corner + 1));
  }
  text += '\n';
}

void ObjScanner::read_line(std::string_view line) {
  if (const auto space = stated_space(line, path_, line_)) {
    if (result_.space && result_.space->value != *space) {
      fail(line_, "the space dimension differs from that of line " + std::to_string(result_.space->line),
           "state it once");
    }
    result_.space = {*space, line_};
  }
  line = line.substr(0, line.find('#'));
  std::string_view rest = line;
  const auto word = take_word(rest);
  if (word == "v") {
    read_vertex(rest);
  } else if (word == "f" || word == "l") {
    read_corners(line, rest, word == "f");
  } else if (!word.empty() && std::find(passed_over.begin(), passed_over.end(), word) == passed_over.end()) {
    fail(line_, in_quotes(word) + " begins no OBJ statement", "elements are 'v x y z', links come from 'f' and 'l'");
  }
}

ObjText ObjScanner::scan(std::string_view text, const Progress& progress) {
  result_.faces_and_lines.reserve(text.size());
  Lines lines(text);
  while (lines.next()) {
    line_ = lines.number();
    lines.report(progress);
    read_line(lines.line());
  }
  if (result_.vertices.empty()) {
    throw Error(shown(path_), "it holds no vertices", "write 'v x y z' for each element");
  }
  if (farthest_line_ != 0 && farthest_ >= static_cast<std::int64_t>(result_.vertices.size())) {
    fail(farthest_line_, "there is no vertex " + std::to_string(farthest_ + 1),
         "the file has " + std::to_string(result_.vertices.size()));
  }
  return std::move(result_);
}

}  // namespace

ObjText scan_obj(std::string_view text, const std::filesystem::path& path, const Progress& progress) {
  return ObjScanner(path).scan(text, progress);
}

}  // namespace chainmail
