#include "files/formats/msh_check.h"

#include <string>
#include <unordered_set>

#include "files/formats/msh_types.h"
#include "files/text/text.h"
#include "files/text/words.h"

namespace chainmail {
namespace {

/// Passes through the nodes and elements of a file, as Gmsh does.
class MshCheck {
 public:
  MshCheck(std::string_view text, const std::filesystem::path& path) : words_(text, path, nobody_) {}

  void run() {
    for (auto word = words_.next(); !word.empty(); word = words_.next()) {
      if (word == "$MeshFormat" && !read_format()) {
        return;
      }
      if (word == "$Nodes") {
        is_version_4_ ? read_blocks("node", &MshCheck::read_node_block)
                      : read_rows(words_.count(rows), "node", &MshCheck::read_node);
      } else if (word == "$Elements") {
        is_version_4_ ? read_blocks("element", &MshCheck::read_element_block)
                      : read_rows(words_.count(rows), "element", &MshCheck::read_element);
      }
    }
  }

 private:
  static constexpr const char* rows = "the number of rows";

  /// Returns false if the rest is not known here.
  bool read_format() {
    const std::string_view version = words_.next();
    is_version_4_ = version == "4.1";
    return (is_version_4_ || version == "2" || version.starts_with("2.")) && words_.next() == "0";
  }

  /// Looks at rows, and at the end of their section.
  void read_rows(std::uint32_t count, const char* what, void (MshCheck::*read)()) {
    for (std::uint32_t i = 0; i < count; ++i) {
      expect_more(i, count, what);
      (this->*read)();
    }
    end(what);
  }

  void read_blocks(const char* what, void (MshCheck::*read)()) {
    const std::uint32_t blocks = words_.count("the number of blocks");
    for (const char* head : {rows, "the lowest tag", "the highest tag"}) {
      words_.count(head);
    }
    for (std::uint32_t i = 0; i < blocks; ++i) {
      expect_more(i, blocks, "block");
      words_.count("a dimension");
      words_.count("the tag of an entity");
      (this->*read)();
    }
    end(what);
  }

  void expect_more(std::uint32_t done, std::uint32_t stated, const std::string& what) {
    if (const auto word = words_.peek(); word.empty() || word.starts_with('$')) {
      words_.next();
      words_.fail(std::to_string(stated) + " " + what + "s are stated, but there are " + std::to_string(done),
                  "export it again");
    }
  }

  void end(const std::string& what) {
    if (const auto word = words_.next(); !word.starts_with("$End")) {
      words_.fail("there are more " + what + "s than stated", "export it again");
    }
  }

  void read_point() {
    for (int axis = 0; axis < 3; ++axis) {
      words_.coordinate();
    }
  }

  void read_node() {
    tags_.insert(words_.count("the tag of a node"));
    read_point();
  }

  /// All tags stand before all points.
  void read_node_block() {
    const bool is_parametric = words_.next() != "0";
    const std::uint32_t count = words_.count(rows);
    for (std::uint32_t i = 0; i < count; ++i) {
      expect_more(i, count, "node");
      tags_.insert(words_.count("the tag of a node"));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      expect_more(i, count, "point");
      read_point();
      if (is_parametric) {
        words_.skip_line();
      }
    }
  }

  void read_element() {
    words_.count("the tag of an element");
    const std::uint32_t type = words_.count("the type of an element");
    for (std::uint32_t left = words_.count("the number of tags"); left > 0 && !words_.ends_line(); --left) {
      words_.next();
    }
    read_corners(type);
  }

  void read_corners(std::uint32_t type) {
    const MshType* const known = msh_type(int(type));
    if (known == nullptr) {
      words_.fail("Gmsh's type " + std::to_string(type) + " is of higher order, or unknown",
                  "save it with elements of first or second order");
    }
    for (std::size_t i = 0; i < known->corners; ++i) {
      if (words_.ends_line()) {
        words_.fail("an element of Gmsh's type " + std::to_string(type) + " has " + std::to_string(i) +
                        " corners, but needs " + std::to_string(known->corners),
                    "export it again");
      }
      if (const std::uint32_t tag = words_.count("the tag of a node"); !tags_.contains(tag)) {
        words_.fail("there is no node " + std::to_string(tag), "export it again");
      }
    }
  }

  void read_element_block() {
    const std::uint32_t type = words_.count("the type of an element");
    const std::uint32_t count = words_.count(rows);
    for (std::uint32_t i = 0; i < count; ++i) {
      expect_more(i, count, "element");
      words_.count("the tag of an element");
      read_corners(type);
    }
  }

  Progress nobody_;
  Words words_;
  std::unordered_set<std::uint32_t> tags_;
  bool is_version_4_ = false;
};

}  // namespace

void check_msh(std::string_view text, const std::filesystem::path& path) { MshCheck(text, path).run(); }

}  // namespace chainmail
