#include "mesh/link_shares.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <span>

#include "mesh/cells.h"
#include "mesh/mesh.h"

namespace chainmail {
namespace {

/// Sums up, per link, the measure of the cells at it.
class ShareSum {
 public:
  explicit ShareSum(const Mesh& mesh) : mesh_(mesh), sums_(mesh.link_count()) {}

  std::vector<float> run() {
    if (mesh_.has_cells()) {
      add_cells();
    } else if (!mesh_.triangles.empty()) {
      add_faces();
    } else if (mesh_.is_grid) {
      add_lattice(mesh_.lattice->size);
    }
    return divided_by_mean();
  }

 private:
  Point at(ElementId element) const { return mesh_.rest_position(element); }

  void add(ElementId a, ElementId b, double measure) {
    if (const auto link = find_link(mesh_, a, b)) {
      sums_[*link] += measure;
    }
  }

  double volume(ElementId a, ElementId b, ElementId c, ElementId d) const {
    return std::abs((at(b) - at(a)).cross(at(c) - at(a)).dot(at(d) - at(a))) / 6;
  }

  double volume_of(const std::array<ElementId, 4>& cell) const { return volume(cell[0], cell[1], cell[2], cell[3]); }

  /// Six tetrahedra around the diagonal from the first corner to the opposite one.
  double volume_of(const std::array<ElementId, 8>& cell) const {
    constexpr std::array<int, 7> around{1, 2, 3, 7, 4, 5, 1};
    double sum = 0;
    for (std::size_t i = 0; i + 1 < around.size(); ++i) {
      sum += volume(cell[0], cell[std::size_t(around[i])], cell[std::size_t(around[i + 1])], cell[6]);
    }
    return sum;
  }

  void add_cells() {
    const auto add_cell = [this](const auto& cell) {
      const double measure = volume_of(cell);
      for (const auto& [a, b] : edges_of(cell)) {
        add(cell[std::size_t(a)], cell[std::size_t(b)], measure);
      }
    };
    std::ranges::for_each(mesh_.tetrahedra, add_cell);
    std::ranges::for_each(mesh_.hexahedra, add_cell);
  }

  void add_face(std::span<const ElementId> corners) {
    Point normal = Point::Zero();
    for (std::size_t i = 2; i < corners.size(); ++i) {
      normal += (at(corners[i - 1]) - at(corners[0])).cross(at(corners[i]) - at(corners[0]));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      add(corners[i], corners[(i + 1) % corners.size()], normal.norm() / 2);
    }
  }

  void add_faces() {
    for (std::size_t i = 0; i < mesh_.own_triangles; ++i) {
      add_face(mesh_.triangles[i]);
    }
    for (std::size_t i = 0; i < mesh_.polygons.size(); i += mesh_.polygons[i] + 1) {
      add_face({mesh_.polygons.data() + i + 1, mesh_.polygons[i]});
    }
  }

  /// The links along the axes of a lattice: each is an edge of as many squares or cubes as have it as an edge.
  void add_lattice(const std::array<std::uint32_t, 3>& size) {
    for (LinkId link = 0; link < mesh_.link_count(); ++link) {
      const auto [a, b] = mesh_.links[link];
      const std::array<std::uint32_t, 3> place{a % size[0], a / size[0] % size[1], a / (size[0] * size[1])};
      const ElementId step = b - a;
      const int along = step == 1 && size[0] > 1 ? 0 : step == size[0] && size[1] > 1 ? 1 : 2;
      sums_[link] = 1;
      for (int k = 0; k < 3; ++k) {
        if (k != along && size[std::size_t(k)] > 1) {
          const bool outside = place[std::size_t(k)] == 0 || place[std::size_t(k)] + 1 == size[std::size_t(k)];
          sums_[link] *= outside ? 1 : 2;
        }
      }
    }
  }

  std::vector<float> divided_by_mean() const {
    double sum = 0, count = 0;
    for (const double one : sums_) {
      sum += one;
      count += one > 0 ? 1 : 0;
    }
    if (!(sum > 0) || !std::isfinite(sum)) {
      return {};
    }
    std::vector<float> shares(sums_.size(), 1);
    for (std::size_t link = 0; link < shares.size(); ++link) {
      if (sums_[link] > 0) {
        // Within limits, so that no sliver leaves its links limp and no huge cell makes them rigid.
        shares[link] = static_cast<float>(std::clamp(sums_[link] * count / sum, 1e-3, 1e3));
      }
    }
    return shares;
  }

  const Mesh& mesh_;
  std::vector<double> sums_;
};

}  // namespace

const std::vector<float>& LinkShares::of(const Mesh& mesh) const {
  const std::lock_guard guard(cache_->mutex);
  if (!cache_->is_filled) {
    cache_->shares = ShareSum(mesh).run();
    cache_->is_filled = true;
  }
  return cache_->shares;
}

}  // namespace chainmail
