#include "files/import/program/counts.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string_view>

namespace chainmail::import {
namespace {

/// Longer lines contain numbers or binary data, and are skipped.
constexpr std::size_t longest_line = 80;

/// Medit's keywords for the items that Gmsh reads. A count follows each.
constexpr std::array<std::string_view, 6> medit_elements{"Edges",      "Triangles", "Quadrilaterals",
                                                         "Tetrahedra", "Hexahedra", "Prisms"};
std::uint64_t first_number(const std::string& line, int nth) {
  std::istringstream words(line);
  std::uint64_t number = 0;
  for (int i = 0; i < nth; ++i) {
    words >> number;
  }
  return words ? number : 0;
}

/// Adds up the counts. take() receives each line that may begin with a keyword, and the line after it.
class Counter {
 public:
  explicit Counter(const std::string& name) : name_(name) {}

  void take(const std::string& line, const std::string& next) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (name_ == "mesh") {
      std::uint64_t number = 0;
      add(word == "Vertices", std::find(medit_elements.begin(), medit_elements.end(), word) != medit_elements.end(),
          words >> number ? number : first_number(next, 1));
    } else {
      format_4_ = format_4_ || (word == "$MeshFormat" && next.starts_with('4'));
      add(word == "$Nodes", word == "$Elements", first_number(next, format_4_ ? 2 : 1));
    }
  }

  const FileCounts& counts() const { return counts_; }

 private:
  void add(bool points, bool elements, std::uint64_t number) {
    if (points) {
      counts_.points = number;
    } else if (elements) {
      counts_.elements += number;
    }
  }

  const std::string& name_;
  FileCounts counts_;
  bool format_4_ = false;
};

}  // namespace

FileCounts count_in(const std::string& name, const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Counter counter(name);
  std::string line, next;
  std::getline(file, line);
  while (file) {
    std::getline(file, next);
    if (line.size() <= longest_line && !line.empty()) {
      counter.take(line, next);
    }
    line.swap(next);
  }
  return counter.counts();
}

}  // namespace chainmail::import
