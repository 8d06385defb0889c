#include "equilibrium/local_minimum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace chainmail {
namespace {

constexpr std::size_t max_pairs = 4;
constexpr int max_tries = 12;
// The distance from the minimum at which iterations end, and above which there are three times as many.
constexpr double local_close = 0.01, local_far = 0.1;
// Long objects bend far with little energy: iterations go on while they move further than this, relative to the
// displacements.
constexpr double small_step = 0.005;
// The usual ratio of volumes below which a parabola continues the energy.
constexpr double usual_least = 0.5;
// A cube is joined if it would be divided at this many times its roughness.
constexpr double joins_below = 4;

double dot(const std::vector<Floats4>& a, const std::vector<Floats4>& b) {
  constexpr std::size_t block = 16;  // of float sums
  Doubles4 sum{};
  for (std::size_t first = 0; first < a.size(); first += block) {
    Floats4 some{};
    for (std::size_t i = first; i < std::min(a.size(), first + block); ++i) {
      some += a[i] * b[i];
    }
    sum += __builtin_convertvector(some, Doubles4);
  }
  return sum[0] + sum[1] + sum[2];
}

void add(std::vector<Floats4>& sum, float factor, const std::vector<Floats4>& other) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] += factor * other[i];
  }
}

}  // namespace

void LocalMinimum::set_lame(const Lame& lame) {
  lame_ = lame;
  extended_ = ExtendedDensity({}, lame, 3);
  pairs_.clear();
  is_outdated_ = true;
}

void LocalMinimum::set_gone(const std::vector<std::uint8_t>* is_gone, const std::vector<Box>* boxes,
                            std::span<const ElementId> changed) {
  is_gone_ = is_gone;
  boxes_ = boxes;
  levels_.forget_rows(changed);
  pairs_.clear();
  is_outdated_ = true;
}

void LocalMinimum::follow_fixed() {
  pairs_.clear();
  has_frame_ = false;
  is_outdated_ = true;
}

double LocalMinimum::distance() const { return energy_ > 0 ? std::sqrt(slope_ / (2 * energy_)) * shrunk_ : 0; }

double LocalMinimum::least_ratio() const {
  Doubles4 least = Doubles4{} + 1;  // also of empty lanes
  for (const Doubles4& ratio : ratios_) {
    least = ratio < least ? ratio : least;
  }
  return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

// Which cubes are divided.

bool LocalMinimum::is_too_wide(int l, std::uint32_t cube) const {
  const CubeSpace::Level& level = levels_.space().level(l);
  if (level.width > resolution_.widest || !levels_.space().is_thick(l, cube)) {
    return true;
  }
  const CubeSpace::Place& at = level.cubes[cube].at;
  const auto distance = [&](const Point& low, const Point& high) {
    double result = 0;
    for (int k = 0; k < 3; ++k) {
      const double begin = level.width * at[std::size_t(k)];
      result = std::max({result, begin - high[k], low[k] - begin - level.width});
    }
    return result;
  };
  return std::ranges::any_of(fixed_.rim(),
                             [&](const auto& p) { return level.width > resolution_.theta * distance(p, p); }) ||
         (boxes_ != nullptr && std::ranges::any_of(*boxes_, [&](const Box& box) {
            return level.width > 2 * resolution_.theta * distance(box[0], box[1]);
          }));
}

void LocalMinimum::divide_forced(int l, std::uint32_t cube) {
  if (!levels_.is_divided(l, cube)) {
    if (!is_too_wide(l, cube)) {
      return;
    }
    levels_.set_divided(l, cube, true);
  }
  const auto& cubes = levels_.space().level(l).cubes;
  for (std::uint32_t child = cubes[cube].child; l > 1 && child < cubes[cube + 1].child; ++child) {
    divide_forced(l - 1, child);
  }
}

/// Divides a cube and those that contain it.
void LocalMinimum::divide(int l, std::uint32_t cube) {
  for (; l <= levels_.top() && !levels_.is_divided(l, cube); cube = levels_.space().level(l++).cubes[cube].parent) {
    levels_.set_divided(l, cube, true);
  }
}

/// Neighbours differ by one level at most; around fine elements, all cubes of level 1 are in use.
void LocalMinimum::balance() {
  const CubeSpace& space = levels_.space();
  for (int l = 1; l < space.top(); ++l) {
    const CubeSpace::Level& level = space.level(l);
    const int reach = l == 1 ? space.reach() : 1;
    for (std::uint32_t c = 0; c < level.cube_count(); ++c) {
      if (!levels_.is_divided(l, c)) {
        continue;
      }
      const CubeSpace::Place& at = level.cubes[c].at;
      for (int z = -reach; z <= reach; ++z) {
        for (int y = -reach; y <= reach; ++y) {
          for (int x = -reach; x <= reach; ++x) {
            if (const auto other = level.find({at[0] + x, at[1] + y, at[2] + z}); other != CubeSpace::none) {
              divide(l + 1, level.cubes[other].parent);
            }
          }
        }
      }
    }
  }
}

double LocalMinimum::roughness_of(int l, std::uint32_t cube) const {
  const CubeSpace::Level& level = levels_.space().level(l);
  float most = 0;
  for (std::uint32_t p = level.cubes[cube].part; p < level.cubes[cube + 1].part; ++p) {
    for (const std::uint32_t node : level.parts[p].corner) {
      most = std::max(most, rough_[std::size_t(l)][levels_.find(l, node)]);
    }
  }
  return double(most);
}

bool LocalMinimum::has_divided_child(int l, std::uint32_t cube) const {
  const auto& cubes = levels_.space().level(l).cubes;
  for (std::uint32_t child = cubes[cube].child; l > 1 && child < cubes[cube + 1].child; ++child) {
    if (levels_.is_divided(l - 1, child)) {
      return true;
    }
  }
  return false;
}

/// Finds what interpolation misses beside each node of a level.
void LocalMinimum::find_roughness(int l) {
  const LocalLevels::Level& level = levels_.level(l);
  const auto& values = values_[std::size_t(l)];
  auto& rough = rough_[std::size_t(l)];
  rough.resize(level.size());
  for (std::uint32_t i = 0; i < level.size(); ++i) {
    double most = 0;
    for (std::size_t k = 0; k < 6; k += 2) {
      const std::uint32_t a = level.next[i][k], b = level.next[i][k + 1];
      if (a != i && b != i) {
        const Doubles4 second = values[a] - 2 * values[i] + values[b];
        most = std::max(most, square_of(second));
      }
    }
    rough[i] = float(std::sqrt(most) / 8);  // what interpolation misses in the middle
  }
}

/// Divides cubes in which interpolation misses much of the displacement, by its second differences, and joins others.
/// Returns true if any changed. A few changes wait for others.
bool LocalMinimum::adapt_to_strain(double size) {
  struct Change {
    int level;
    std::uint32_t cube;
    bool divided;
  };
  std::vector<Change> changes;
  std::size_t leaves = 0;
  const double limit = resolution_.tolerance * size;
  rough_.resize(values_.size());
  for (int l = 1; l <= levels_.top(); ++l) {
    find_roughness(l);
    for (const std::uint32_t c : levels_.cubes(l)) {
      const double error = roughness_of(l, c);
      const bool divided = levels_.is_divided(l, c);
      leaves += divided ? 0 : 1;
      if (divided ? joins_below * error < limit && !has_divided_child(l, c) && !is_too_wide(l, c) : error > limit) {
        changes.push_back({l, c, !divided});
      }
    }
  }
  if (changes.empty() || (changes.size() < leaves / 50 && ++since_change_ < 10)) {
    return false;
  }
  since_change_ = 0;
  for (const auto& [l, c, divided] : changes) {
    divided ? divide(l, c) : levels_.set_divided(l, c, false);
  }
  balance();
  return true;
}

/// Lists what is in use, and carries over what is known to it.
void LocalMinimum::list() {
  levels_.list(*is_gone_, 2 * lame_.mu + lame_.lambda);
  carry(values_, at_);
  carry(values_before_, before_);
  pairs_.clear();
  force_.resize(at_.size());
  ratios_.assign(levels_.batches().size(), Doubles4{} + 1);
  least_.assign(ratios_.size(), Doubles4{} + usual_least);
  tried_.resize(ratios_.size());
  gradient_is_outdated_ = true;
}

/// Carries the values of nodes that were in use before the last change over to the points.
void LocalMinimum::carry(const Values& old, WideVectors& points) const {
  interpolate(
      [&](int l, std::uint32_t i) {
        const std::uint32_t was = old.empty() ? CubeSpace::none : levels_.find_before(l, levels_.level(l).node[i]);
        return was != CubeSpace::none ? &old[std::size_t(l)][was] : nullptr;
      },
      points);
}

/// Sets the points to known(level, node), if it is not null, and interpolates the others and those that hang.
template <class Known>
void LocalMinimum::interpolate(Known known, WideVectors& points) const {
  points.assign(levels_.point_count(), Doubles4{});
  std::vector<Doubles4> coarser, values;
  for (int l = levels_.top(); l >= 0; --l) {
    const LocalLevels::Level& level = levels_.level(l);
    const std::size_t ups = l == 0 ? 4 : 2;
    values.assign(level.size(), Doubles4{});
    for (std::uint32_t i = 0; i < level.size(); ++i) {
      if (const Doubles4* own = level.hangs[i] == 0 ? known(l, i) : nullptr; own != nullptr) {
        values[i] = *own;
      } else if (l < levels_.top()) {
        for (std::size_t k = 0; k < ups; ++k) {
          values[i] += double(level.share[i][k]) * coarser[level.up[i][k]];
        }
      }
      if (level.point[i] != CubeSpace::none) {
        points[level.point[i]] = values[i];
      }
    }
    std::swap(coarser, values);
  }
}

/// Returns the displacement of each node of a level: means of what is near, or NaN where nothing is.
std::vector<Doubles4> LocalMinimum::means_at(int l, const Read& read) const {
  const CubeSpace& space = levels_.space();
  std::vector<Doubles4> sums(levels_.level(l).size(), Doubles4{});  // the last number of each is the weight
  for (std::uint32_t i = 0; l == 0 && i < sums.size(); ++i) {
    if (const ElementId e = levels_.level(0).node[i]; !fixed_.is_held(e)) {
      read(e, sums[i]);
      sums[i][3] = 1;
    }
  }
  const std::uint32_t stride = 1U << std::min(30, 3 * std::max(0, l - 2));  // about 64 elements of each cube are enough
  for (const std::uint32_t c : l > 0 ? levels_.cubes(l) : std::vector<std::uint32_t>()) {
    const CubeSpace::Level& level = space.level(l);
    for (std::uint32_t i = level.cubes[c].element; i < level.cubes[c + 1].element; i += stride) {
      const ElementId e = space.sorted_elements()[i];
      if (fixed_.is_held(e)) {
        continue;  // it moves later
      }
      const auto& corner = level.parts[space.ancestor(space.home(e), l)].corner;
      const auto at = space.interpolate(space.point(e), l, level.cubes[c]);
      Doubles4 displacement;
      read(e, displacement);
      displacement[3] = 1;
      for (std::size_t k = 0; k < 4; ++k) {
        sums[levels_.find(l, corner[at.corner[k]])] += std::max(0.0, at.weight[k]) * displacement;
      }
    }
  }
  for (Doubles4& sum : sums) {
    const double weight = sum[3];
    sum[3] = 0;
    sum = weight > 0 ? sum / weight : Doubles4{} + std::numeric_limits<double>::quiet_NaN();
  }
  return sums;
}

/// Takes displacements of elements over.
void LocalMinimum::start_from(const Read& read) {
  Values means;
  for (int l = 0; l <= levels_.top(); ++l) {
    means.push_back(means_at(l, read));
  }
  interpolate(
      [&](int l, std::uint32_t i) {
        const Doubles4& own = means[std::size_t(l)][i];
        return own[0] == own[0] ? &own : nullptr;
      },
      at_);
  before_ = at_;
  has_frame_ = false;
  pairs_.clear();
}

// The motion.

int LocalMinimum::move(double size, int max_iterations, const Read& start) {
  if (is_outdated_) {
    levels_.spread(at_, values_);
    levels_.spread(before_, values_before_);
    for (std::uint32_t c = 0; c < levels_.space().level(levels_.top()).cube_count(); ++c) {
      divide_forced(levels_.top(), c);
    }
    balance();
    list();
    is_outdated_ = false;
  }
  if (start) {
    start_from(start);
  }
  predict();
  levels_.spread(at_, values_);
  if (adapt_to_strain(size)) {
    levels_.spread(before_, values_before_);
    list();
    for (const auto& [element, point] : levels_.fixed_points()) {
      at_[point] = fixed_.displacement(element);
    }
  }
  gradient_is_outdated_ = true;
  int count = 0;
  while (count < max_iterations || (max_iterations > 0 && distance() > local_far && count < 3 * max_iterations)) {
    ++count;
    if (!step() || (distance() < local_close && stepped_ < small_step)) {
      break;
    }
  }
  return count;
}

/// Moves all points as in the last frame, as far as the handle goes on, and extends the rest of its motion.
void LocalMinimum::predict() {
  Doubles4 sum{};
  for (const ElementId e : fixed_.held()) {
    sum += fixed_.displacement(e);
  }
  const Doubles4 mean = fixed_.held().empty() ? mean_ : sum / double(fixed_.held().size());
  const Doubles4 jump = mean - mean_, last = mean_ - mean_before_;
  double fraction = 0;
  if (const double square = square_of(last); has_frame_ && square > 0 && distance() < local_far) {
    fraction = std::clamp((jump[0] * last[0] + jump[1] * last[1] + jump[2] * last[2]) / square, 0.0, 2.0);
  }
  for (std::size_t i = 0; i < at_.size(); ++i) {
    const Doubles4 here = at_[i];
    at_[i] += fraction * (here - before_[i]);
    before_[i] = here;
  }
  mean_before_ = mean_;
  mean_ = mean;
  has_frame_ = true;
  extend();
}

void LocalMinimum::find_stretch(const LocalLevels::Spring& spring, Doubles4& apart) const {
  apart = fixed_.displacement(spring.element);
  for (std::size_t k = 0; k < 4; ++k) {
    apart -= double(spring.weight[k]) * at_[spring.point[k]];
  }
}

/// Adds the forces on the points beside the fixed ones that have jumped by start_.
void LocalMinimum::add_jump() {
  const double modulus = 2 * lame_.mu + lame_.lambda;
  for (const std::uint32_t index : levels_.batches_beside_handle()) {
    const LocalLevels::Batch& batch = levels_.batches()[index];
    for (std::size_t lane = 0; lane < 4; ++lane) {
      Doubles4 jumped[3]{};  // the gradient of the jump
      for (std::size_t k = 0; k < 3; ++k) {
        const Doubles4 apart = start_[batch.corner[k + 1][lane]] - start_[batch.corner[0][lane]];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          jumped[axis] += batch.gradient[k][axis].at[lane] * apart;
        }
      }
      for (std::size_t k = 0; k < 3; ++k) {
        Doubles4 pull{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          pull += modulus * batch.volume.at[lane] * batch.gradient[k][axis].at[lane] * jumped[axis];
        }
        residual_[batch.corner[k + 1][lane]] -= __builtin_convertvector(pull, Floats4);
        residual_[batch.corner[0][lane]] += __builtin_convertvector(pull, Floats4);
      }
    }
  }
}

/// Moves the fixed points to where they are, and all others by Laplace's extension of that.
void LocalMinimum::extend() {
  start_.assign(at_.size(), Doubles4{});
  double most = 0;
  for (const auto& [element, point] : levels_.fixed_points()) {
    start_[point] = fixed_.displacement(element) - at_[point];
    at_[point] = fixed_.displacement(element);
    most = std::max(most, square_of(start_[point]));
  }
  residual_.assign(at_.size(), Floats4{});
  add_jump();
  for (const auto& spring : levels_.springs()) {
    if (!fixed_.is_held(spring.element)) {
      continue;
    }
    Doubles4 apart;
    find_stretch(spring, apart);
    most = std::max(most, square_of(apart));
    for (std::size_t k = 0; k < 4; ++k) {
      const Doubles4 pull = (2 * lame_.mu + lame_.lambda) * double(spring.weight[k]) * apart;
      residual_[spring.point[k]] += __builtin_convertvector(pull, Floats4);
    }
  }
  if (most > 0) {
    levels_.cycle(residual_, direction_);
    for (std::size_t i = 0; i < at_.size(); ++i) {
      at_[i] += __builtin_convertvector(direction_[i], Doubles4);
    }
  }
}

// The minimum: L-BFGS, with a cycle as the first inverse.

double LocalMinimum::find_force() {
  std::ranges::fill(force_, Doubles4{});
  const BatchDensity density{true, lame_, &extended_, four_numbers(least_), four_numbers(tried_)};
  double energy = evaluate_batches<3>(levels_.batches(), density, four_numbers(at_), four_numbers(force_)).energy;
  const double modulus = 2 * lame_.mu + lame_.lambda;
  for (const auto& spring : levels_.springs()) {
    Doubles4 apart;
    find_stretch(spring, apart);
    energy += modulus / 2 * square_of(apart);
    for (std::size_t k = 0; k < 4; ++k) {
      force_[spring.point[k]] += modulus * double(spring.weight[k]) * apart;
    }
  }
  for (const auto& [element, point] : levels_.fixed_points()) {
    force_[point] = Doubles4{};
  }
  return energy;
}

/// Continues the energy of each tetrahedron below half of its volume, or of its present ratio if that is small;
/// inverted ones turn back more easily.
void LocalMinimum::harden() {
  constexpr double small = 0.6, inverted = 0.02;
  bool any = false;
  for (std::size_t i = 0; i < tried_.size(); ++i) {
    Doubles4& least = least_[i];
    const auto needs_look = tried_[i] < small || least < usual_least;
    if ((needs_look[0] | needs_look[1] | needs_look[2] | needs_look[3]) == 0) {
      continue;
    }
    for (int l = 0; l < 4; ++l) {
      const double ratio = tried_[i][l],
                   wanted = ratio < inverted || ratio >= small ? usual_least : std::max(0.01, ratio / 2);
      any = any || wanted != least[l];
      least[l] = wanted;
    }
  }
  if (any) {
    energy_ = find_force();
  }
}

/// True if no tetrahedron lost more than nine tenths of its volume, or is more inverted than before.
bool LocalMinimum::is_allowed() const {
  for (std::size_t i = 0; i < tried_.size(); ++i) {
    const Doubles4 &was = ratios_[i], least = was > 0 ? 0.1 * was : 2 * was - 0.1;
    const auto is_less = tried_[i] < least;
    if ((is_less[0] | is_less[1] | is_less[2] | is_less[3]) != 0) {
      return false;
    }
  }
  return true;
}

bool LocalMinimum::step() {
  if (gradient_is_outdated_) {
    energy_ = find_force();
    harden();
    ratios_ = tried_;
    gradient_is_outdated_ = false;
  }
  return try_step() || try_step();
}

/// Finds the direction of the next step, and how steep the energy is along it.
void LocalMinimum::find_direction() {
  residual_.resize(at_.size());
  for (std::size_t i = 0; i < at_.size(); ++i) {
    residual_[i] = __builtin_convertvector(force_[i], Floats4);
  }
  std::array<double, max_pairs> part{};
  for (std::size_t p = pairs_.size(); p-- > 0;) {
    part[p] = dot(pairs_[p].step, residual_) / pairs_[p].product;
    add(residual_, -float(part[p]), pairs_[p].change);
  }
  levels_.cycle(residual_, direction_);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    add(direction_, float(part[p] - dot(pairs_[p].change, direction_) / pairs_[p].product), pairs_[p].step);
  }
  slope_ = 0;
  for (std::size_t i = 0; i < at_.size(); ++i) {
    const Doubles4 product = __builtin_convertvector(direction_[i], Doubles4) * force_[i];
    slope_ += product[0] + product[1] + product[2];
  }
}

/// Learns about the curvature from the last step.
void LocalMinimum::learn(double length) {
  Pair pair;
  if (pairs_.size() == max_pairs) {
    pair = std::move(pairs_.front());
    pairs_.pop_front();
  }
  pair.step.resize(at_.size());
  pair.change.resize(at_.size());
  double was = 0, is = 0, all = 0;
  for (std::size_t k = 0; k < at_.size(); ++k) {
    const Doubles4 change = old_force_[k] - force_[k];
    pair.step[k] = float(length) * direction_[k];
    pair.change[k] = __builtin_convertvector(change, Floats4);
    was += square_of(old_force_[k]);
    is += square_of(force_[k]);
    all += square_of(at_[k]);
  }
  pair.product = dot(pair.step, pair.change);
  stepped_ = all > 0 ? std::sqrt(dot(pair.step, pair.step) / all) : 0;
  shrunk_ = was > 0 ? std::min(1.0, std::sqrt(is / was)) : 0;
  if (pair.product > 0) {
    pairs_.push_back(std::move(pair));
  }
}

/// Forgets what was learned if no step lowers the energy.
bool LocalMinimum::try_step() {
  find_direction();
  if (!(slope_ > 0)) {
    pairs_.clear();
    slope_ = 0;
    return false;
  }
  start_ = at_;
  old_force_ = force_;
  double length = 1;
  for (int i = 0; i < max_tries; ++i, length /= 2) {
    for (std::size_t k = 0; k < at_.size(); ++k) {
      at_[k] = start_[k] + length * __builtin_convertvector(direction_[k], Doubles4);
    }
    const double energy = find_force();
    if (energy <= energy_ - 1e-4 * length * slope_ + 1e-13 * energy_ && is_allowed()) {
      energy_ = energy;
      std::swap(ratios_, tried_);
      learn(length);
      return true;
    }
  }
  at_ = start_;
  force_ = old_force_;
  pairs_.clear();
  return false;
}

}  // namespace chainmail
