#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "equilibrium/cube_space.h"
#include "equilibrium/fixed_elements.h"

namespace chainmail {

/// The cubes of a space that are in use, with their nodes, and a multigrid on them.
///
/// A cube is divided or a leaf. Divided cubes of level 1 are divided into the elements in them, which are level 0. On
/// each level, a node is free if all parts around it are in use; otherwise it hangs between nodes of the next coarser
/// level, and so do elements of leaves. Nodes beside leaves, and elements, are points: they have displacements. Nodes
/// of the multigrid alone are not. The real unknowns are the points that do not hang.
class LocalLevels {
 public:
  static constexpr std::uint32_t none = CubeSpace::none;
  using Batch = SimplexBatch<3>;
  /// The gradients of the shape functions of corners 1 to 3 of a tetrahedron.
  using Shape = std::array<Point, 3>;

  struct Level {
    std::vector<std::uint32_t> node;   // its id in the space; on level 0, the element
    std::vector<std::uint32_t> point;  // or none
    std::vector<std::uint8_t> hangs;
    std::vector<std::array<std::uint32_t, 4>> up;  // of the next coarser level; the first two from level 1 on
    std::vector<std::array<float, 4>> share;
    // The Laplacian. From level 1 on, a node has at most one neighbour along −x, +x, −y …; all others are in `more`.
    std::vector<std::array<std::uint32_t, 6>> next;
    std::vector<std::array<float, 6>> weight;
    struct More {
      std::uint32_t one, other;
      float weight;
    };
    std::vector<More> more;
    std::vector<std::uint32_t> row, neighbour;  // of level 0
    std::vector<float> row_weight;
    std::vector<float> diagonal, inverse, keep;  // keep: 0 if it is fixed, else 1
    std::vector<std::uint32_t> around;           // parts in use around it
    std::vector<std::uint8_t> beside_leaf;
    std::vector<Floats4> r, x, t, y;
    std::size_t size() const { return node.size(); }
    void clear();
  };

  LocalLevels(const CubeSpace& space, const FixedElements& fixed);

  const CubeSpace& space() const { return space_; }
  const Level& level(int l) const { return levels_[std::size_t(l)]; }
  int top() const { return space_.top(); }
  std::size_t point_count() const { return point_count_; }
  std::size_t unknown_count() const { return unknown_count_; }
  /// The number of a node among those of its level that are in use, or none; and before the last change.
  std::uint32_t find(int l, std::uint32_t node) const { return in_use_[std::size_t(l)][node]; }
  std::uint32_t find_before(int l, std::uint32_t node) const { return before_[std::size_t(l)][node]; }

  bool is_divided(int l, std::uint32_t cube) const { return divided_[std::size_t(l)][cube] != 0; }
  void set_divided(int l, std::uint32_t cube, bool divided);
  /// The cubes in use, by level.
  const std::vector<std::uint32_t>& cubes(int l) const { return cubes_[std::size_t(l)]; }
  /// True if an element is an unknown of its own, unless it is fixed.
  bool is_fine(ElementId element) const { return is_fine_[element] != 0; }
  /// Returns the level and the part of the leaf with this element; level 0 if it is fine.
  struct Leaf {
    int level = 0;
    std::uint32_t part = none;
  };
  Leaf leaf_of(ElementId element) const;

  /// Lists what is in use after cubes were divided or joined. `is_gone`: of each tetrahedron.
  void list(const std::vector<std::uint8_t>& is_gone, double modulus);
  /// Forgets the Laplacian around these elements, after cuts.
  void forget_rows(std::span<const ElementId> elements);
  /// The tetrahedra of fine elements, and those of leaves, as a batch each.
  const std::vector<Batch>& batches() const { return batches_; }
  std::size_t tetrahedron_count() const { return tetrahedron_count_; }
  /// The batches with held elements or nodes at them.
  const std::vector<std::uint32_t>& batches_beside_handle() const { return beside_handle_; }
  /// A fixed element in a leaf: a spring of the modulus pulls the points to it.
  struct Spring {
    ElementId element;
    std::array<std::uint32_t, 4> point;
    std::array<float, 4> weight;
  };
  const std::vector<Spring>& springs() const { return springs_; }
  /// The fixed elements at points.
  struct FixedPoint {
    ElementId element;
    std::uint32_t point;
  };
  const std::vector<FixedPoint>& fixed_points() const { return fixed_points_; }

  /// Approximates the solution of Laplace's equation by one cycle.
  void cycle(const std::vector<Floats4>& q, std::vector<Floats4>& z);
  /// The displacements of all nodes of all levels: of nodes that are no points, from finer ones.
  void spread(const WideVectors& points, std::vector<std::vector<Doubles4>>& values) const;

 private:
  void list_level(int l, double modulus);
  std::uint32_t node_at(int l, const CubeSpace::Part& part, std::size_t corner);
  void add_part(int l, std::uint32_t part, double modulus);
  void add_edge(Level& level, std::uint32_t i, std::uint32_t j, std::size_t axis, float weight);
  void classify(int l, double modulus);
  void find_explicit(const std::vector<std::uint8_t>& is_gone);
  void list_elements();
  template <class Visit>
  void for_each_entry(double modulus, Visit visit) const;
  void find_rows(double modulus);
  void fill_rows();
  void scan(std::uint32_t cube, const std::vector<std::uint8_t>& is_gone);
  void number_points();
  void add_batches();
  void add_tetrahedron(const std::array<std::uint32_t, 4>& points, const Shape& gradient, double volume);
  void add_leaf(int l, std::uint32_t part);
  void find_springs();
  void find_fixed_points();
  void go_down(const std::vector<Floats4>& q);
  void solve_coarsest();
  void go_up(int l);
  static void multiply(const Level& level, int l, const std::vector<Floats4>& x, std::vector<Floats4>& result);
  static void smooth(Level& level, int l, std::vector<Floats4>& x);

  const CubeSpace& space_;
  const FixedElements& fixed_;
  std::vector<Level> levels_, old_;
  std::vector<std::vector<std::uint32_t>> in_use_, before_;
  std::vector<std::vector<std::uint8_t>> divided_;
  std::vector<std::vector<std::uint32_t>> cubes_;
  std::vector<std::uint8_t> is_fine_;
  std::vector<std::uint32_t> explicit_;  // tetrahedra with a fine element, or in a divided cube
  std::vector<Shape> gradients_;         // of these
  std::vector<double> volumes_;
  // What explicit tetrahedra leave of the parts of leaves of level 1.
  std::vector<std::uint32_t> left_of_;  // of each cube: the number of its first part below, or none
  std::vector<std::uint32_t> left_cubes_;
  std::vector<std::array<float, 6>> left_;
  std::vector<std::uint32_t> row_of_;  // of each element, in `rows_`
  std::vector<float> rows_;
  std::size_t point_count_ = 0, unknown_count_ = 0, tetrahedron_count_ = 0;
  std::vector<Batch> batches_;
  std::vector<std::uint32_t> beside_handle_;
  std::vector<std::uint8_t> is_held_point_;
  std::vector<Spring> springs_;
  std::vector<FixedPoint> fixed_points_;
};

inline void LocalLevels::spread(const WideVectors& points, std::vector<std::vector<Doubles4>>& values) const {
  values.resize(levels_.size());
  std::vector<float> total;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const Level& level = levels_[l];
    values[l].assign(level.size(), Doubles4{});
    if (l > 0) {
      const Level& fine = levels_[l - 1];
      const std::size_t ups = l == 1 ? 4 : 2;
      total.assign(level.size(), 0);
      for (std::size_t i = 0; i < fine.size(); ++i) {
        for (std::size_t k = 0; k < ups; ++k) {
          const std::uint32_t up = fine.up[i][k];
          const float share = fine.share[i][k];
          if (level.point[up] != none || !(share > 0)) {
            continue;
          }
          if (share > 0.999F) {  // the same place
            values[l][up] = values[l - 1][i];
            total[up] = -1;
          } else if (total[up] >= 0) {
            values[l][up] += share * values[l - 1][i];
            total[up] += share;
          }
        }
      }
      for (std::size_t i = 0; i < level.size(); ++i) {
        if (total[i] > 0) {
          values[l][i] /= total[i];
        }
      }
    }
    for (std::size_t i = 0; i < level.size(); ++i) {
      if (level.point[i] != none) {
        values[l][i] = points[level.point[i]];
      }
    }
  }
}

}  // namespace chainmail
