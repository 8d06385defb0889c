#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "files/formats/ply.h"
#include "files/formats/ply_head.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// As programs write what is infinite or undefined, which properties beside the positions may be.
bool is_no_number(std::string_view word) {
  word.remove_prefix(word.starts_with('-') ? 1 : 0);
  return word == "nan" || word == "inf" || word == "NaN" || word == "Inf";
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::filesystem::path& path, const Progress& progress)
      : bytes_(bytes), path_(path), progress_(progress), head_(read_ply_head(bytes, path)), at_(head_.length) {}

  ImportedMesh read() {
    const auto count = double(head_.elements.size());
    for (std::size_t i = 0; i < head_.elements.size(); ++i) {
      read_elements(head_.elements[i], progress_.part(double(i) / count, double(i + 1) / count));
    }
    add_pieces();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

  double number(const NumberType& type);
  double binary_number(const NumberType& type);
  /// The numbers of one property of an element.
  void read_property(const PlyProperty& property);
  void read_elements(const PlyElement& element, const Progress& progress);
  void take_vertex(const PlyElement& element);
  void take_face(const PlyElement& element);
  void take_edge(const PlyElement& element);
  /// Numbers of the property of such a name of the element read last; empty where it has none.
  std::span<const double> numbers_of(const PlyElement& element, std::string_view name) const;
  double number_of(const PlyElement& element, std::string_view name) const;
  ElementId id(double number) const;
  void add_pieces();

  std::string_view bytes_;
  const std::filesystem::path& path_;
  const Progress& progress_;
  PlyHead head_;
  std::size_t at_;
  std::vector<double> numbers_;     // of the element read last, of all its properties
  std::vector<std::size_t> first_;  // where those of each property begin, and the end
  std::vector<double> corners_;     // of all faces: count, corner…
  std::vector<std::array<double, 2>> edges_;
  ImportedMesh mesh_;
};

void PlyReader::fail(const std::string& problem, const std::string& remedy) const {
  const std::string_view read = bytes_.substr(head_.length, at_ - head_.length);
  const auto line = head_.lines + 1 + static_cast<std::size_t>(std::count(read.begin(), read.end(), '\n'));
  throw Error(head_.form == PlyForm::text ? shown(path_, line) : shown(path_), problem, remedy);
}

double PlyReader::binary_number(const NumberType& type) {
  if (bytes_.size() - at_ < type.bytes) {
    fail("it ends before the elements that its head states", "export it anew");
  }
  const double number = type.read(bytes_.data() + at_, head_.form == PlyForm::big_endian);
  at_ += type.bytes;
  return number;
}

double PlyReader::number(const NumberType& type) {
  if (head_.form != PlyForm::text) {
    return binary_number(type);
  }
  const std::size_t begin = std::min(bytes_.find_first_not_of(blanks, at_), bytes_.size());
  const std::size_t end = std::min(bytes_.find_first_of(blanks, begin), bytes_.size());
  const auto number = parse_number(bytes_.substr(begin, end - begin));
  if (begin == end) {
    fail("it ends before the elements that its head states", "export it anew");
  }
  at_ = begin;
  if (!number && !is_no_number(bytes_.substr(begin, end - begin))) {
    fail(in_quotes(bytes_.substr(begin, end - begin)) + " is not a number", "export it anew");
  }
  at_ = end;
  return number.value_or(std::numeric_limits<double>::quiet_NaN());
}

void PlyReader::read_property(const PlyProperty& property) {
  double count = 1;
  if (property.count != nullptr) {
    count = number(*property.count);
    if (!(count >= 0 && count <= double(bytes_.size())) || count != std::floor(count)) {
      fail("a list has no whole number of entries, or more than the file holds", "export it anew");
    }
  }
  for (auto i = static_cast<std::size_t>(count); i > 0; --i) {
    numbers_.push_back(number(*property.type));
  }
}

void PlyReader::read_elements(const PlyElement& element, const Progress& progress) {
  if (element.name == "tristrips" && element.count > 0) {
    fail("it holds strips of triangles", "save it with faces");
  }
  const auto take = element.name == "vertex" ? &PlyReader::take_vertex
                    : element.name == "face" ? &PlyReader::take_face
                    : element.name == "edge" ? &PlyReader::take_edge
                                             : nullptr;
  if (element.properties.empty()) {
    return;
  }
  for (std::uint64_t i = 0; i < element.count; ++i) {
    progress.report(i, element.count);
    numbers_.clear();
    first_.clear();
    for (const PlyProperty& property : element.properties) {
      first_.push_back(numbers_.size());
      read_property(property);
    }
    first_.push_back(numbers_.size());
    if (take != nullptr) {
      (this->*take)(element);
    }
  }
}

std::span<const double> PlyReader::numbers_of(const PlyElement& element, std::string_view name) const {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name) {
      return std::span(numbers_).subspan(first_[i], first_[i + 1] - first_[i]);
    }
  }
  return {};
}

double PlyReader::number_of(const PlyElement& element, std::string_view name) const {
  const auto numbers = numbers_of(element, name);
  if (numbers.size() != 1) {
    fail("an element " + in_quotes(element.name) + " has no number " + in_quotes(name), "export it anew");
  }
  return numbers.front();
}

void PlyReader::take_vertex(const PlyElement& element) {
  const Point point(number_of(element, "x"), number_of(element, "y"), number_of(element, "z"));
  if (!(point.cwiseAbs().maxCoeff() <= coordinate_limit) || !point.allFinite()) {
    fail("vertex " + std::to_string(mesh_.parts.rest.size()) + " has a coordinate that is no number, or beyond 1e100",
         "give finite coordinates");
  }
  if (mesh_.parts.rest.size() == element_limit) {
    fail("there are more than " + std::to_string(element_limit) + " vertices", "use a smaller mesh");
  }
  mesh_.parts.rest.push_back(point);
}

void PlyReader::take_face(const PlyElement& element) {
  auto corners = numbers_of(element, "vertex_indices");
  if (corners.empty()) {
    corners = numbers_of(element, "vertex_index");
  }
  if (corners.size() < 2) {
    fail("a face has fewer than 2 corners", "export it anew");
  }
  corners_.push_back(double(corners.size()));
  corners_.insert(corners_.end(), corners.begin(), corners.end());
}

void PlyReader::take_edge(const PlyElement& element) {
  edges_.push_back({number_of(element, "vertex1"), number_of(element, "vertex2")});
}

ElementId PlyReader::id(double number) const {
  if (!(number >= 0 && number < double(mesh_.parts.rest.size())) || number != std::floor(number)) {
    std::string text;
    append_number(text, number);
    throw Error(shown(path_), "a face or edge names the vertex " + text + ", which is not there", "export it anew");
  }
  return static_cast<ElementId>(number);
}

/// Only now, because vertices may stand behind them.
void PlyReader::add_pieces() {
  std::vector<ElementId> face;
  for (std::size_t i = 0; i < corners_.size(); i += face.size() + 1) {
    face.clear();
    for (std::size_t k = 1; k <= static_cast<std::size_t>(corners_[i]); ++k) {
      face.push_back(id(corners_[i + k]));
    }
    add_face(mesh_.parts, face);
  }
  for (const auto& [a, b] : edges_) {
    mesh_.parts.links.push_back({id(a), id(b)});
  }
}

}  // namespace

ImportedMesh read_ply(std::string_view bytes, const std::filesystem::path& path, const Progress& progress) {
  return PlyReader(bytes, path, progress).read();
}

}  // namespace chainmail
