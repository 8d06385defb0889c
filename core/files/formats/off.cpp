#include "files/formats/off.h"

#include <string>
#include <vector>

#include "files/text/text.h"
#include "files/text/words.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Reads the first word: OFF behind letters for what each vertex has besides its position, in this order.
class OffHead {
 public:
  explicit OffHead(std::string_view word) {
    const auto take = [&word](std::string_view letters) {
      const bool has = word.starts_with(letters);
      word.remove_prefix(has ? letters.size() : 0);
      return has;
    };
    behind_ += take("ST") ? 2 : 0;
    behind_ += take("NC") ? 7 : 0;  // as MeshLab writes it
    behind_ += take("C") ? 4 : 0;
    behind_ += take("N") ? 3 : 0;
    states_dimension_ = take("n");
    is_known_ = word.starts_with("OFF");
    const std::string_view behind = is_known_ ? word.substr(3) : std::string_view();
    is_known_ = is_known_ && (behind.empty() || parse_count(behind));
    counts_in_word_ = behind.size();
    is_in_more_dimensions_ = word == "4OFF" || word == "4nOFF";
  }

  bool is_known() const { return is_known_; }
  bool is_in_more_dimensions() const { return is_in_more_dimensions_; }
  /// True if the next number is that of the dimensions.
  bool states_dimension() const { return states_dimension_; }
  /// Number of letters of a count that follows without a blank.
  std::size_t counts_in_word() const { return counts_in_word_; }
  /// Number of numbers behind the coordinates of a vertex.
  std::size_t behind() const { return behind_; }

 private:
  bool is_known_ = false, is_in_more_dimensions_ = false, states_dimension_ = false;
  std::size_t behind_ = 0, counts_in_word_ = 0;
};

class OffReader {
 public:
  OffReader(std::string_view text, const std::filesystem::path& path, const Progress& progress)
      : words_(text, path, progress) {}

  ImportedMesh read() {
    read_head();
    const std::uint32_t vertices = words_.count("the number of vertices"), faces = words_.count("the number of faces");
    read_edge_count(vertices);
    for (std::uint32_t i = 0; i < vertices; ++i) {
      read_vertex();
    }
    for (std::uint32_t i = 0; i < faces; ++i) {
      read_face();
    }
    return std::move(mesh_);
  }

 private:
  void read_head();
  void read_edge_count(std::uint32_t vertices);
  void read_vertex();
  void read_face();
  ElementId read_corner();

  Words words_;
  std::size_t behind_ = 0;
  std::vector<ElementId> corners_;
  ImportedMesh mesh_;
};

void OffReader::read_head() {
  const std::string_view word = words_.next();
  const OffHead head(word);
  if (head.is_in_more_dimensions()) {
    words_.fail("its points have more than 3 coordinates", "save it in space");
  }
  if (!head.is_known()) {
    words_.fail("it does not begin with OFF", "export it again");
  }
  behind_ = head.behind();
  words_.split(word.size() - head.counts_in_word());
  if (words_.peek() == "BINARY") {
    words_.fail("it is a binary OFF file", "save it as text");
  }
  if (const std::uint32_t dimension = head.states_dimension() ? words_.count("the number of dimensions") : 3;
      dimension != 3) {
    words_.fail("its points have " + std::to_string(dimension) + " coordinates", "save it in space, with 3");
  }
}

/// The number of edges says nothing, and some programs leave it out. Then the counts have a line of their own.
void OffReader::read_edge_count(std::uint32_t vertices) {
  if (words_.left() / 2 < vertices) {
    words_.fail("it is too short for " + std::to_string(vertices) + " vertices", "export it again");
  }
  if (vertices > element_limit) {
    words_.fail("there are more than " + std::to_string(element_limit) + " vertices", "use a smaller mesh");
  }
  if (!words_.ends_line()) {
    words_.count("the number of edges");
  }
}

void OffReader::read_vertex() {
  Point point;
  bool begins_line = false;
  for (int axis = 0; axis < 3; ++axis) {
    point[axis] = words_.coordinate();
    begins_line = begins_line || (axis == 0 && words_.begins_line());
  }
  mesh_.parts.rest.push_back(point);
  if (begins_line) {
    words_.skip_line();  // colours may have three or four numbers
  } else {
    for (std::size_t i = 0; i < behind_; ++i) {
      words_.next();
    }
  }
}

ElementId OffReader::read_corner() {
  const std::uint32_t corner = words_.count("the number of a vertex");
  if (corner >= mesh_.parts.rest.size()) {
    words_.fail("there is no vertex " + std::to_string(corner), "number the vertices from 0, in their order");
  }
  return corner;
}

void OffReader::read_face() {
  const std::uint32_t corners = words_.count("the number of corners of a face");
  const bool begins_line = words_.begins_line();
  if (corners > words_.left() / 2) {
    words_.fail("it is too short for a face of " + std::to_string(corners) + " corners", "export it again");
  }
  corners_.clear();
  for (std::uint32_t i = 0; i < corners; ++i) {
    corners_.push_back(read_corner());
  }
  if (begins_line) {
    words_.skip_line();  // a colour
  }
  mesh_.collapsed += corners < 3 ? 1 : 0;
  if (corners >= 2) {
    add_face(mesh_.parts, corners_);
  }
}

}  // namespace

ImportedMesh read_off(std::string_view text, const std::filesystem::path& path, const Progress& progress) {
  return OffReader(text, path, progress).read();
}

}  // namespace chainmail
