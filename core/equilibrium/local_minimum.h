#pragma once

#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "elastic/material.h"
#include "equilibrium/local_levels.h"

namespace chainmail {

/// How fine the cubes of a local minimum are.
struct LocalResolution {
  double theta = 0.5;       // a cube at the distance d from the handle's rim is at most θ d wide; 2 θ d beside cuts
  double widest = 1e9;      // width of cubes (units)
  double tolerance = 0.01;  // estimated error of interpolation where a cube is divided, per motion of the handle
};

/// The minimum of the neo-Hookean energy over the displacements that the cubes in use interpolate, for a handle that
/// moves. The energy of a leaf is that of its tetrahedra, each with the volume that the object fills; between fine
/// elements it is that of the cells. All lengths are in units of the space.
class LocalMinimum {
 public:
  LocalMinimum(const CubeSpace& space, const FixedElements& fixed, const LocalResolution& resolution)
      : levels_(space, fixed), fixed_(fixed), resolution_(resolution) {}

  void set_lame(const Lame& lame);
  /// `is_gone`: of each tetrahedron. `boxes`: of the cells that are gone, as two corners each. `changed`: the corners
  /// of tetrahedra for which it is not what it was.
  using Box = std::array<Point, 2>;
  void set_gone(const std::vector<std::uint8_t>* is_gone, const std::vector<Box>* boxes,
                std::span<const ElementId> changed);
  /// Call this after other elements were fixed.
  void follow_fixed();

  /// Follows the fixed elements: extrapolates the last two frames, divides and joins cubes, and iterates until the
  /// distance from the minimum is small. `size`: the length of the motion of the handle so far. `start`, if given,
  /// writes the displacement of an element from which it starts. Returns the number of iterations.
  using Read = std::function<void(ElementId, Doubles4&)>;
  int move(double size, int max_iterations, const Read& start);
  const LocalLevels& levels() const { return levels_; }
  const Doubles4& displacement(std::uint32_t point) const { return at_[point]; }
  /// Returns those of all nodes of all levels in use, by level.
  using Values = std::vector<std::vector<Doubles4>>;
  Values displacements() const {
    Values values;
    levels_.spread(at_, values);
    return values;
  }
  /// Estimated distance from the minimum, as √(energy of the distance / energy).
  double distance() const;
  /// The least ratio of volumes; below 0 if a tetrahedron is inverted.
  double least_ratio() const;

 private:
  using Floats = std::vector<Floats4>;
  struct Pair {
    Floats step, change;
    double product = 0;
  };

  bool is_too_wide(int l, std::uint32_t cube) const;
  void divide_forced(int l, std::uint32_t cube);
  void find_roughness(int l);
  bool adapt_to_strain(double size);
  double roughness_of(int l, std::uint32_t cube) const;
  bool has_divided_child(int l, std::uint32_t cube) const;
  void divide(int l, std::uint32_t cube);
  void balance();
  void list();
  void carry(const Values& old, WideVectors& points) const;
  template <class Known>
  void interpolate(Known known, WideVectors& points) const;
  std::vector<Doubles4> means_at(int l, const Read& read) const;
  void start_from(const Read& read);
  void predict();
  void add_jump();
  void extend();
  void find_stretch(const LocalLevels::Spring& spring, Doubles4& apart) const;
  double find_force();
  void harden();
  bool is_allowed() const;
  bool step();
  void find_direction();
  void learn(double length);
  bool try_step();

  LocalLevels levels_;
  const FixedElements& fixed_;
  LocalResolution resolution_;
  Lame lame_;
  ExtendedDensity extended_{{}, {}, 3};
  const std::vector<std::uint8_t>* is_gone_ = nullptr;
  const std::vector<Box>* boxes_ = nullptr;
  bool is_outdated_ = true;  // what must be fine
  int since_change_ = 0;     // frames
  WideVectors at_, before_, force_, start_, old_force_;
  Floats residual_, direction_;
  Values values_, values_before_;
  std::vector<std::vector<float>> rough_;
  WideVectors ratios_, tried_;  // of the volumes of each batch
  WideVectors least_;           // below which a parabola continues the energy
  std::deque<Pair> pairs_;
  Doubles4 mean_{}, mean_before_{};  // displacement of the handle
  bool has_frame_ = false, gradient_is_outdated_ = true;
  double energy_ = 0, slope_ = 0, shrunk_ = 1;
  double stepped_ = 0;  // the last step, relative to the displacements
};

}  // namespace chainmail
