#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "files/obj.h"
#include "files/space.h"
#include "files/text.h"

namespace chainmail {
namespace {

class ObjWriter {
 public:
  ObjWriter(std::ostream& out, const Mesh& mesh, const Cuts& cuts)
      : out_(out), mesh_(mesh), cuts_(cuts), drawn_(mesh.link_count(), false) {}

  void write_vertices(const PositionView& positions);
  void write_faces();
  void write_lines();

 private:
  void write_face(std::span<const ElementId> corners);
  void write_statement(char kind, std::span<const ElementId> corners);

  std::ostream& out_;
  const Mesh& mesh_;
  const Cuts& cuts_;
  std::vector<bool> drawn_;  // links that are an edge of a face already written
  std::string row_;
  std::vector<LinkId> edges_;
};

void ObjWriter::write_vertices(const PositionView& positions) {
  for (ElementId element = 0; element < mesh_.element_count(); ++element) {
    const Point point = point_of(mesh_, positions, element);
    row_ = "v";
    for (const double coordinate : point) {
      row_ += ' ';
      append_number(row_, coordinate);
    }
    out_ << (row_ += '\n');
  }
}

void ObjWriter::write_statement(char kind, std::span<const ElementId> corners) {
  row_ = kind;
  for (const ElementId corner : corners) {
    row_ += ' ';
    append_number(row_, std::uint64_t{corner} + 1);
  }
  out_ << (row_ += '\n');
}

/// A face would bring its links back when it is read: with one of them cut it is no face any more.
void ObjWriter::write_face(std::span<const ElementId> corners) {
  edges_.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto link = find_link(mesh_, corners[i], corners[(i + 1) % corners.size()]);
    if (!link || cuts_.is_cut(*link)) {
      return;
    }
    edges_.push_back(*link);
  }
  for (const LinkId link : edges_) {
    drawn_[link] = true;
  }
  write_statement('f', corners);
}

void ObjWriter::write_faces() {
  for (std::size_t i = 0; i < mesh_.own_triangles; ++i) {
    write_face(mesh_.triangles[i]);
  }
  for (std::size_t i = 0; i < mesh_.polygons.size(); i += mesh_.polygons[i] + 1) {
    write_face(std::span(mesh_.polygons).subspan(i + 1, mesh_.polygons[i]));
  }
}

void ObjWriter::write_lines() {
  for (LinkId link = 0; link < mesh_.link_count(); ++link) {
    if (!drawn_[link] && !cuts_.is_cut(link)) {
      write_statement('l', mesh_.links[link]);
    }
  }
}

}  // namespace

void write_obj(std::ostream& out, const Mesh& mesh, const Cuts& cuts, const PositionView& positions) {
  out << space_comment(mesh, positions);
  ObjWriter writer(out, mesh, cuts);
  writer.write_vertices(positions);
  writer.write_faces();
  writer.write_lines();
}

}  // namespace chainmail
