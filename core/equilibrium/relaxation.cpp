#include "equilibrium/relaxation.h"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "body/body_view.h"
#include "equilibrium/corotated.h"
#include "equilibrium/small_quadratic.h"

namespace chainmail {
namespace {

/// Returns the energy of links that sweeps lower.
EnergyKind energy_of_sweeps(const Body& body) { return energy_of_links(body.softness().energy); }

}  // namespace

/// The visits of one slice.
template <class View>
class Relaxation::Slice {
 public:
  using Scalar = typename View::Scalar;
  static constexpr int Dimension = View::Dimension;

  Slice(Relaxation& relaxation, const View& body, EnergyKind energy, double step, std::span<const ElementId> held)
      : relaxation_(relaxation), step_(step), held_(held), body_(body), energy_(energy) {
    fill_shapes();
  }

  RelaxationResult run(std::uint64_t budget) {
    const bool by_link = relaxation_.scheme_ == RelaxationScheme::link;
    return energy_ == EnergyKind::isotropic
               ? run(budget, [&](ElementId element) { by_link ? visit_links(element) : visit(element); })
               : run(budget,
                     [&](ElementId element) { by_link ? visit_weighted_links(element) : visit_weighted(element); });
  }

 private:
  using Coordinates = std::array<Scalar, Dimension>;
  using RegionId = typename RegionTable<Scalar, Dimension>::Id;
  using Vector = FixedMatrix<double, Dimension>;

  static constexpr int lanes = Position<Scalar, Dimension>::lanes;
  /// The coordinates of a position, which the processor computes at once.
  typedef Scalar Lanes __attribute__((vector_size(lanes * sizeof(Scalar))));

  /// A link by the number of its rest vector: that vector, and the bounds of the valid region.
  struct Shape {
    Lanes rest, low, high;
  };
  // Larger tables would take longer to fill than some slices last.
  static constexpr std::size_t max_shapes = 64;

  /// The intersection of the valid regions about an element's neighbours.
  struct Box {
    Coordinates low, high;
  };

  template <class Visit>
  RelaxationResult run(std::uint64_t budget, Visit visit_one) {
    RelaxationResult result;
    for (; result.visited < budget; ++result.visited) {
      const auto element = relaxation_.current_.take();
      if (!element) {
        result.sweep_ended = true;
        break;
      }
      visit_one(*element);
    }
    result.largest_step = relaxation_.largest_step_;
    return result;
  }

  /// Returns a neighbour's position less the rest vector to it: the position that this link alone implies.
  Coordinates position_by(ElementId element, ElementId neighbour) const {
    Coordinates position;
    const double* rest = body_.mesh->rest.data();
    for (int k = 0; k < Dimension; ++k) {
      const double rest_vector =
          body_.from_rest ? 0
                          : rest[std::size_t{neighbour} * Dimension + k] - rest[std::size_t{element} * Dimension + k];
      position[k] = body_.positions[neighbour][k] - static_cast<Scalar>(rest_vector);
    }
    return position;
  }
  /// The same, with the rest vector from the table of distinct ones, if there is one.
  Coordinates position_by(ElementId element, ElementId neighbour, RegionId region) const {
    if (body_.from_rest || !body_.regions.by_shape()) {
      return position_by(element, neighbour);
    }
    Coordinates position;
    const double* rest_vector = body_.mesh->shapes.data() + std::size_t{region} * Dimension;
    for (int k = 0; k < Dimension; ++k) {
      position[k] = body_.positions[neighbour][k] - static_cast<Scalar>(rest_vector[k]);
    }
    return position;
  }

  bool stays(ElementId element) const {
    return body_.pinned(element) ||
           (held_.size() < 2 ? !held_.empty() && held_[0] == element : std::ranges::binary_search(held_, element));
  }

  void wake_next(ElementId element) { relaxation_.next_.insert(element); }

  /// Moves an element toward the mean of the positions that its links imply, inside the regions about its neighbours.
  void visit(ElementId element) {
    if (stays(element)) {
      return;
    }
    Coordinates mean{};
    Box box = everywhere();
    const int count = shape_count_ == 0 ? add_links(element, mean, box) : add_shapes(element, mean, box);
    if (count == 0) {
      return;
    }
    for (Scalar& x : mean) {
      x /= static_cast<Scalar>(count);
    }
    if (move_toward(element, mean, box, static_cast<Scalar>(step_), element) && step_ < 1) {
      wake_next(element);
    }
  }

  /// Adds the positions that an element's links imply, and limits a box to the regions about its neighbours. Returns
  /// the number of links.
  int add_links(ElementId element, Coordinates& sum, Box& box) const {
    int count = 0;
    body_.for_each_link(element, [&](ElementId neighbour, RegionId region) {
      const Coordinates position = position_by(element, neighbour, region);
      limit(box, neighbour, region);
      for (int k = 0; k < Dimension; ++k) {
        sum[k] += position[k];
      }
      ++count;
    });
    return count;
  }

  /// The same, bit for bit, with the table of shapes.
  int add_shapes(ElementId element, Coordinates& sum, Box& box) const {
    Lanes all{}, low = all - std::numeric_limits<Scalar>::infinity(), high = -low;
    int count = 0;
    body_.for_each_link(element, [&](ElementId neighbour, RegionId region) {
      Lanes at;
      std::memcpy(&at, body_.positions[neighbour].at, sizeof at);
      const Shape& shape = shapes_[region];
      const Lanes lowest = at - shape.high, highest = at - shape.low;
      all += at - shape.rest;
      low = low < lowest ? lowest : low;
      high = highest < high ? highest : high;
      ++count;
    });
    for (int k = 0; k < Dimension; ++k) {
      sum[k] = all[k];
      box.low[k] = low[k];
      box.high[k] = high[k];
    }
    return count;
  }

  void fill_shapes() {
    const std::size_t count = body_.mesh->shapes.size() / Dimension;
    const bool visits_elements = relaxation_.scheme_ == RelaxationScheme::mean && energy_ == EnergyKind::isotropic;
    if (Dimension != 3 || !visits_elements || !body_.regions.by_shape() || count > max_shapes) {
      return;
    }
    shape_count_ = count;
    std::fill_n(shapes_.begin(), count, Shape{});
    for (std::size_t i = 0; i < count; ++i) {
      for (int k = 0; k < Dimension; ++k) {
        const auto& region = body_.regions.at(RegionId(i));
        shapes_[i].rest[k] = body_.from_rest ? 0 : static_cast<Scalar>(body_.mesh->shapes[i * Dimension + k]);
        shapes_[i].low[k] = region.low[k];
        shapes_[i].high[k] = region.high[k];
      }
    }
  }

  /// Relaxes the links to neighbours of higher id: each link once per sweep, in the order of links.
  void visit_links(ElementId element) {
    body_.for_each_link(element, [&](ElementId neighbour, RegionId) {
      if (neighbour < element) {
        return;
      }
      const Coordinates here = position_by(element, neighbour), there = position_by(neighbour, element);
      const Scalar half = static_cast<Scalar>(step_) / 2;
      for (const auto& [one, position] : {std::pair(element, here), std::pair(neighbour, there)}) {
        if (!stays(one) && move_toward(one, position, box_of(one), half, element)) {
          wake_next(element);
        }
      }
    });
  }

  static Box everywhere() {
    Box box;
    box.low.fill(-std::numeric_limits<Scalar>::infinity());
    box.high.fill(std::numeric_limits<Scalar>::infinity());
    return box;
  }

  /// Limits a box to the region about a neighbour.
  void limit(Box& box, ElementId neighbour, RegionId id) const {
    const Scalar* about = body_.positions[neighbour].at;
    const auto& region = body_.regions.at(id);
    for (int k = 0; k < Dimension; ++k) {
      box.low[k] = std::max(box.low[k], about[k] - region.high[k]);
      box.high[k] = std::min(box.high[k], about[k] - region.low[k]);
    }
  }

  Box box_of(ElementId element) const {
    Box box = everywhere();
    body_.for_each_link(element, [&](ElementId neighbour, RegionId region) { limit(box, neighbour, region); });
    return box;
  }

  /// A link as seen from one of its ends: its weights, its direction, and how far its vector is from its rest vector,
  /// along this direction and in all. Corotated energy turns the rest vector.
  struct Deflection {
    LinkWeights weights;
    Vector direction = {};
    double along = 0;
    Vector all = {};
  };

  Vector rest_vector(ElementId element, ElementId neighbour) const {
    return CorotatedEnergy<Dimension>::rest_vector(*body_.mesh, element, neighbour);
  }

  /// Returns the deflection of a link from its rest vector, without rotation.
  [[gnu::always_inline]] Deflection deflection(ElementId element, ElementId neighbour, EntryId entry) const {
    const Vector rest = rest_vector(element, neighbour);
    Deflection link{relaxation_.weights_[body_.mesh->entry_link[entry]]};
    for (int k = 0; k < Dimension; ++k) {
      const double apart = double(body_.positions[neighbour][k]) - double(body_.positions[element][k]);
      link.all[k] = body_.from_rest ? apart : apart - rest[k];
    }
    if (link.weights.axial > 0) {
      link.direction = rest / rest.norm();
      link.along = link.direction.dot(link.all);
    }
    return link;
  }

  using Square = FixedMatrix<double, Dimension, Dimension>;

  /// Returns the rotation of an element's neighbourhood: the one found last since the object was woken, or a new one.
  [[gnu::always_inline]] Square rotation_of(ElementId element) const {
    if (relaxation_.turned_[element] != relaxation_.wakes_) {
      find_rotation(element);
    }
    return present_rotation(element);
  }

  /// The rotations are stored in three dimensions.
  [[gnu::always_inline]] Square present_rotation(ElementId element) const {
    if constexpr (Dimension == 3) {
      return relaxation_.rotations_[element];
    }
    Square rotation;
    for (int row = 0; row < Dimension; ++row) {
      for (int column = 0; column < Dimension; ++column) {
        rotation(row, column) = relaxation_.rotations_[element](row, column);
      }
    }
    return rotation;
  }

  void find_rotation(ElementId element) const {
    Square sum;
    body_.for_each_neighbour(element, [&](ElementId neighbour, EntryId entry) {
      const Deflection link = deflection(element, neighbour, entry);
      const Vector rest = rest_vector(element, neighbour);
      sum += outer_product(link.weights.lateral * (rest + link.all), rest);
    });
    if constexpr (Dimension == 3) {
      turn_toward(sum, relaxation_.rotations_[element]);
    } else {
      Square rotation = present_rotation(element);
      turn_toward(sum, rotation);
      for (int row = 0; row < Dimension; ++row) {
        for (int column = 0; column < Dimension; ++column) {
          relaxation_.rotations_[element](row, column) = rotation(row, column);
        }
      }
    }
    relaxation_.turned_[element] = relaxation_.wakes_;
  }

  /// Turns the rest vector of a link with the mean of the rotations of its ends, and its direction with the link.
  void turn(Deflection& link, ElementId element, ElementId neighbour) const {
    const Vector rest = rest_vector(element, neighbour), vector = rest + link.all;
    const Square mean = (rotation_of(element) + rotation_of(neighbour)) / 2;
    const double size = vector.norm();
    link.direction = size > 0 && link.weights.axial > 0 ? vector / size : Vector();
    link.along = size - rest.norm();
    link.all = vector - mean * rest;
  }

  /// Calls use(neighbour, deflection) for each uncut link of an element.
  template <class Use>
  void for_each_deflection(ElementId element, Use use) const {
    const bool turns = energy_ == EnergyKind::corotated;
    if (turns) {
      find_rotation(element);
    }
    body_.for_each_neighbour(element, [&](ElementId neighbour, EntryId entry) {
      Deflection link = deflection(element, neighbour, entry);
      if (turns) {
        turn(link, element, neighbour);
      }
      use(neighbour, link);
    });
  }

  Coordinates moved_by(ElementId element, const Vector& displacement) const {
    Coordinates position;
    for (int k = 0; k < Dimension; ++k) {
      position[k] = static_cast<Scalar>(double(body_.positions[element][k]) + displacement[k]);
    }
    return position;
  }

  /// Moves an element toward the position of least energy inside the regions about its neighbours.
  void visit_weighted(ElementId element) {
    if (stays(element)) {
      return;
    }
    SmallQuadratic<Dimension> energy;  // of the displacement of the element
    for_each_deflection(element, [&](ElementId, const Deflection& link) {
      energy.add(link.weights.axial, link.direction, link.along, link.weights.lateral, link.all);
    });
    const Box box = box_of(element);
    Vector low, high;
    for (int k = 0; k < Dimension; ++k) {
      low[k] = double(box.low[k]) - double(body_.positions[element][k]);
      high[k] = double(box.high[k]) - double(body_.positions[element][k]);
    }
    const Coordinates position = moved_by(element, energy.least_inside(low, high));
    if (move_toward(element, position, box, static_cast<Scalar>(step_), element) && step_ < 1) {
      wake_next(element);
    }
  }

  /// Corrects the links to neighbours of higher id: each link once per sweep, in the order of links.
  void visit_weighted_links(ElementId element) {
    for_each_deflection(element, [&](ElementId neighbour, const Deflection& link) {
      if (neighbour < element) {
        return;
      }
      const auto [axial, lateral] = link.weights;
      const double share = lateral > 0 ? lateral / (axial + lateral) : 0;
      const Vector displacement = (1 - share) * link.along * link.direction + share * link.all;
      const Coordinates here = moved_by(element, displacement), there = moved_by(neighbour, -displacement);
      const Scalar half = static_cast<Scalar>(step_) / 2;
      for (const auto& [one, position] : {std::pair(element, here), std::pair(neighbour, there)}) {
        if (!stays(one) && move_toward(one, position, box_of(one), half, element)) {
          wake_next(element);
        }
      }
    });
  }

  /// Moves an element a step toward a position, as far as its neighbours' regions allow, and wakes its neighbours.
  /// Returns true if it moved. Elements with a larger id than the visited one are visited in this sweep, the others in
  /// the next.
  bool move_toward(ElementId element, const Coordinates& position, const Box& box, Scalar step, ElementId visited) {
    const double taken = take_step(element, position, box, step);
    if (taken == 0) {
      return false;
    }
    relaxation_.largest_step_ = std::max(relaxation_.largest_step_, taken);
    relaxation_.moved_.push_back(element);
    std::uint64_t* const current = relaxation_.current_.words();
    std::uint64_t* const next = relaxation_.next_.words();
    ElementId least = element, most = element;
    body_.for_each_link(element, [&](ElementId neighbour, RegionId) {
      ActiveSet::insert_in(neighbour > visited ? current : next, neighbour);
      least = std::min(least, neighbour);
      most = std::max(most, neighbour);
    });
    // The bounds may be wider than what was inserted.
    relaxation_.next_.note_inserted(least, std::min(most, visited));
    relaxation_.current_.note_inserted(std::max(least, visited), most);
    if (element > visited) {
      relaxation_.current_.insert(element);
    }
    return true;
  }

  /// Returns the length of the step (mesh units), 0 if the element stayed.
  double take_step(ElementId element, const Coordinates& position, const Box& box, Scalar step) {
    const auto& [low, high] = box;
    Scalar* x = body_.positions[element].at;
    Coordinates next;
    double square = 0;
    for (int k = 0; k < Dimension; ++k) {
      next[k] = x[k] + step * (position[k] - x[k]);
      next[k] = low[k] > high[k] ? x[k] : std::min(std::max(next[k], low[k]), high[k]);
      const double difference = double(next[k]) - double(x[k]);
      square += difference * difference;
    }
    const double threshold = still * body_.mesh->mean_link_length;
    if (!(square > threshold * threshold)) {
      return 0;
    }
    std::copy(next.begin(), next.end(), x);
    return std::sqrt(square);
  }

  std::array<Shape, max_shapes> shapes_;
  std::size_t shape_count_ = 0;  // 0: the table is not used
  Relaxation& relaxation_;
  double step_;
  std::span<const ElementId> held_;
  const View body_;
  EnergyKind energy_;
};

void Relaxation::follow(const Body& body) {
  if (positions_ != body.revisions().positions) {
    positions_ = body.revisions().positions;
    forget();  // the search starts from the rotations: after a reset, the same moves have the same last digits
  }
}

/// Weighs the links again if their energy has changed.
void Relaxation::follow_energy(const Body& body) {
  if (energy_ != body.revisions().energy && energy_of_sweeps(body) != EnergyKind::isotropic) {
    energy_ = body.revisions().energy;
    weights_.resize(body.mesh().link_count());
    for (LinkId link = 0; link < body.mesh().link_count(); ++link) {
      weights_[link] = link_weights(*body.stored_mesh(), body.softness(), link);
    }
  }
  if (energy_of_sweeps(body) == EnergyKind::corotated && rotations_.empty()) {
    rotations_.assign(body.mesh().element_count(), FixedMatrix<double, 3, 3>::Identity());
    turned_.assign(body.mesh().element_count(), 0);
  }
}

void Relaxation::wake(const Body& body, std::span<const ElementId> elements) {
  follow(body);
  ++wakes_;
  next_.make_room(body.mesh().element_count());
  for (const ElementId element : elements) {
    next_.insert(element);
    for_each_neighbour(body.mesh(), body.cuts(), element,
                       [&](ElementId neighbour, EntryId) { next_.insert(neighbour); });
  }
}

void Relaxation::wake_all(const Body& body) {
  follow(body);
  ++wakes_;
  next_.insert_all(body.mesh().element_count());
}

void Relaxation::sleep() {
  current_.clear();
  next_.clear();
  end_sweep();
}

void Relaxation::forget() {
  sleep();
  rotations_.clear();
}

RelaxationResult Relaxation::sweep(Body& body, double step, std::uint64_t budget, std::span<const ElementId> held) {
  follow(body);
  if (!in_sweep_) {
    std::swap(current_, next_);
    in_sweep_ = true;
  }
  current_.make_room(body.mesh().element_count());
  next_.make_room(body.mesh().element_count());
  moved_.clear();
  follow_energy(body);
  const RelaxationResult result = body.with_view([&]<class View>(const View& view) {
    return Slice<View>(*this, view, energy_of_sweeps(body), step, held).run(budget);
  });
  if (result.largest_step > 0) {
    body.note_relaxation();
  }
  if (result.sweep_ended) {
    end_sweep();
  }
  return result;
}

void Relaxation::end_sweep() {
  in_sweep_ = false;
  largest_step_ = 0;
}

}  // namespace chainmail
