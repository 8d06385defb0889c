#include "files/import/program/counts.h"

#include <fstream>
#include <sstream>
#include <string>

namespace chainmail::import {
namespace {

/// Longer lines contain numbers or binary data, and are skipped.
constexpr std::size_t longest_line = 80;

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
  void take(const std::string& line, const std::string& next) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    format_4_ = format_4_ || (word == "$MeshFormat" && next.starts_with('4'));
    const std::uint64_t number = first_number(next, format_4_ ? 2 : 1);
    if (word == "$Nodes") {
      counts_.points = number;
    } else if (word == "$Elements") {
      counts_.elements += number;
    }
  }

  const FileCounts& counts() const { return counts_; }

 private:
  FileCounts counts_;
  bool format_4_ = false;
};

}  // namespace

FileCounts count_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Counter counter;
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
