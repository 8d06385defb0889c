#include "files/formats/vtu.h"

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "files/formats/mesh_pieces.h"
#include "files/text/base64.h"
#include "files/text/text.h"
#include "measure/violation.h"

namespace chainmail {
namespace {

constexpr std::array piece_kinds{Piece::line, Piece::triangle, Piece::polygon, Piece::tetrahedron, Piece::hexahedron};

std::uint8_t vtk_type(Piece piece, std::size_t corners) {
  switch (piece) {
    case Piece::line:
      return 3;
    case Piece::triangle:
      return 5;
    case Piece::polygon:
    case Piece::side:
      return corners == 4 ? 9 : 7;
    case Piece::tetrahedron:
      return 10;
    case Piece::hexahedron:
      return 12;
  }
  return 0;
}

/// Returns the largest violation of the uncut links of each element.
std::vector<double> element_violations(const MeshState& state, const Progress& progress) {
  const auto& [mesh, cuts, positions, softness] = state;
  std::vector<double> largest(mesh.element_count(), 0);
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    progress.report(link, mesh.link_count());
    if (!cuts.is_cut(link)) {
      const double violation = link_violation(mesh, softness, positions, link);
      for (const ElementId end : mesh.links[link]) {
        largest[end] = std::max(largest[end], violation);
      }
    }
  }
  return largest;
}

class VtuWriter {
 public:
  VtuWriter(std::ostream& out, const MeshState& state, const Progress& progress)
      : text_(out), state_(state), pieces_(state.mesh, state.cuts, {}, progress) {}

  void write_head();
  void write_points(const Progress& progress);
  void write_cells(const Progress& progress);
  void write_fields(const Progress& progress);
  void write_foot();

 private:
  /// Writes an array of `count` numbers. `fill` adds them to the writer that it receives.
  template <class Number, class Fill>
  void write_array(std::string_view type, std::string_view name, int components, std::uint64_t count, Fill fill);
  template <class Vector>
  void write_vectors(std::string_view name, Vector vector, const Progress& progress);
  template <class Visit>
  void for_each_cell(Visit visit, const Progress& progress) const;
  std::uint64_t cell_count() const;

  TextBlocks text_;
  const MeshState& state_;
  MeshPieces pieces_;
};

template <class Number, class Fill>
void VtuWriter::write_array(std::string_view type, std::string_view name, int components, std::uint64_t count,
                            Fill fill) {
  text_ << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
        << static_cast<std::uint32_t>(components) << "\" format=\"binary\">\n";
  Base64Writer numbers(text_);
  numbers.add(std::uint64_t{count * sizeof(Number)});
  fill(numbers);
  numbers.finish();
  text_ << "\n</DataArray>\n";
}

template <class Vector>
void VtuWriter::write_vectors(std::string_view name, Vector vector, const Progress& progress) {
  const ElementId elements = state_.mesh.element_count();
  write_array<double>("Float64", name, 3, 3 * std::uint64_t{elements}, [&](Base64Writer& numbers) {
    for (ElementId element = 0; element < elements; ++element) {
      progress.report(element, elements);
      for (const double coordinate : Point(vector(element))) {
        numbers.add(coordinate);
      }
    }
  });
}

template <class Visit>
void VtuWriter::for_each_cell(Visit visit, const Progress& progress) const {
  for (std::size_t k = 0; k < piece_kinds.size(); ++k) {
    pieces_.for_each(
        piece_kinds[k], [&](MeshPieces::Corners corners) { visit(piece_kinds[k], corners); },
        progress.part(double(k) / piece_kinds.size(), double(k + 1) / piece_kinds.size()));
  }
}

std::uint64_t VtuWriter::cell_count() const {
  std::uint64_t count = 0;
  for (const Piece piece : piece_kinds) {
    count += pieces_.count(piece);
  }
  return count;
}

void VtuWriter::write_head() {
  const bool little = std::endian::native == std::endian::little;
  text_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\""
        << (little ? "LittleEndian" : "BigEndian") << "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
        << "<Piece NumberOfPoints=\"" << state_.mesh.element_count() << "\" NumberOfCells=\""
        << std::to_string(cell_count()) << "\">\n";
}

void VtuWriter::write_points(const Progress& progress) {
  text_ << "<Points>\n";
  write_vectors(
      "Points", [&](ElementId element) { return point_of(state_.mesh, state_.positions, element); }, progress);
  text_ << "</Points>\n";
}

void VtuWriter::write_cells(const Progress& progress) {
  std::uint64_t corners_of_all = 0;
  for (const Piece piece : piece_kinds) {
    corners_of_all += pieces_.corner_count(piece);
  }
  text_ << "<Cells>\n";
  write_array<std::int32_t>("Int32", "connectivity", 1, corners_of_all, [&](Base64Writer& numbers) {
    const auto add = [&](Piece, MeshPieces::Corners corners) {
      for (const ElementId corner : corners) {
        numbers.add(static_cast<std::int32_t>(corner));
      }
    };
    for_each_cell(add, progress.part(0, 0.6));
  });
  write_array<std::int64_t>("Int64", "offsets", 1, cell_count(), [&](Base64Writer& numbers) {
    std::int64_t end = 0;
    const auto add = [&](Piece, MeshPieces::Corners corners) { numbers.add(end += std::int64_t(corners.size())); };
    for_each_cell(add, progress.part(0.6, 0.9));
  });
  write_array<std::uint8_t>("UInt8", "types", 1, cell_count(), [&](Base64Writer& numbers) {
    const auto add = [&](Piece piece, MeshPieces::Corners corners) { numbers.add(vtk_type(piece, corners.size())); };
    for_each_cell(add, progress.part(0.9, 1));
  });
  text_ << "</Cells>\n";
}

void VtuWriter::write_fields(const Progress& progress) {
  text_ << "<PointData Vectors=\"displacement\" Scalars=\"violation\">\n";
  const auto displacement = [&](ElementId element) -> Point {
    return point_of(state_.mesh, state_.positions, element) - state_.mesh.rest_position(element);
  };
  write_vectors("displacement", displacement, progress.part(0, 0.4));
  const std::vector<double> violations = element_violations(state_, progress.part(0.4, 1));
  write_array<double>("Float64", "violation", 1, violations.size(), [&](Base64Writer& numbers) {
    for (const double violation : violations) {
      numbers.add(violation);
    }
  });
  text_ << "</PointData>\n";
}

void VtuWriter::write_foot() {
  text_ << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  text_.flush();
}

}  // namespace

void write_vtu(std::ostream& out, const MeshState& state, const Progress& progress) {
  VtuWriter writer(out, state, progress.part(0, 0.3));
  writer.write_head();
  writer.write_points(progress.part(0.3, 0.5));
  writer.write_cells(progress.part(0.5, 0.8));
  writer.write_fields(progress.part(0.8, 1));
  writer.write_foot();
}

}  // namespace chainmail
