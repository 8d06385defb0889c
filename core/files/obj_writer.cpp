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

  void write_vertices(const PositionView& positions, const Progress& progress);
  void write_faces(const Progress& progress);
  void write_lines(const Progress& progress);

 private:
  void write_face(std::span<const ElementId> corners);
  void write_statement(char kind, std::span<const ElementId> corners);

  TextBlocks out_;
  const Mesh& mesh_;
  const Cuts& cuts_;
  std::vector<bool> drawn_;  // links that are an edge of a face already written
  std::vector<LinkId> edges_;
};

void ObjWriter::write_vertices(const PositionView& positions, const Progress& progress) {
  for (ElementId element = 0; element < mesh_.element_count(); ++element) {
    progress.report(element, mesh_.element_count());
    const Point point = point_of(mesh_, positions, element);
    out_ << 'v';
    for (const double coordinate : point) {
      out_ << ' ' << coordinate;
    }
    out_ << '\n';
  }
}

void ObjWriter::write_statement(char kind, std::span<const ElementId> corners) {
  out_ << kind;
  for (const ElementId corner : corners) {
    out_ << ' ' << corner + 1;
  }
  out_ << '\n';
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

void ObjWriter::write_faces(const Progress& progress) {
  for (std::size_t i = 0; i < mesh_.own_triangles; ++i) {
    progress.report(i, mesh_.own_triangles);
    write_face(mesh_.triangles[i]);
  }
  for (std::size_t i = 0; i < mesh_.polygons.size(); i += mesh_.polygons[i] + 1) {
    progress.report(1);
    write_face(std::span(mesh_.polygons).subspan(i + 1, mesh_.polygons[i]));
  }
}

void ObjWriter::write_lines(const Progress& progress) {
  for (LinkId link = 0; link < mesh_.link_count(); ++link) {
    progress.report(link, mesh_.link_count());
    if (!drawn_[link] && !cuts_.is_cut(link)) {
      write_statement('l', mesh_.links[link]);
    }
  }
  out_.flush();
}

}  // namespace

void write_obj(std::ostream& out, const Mesh& mesh, const Cuts& cuts, const PositionView& positions,
               const Progress& progress) {
  out << space_comment(mesh, positions);
  ObjWriter writer(out, mesh, cuts);
  writer.write_vertices(positions, progress.part(0, 0.4));
  writer.write_faces(progress.part(0.4, 0.6));
  writer.write_lines(progress.part(0.6, 1));
}

}  // namespace chainmail
