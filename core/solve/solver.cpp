#include "solve/solver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/error.h"
#include "solve/propagate.h"
#include "solve/relaxation.h"

namespace chainmail {
namespace {

constexpr std::array infos{
    AlgorithmInfo{Algorithm::generalized, "generalized", "Generalized ChainMail",
                  "Li and Brodlie 2003; Dean 2004, 3.1"},
    AlgorithmInfo{Algorithm::spiral, "spiral", "Spiral", "Dean 2004, 3.2"},
    AlgorithmInfo{Algorithm::natural_queue, "natural-queue", "Natural Queue ChainMail", "Dean 2004, 4.1"},
};

template <class Scalar, int Dimension>
class TypedSolver final : public Solver {
 public:
  TypedSolver(const MeshPointer& mesh, Algorithm algorithm) : body_(mesh), algorithm_(algorithm) {}

  void set_algorithm(Algorithm algorithm) override { algorithm_ = algorithm; }
  void set_softness(const Softness& softness) override { body_.set_softness(softness); }

  void cut(std::span<const LinkId> links) override {
    for (const LinkId link : links) {
      body_.cuts.cut(link);
    }
  }

  void uncut(std::span<const LinkId> links) override {
    for (const LinkId link : links) {
      body_.cuts.uncut(link);
    }
  }

  void reset() override {
    body_.reset_positions();
    relaxation_.sleep();
  }

  PassCount move(ElementId element, const Point& target, Trace* trace) override {
    Scalar next[Dimension];
    for (int k = 0; k < Dimension; ++k) {
      next[k] = static_cast<Scalar>(target[body_.mesh->axes[k]]);
      if (!std::isfinite(next[k])) {
        throw Error("element " + std::to_string(element), "its target is not a finite number",
                    "give coordinates that fit the precision");
      }
    }
    std::copy(std::begin(next), std::end(next), body_.elements[element].position);
    PassCount count;
    if (trace != nullptr) {
      count.checked = propagate_with_list(element, [trace](ElementId e, ElementId sponsor, bool moved) {
        trace->push_back({e, sponsor, moved});
      });
    } else {
      count.checked = propagate_with_list(element, [](ElementId, ElementId, bool) {});
    }
    count.moved = moved_.size();
    return count;
  }

  std::span<const ElementId> moved() const override { return moved_; }

  void wake(std::span<const ElementId> elements) override {
    for (const ElementId element : elements) {
      relaxation_.wake(body_, element);
    }
  }

  RelaxationResult relax(double step, std::uint64_t budget, std::optional<ElementId> held) override {
    return relaxation_.sweep(body_, step, budget, held);
  }

  void sleep() override { relaxation_.sleep(); }

  const Cuts& cuts() const override { return body_.cuts; }
  PositionView positions() const override {
    return {body_.elements.data(), sizeof body_.elements[0],
            sizeof(Scalar) == sizeof(float) ? Precision::single_precision : Precision::double_precision};
  }
  void copy_positions(std::span<float> out) const override { copy(out); }
  void copy_positions(std::span<double> out) const override { copy(out); }

  void set_positions(std::span<const double> in) override {
    for (std::size_t i = 0; i < in.size(); ++i) {
      body_.elements[i / Dimension].position[i % Dimension] = static_cast<Scalar>(in[i]);
    }
    relaxation_.sleep();
  }

 private:
  template <class Observe>
  std::uint64_t propagate_with_list(ElementId grabbed, Observe observe) {
    switch (algorithm_) {
      case Algorithm::generalized:
        return propagate(body_, front_, grabbed, moved_, observe);
      case Algorithm::spiral:
        return propagate(body_, spiral_, grabbed, moved_, observe);
      case Algorithm::natural_queue:
        return propagate(body_, natural_queue_, grabbed, moved_, observe);
    }
    return 0;
  }

  template <class Out>
  void copy(std::span<Out> out) const {
    for (std::size_t e = 0; e < body_.elements.size(); ++e) {
      for (int k = 0; k < Dimension; ++k) {
        out[e * Dimension + k] = static_cast<Out>(body_.elements[e].position[k]);
      }
    }
  }

  Body<Scalar, Dimension> body_;
  Algorithm algorithm_;
  FrontList front_;
  SpiralList spiral_;
  NaturalQueueList natural_queue_;
  std::vector<ElementId> moved_;
  MeanRelaxation<Scalar, Dimension> relaxation_;
};

template <class Scalar>
std::unique_ptr<Solver> make_typed(const MeshPointer& mesh, Algorithm algorithm) {
  switch (mesh->space_dimension) {
    case 1:
      return std::make_unique<TypedSolver<Scalar, 1>>(mesh, algorithm);
    case 2:
      return std::make_unique<TypedSolver<Scalar, 2>>(mesh, algorithm);
    default:
      return std::make_unique<TypedSolver<Scalar, 3>>(mesh, algorithm);
  }
}

}  // namespace

std::span<const AlgorithmInfo> algorithms() { return infos; }

const AlgorithmInfo& info(Algorithm algorithm) {
  return *std::find_if(infos.begin(), infos.end(), [&](auto& entry) { return entry.algorithm == algorithm; });
}

std::optional<Algorithm> find_algorithm(std::string_view name) {
  const auto found = std::find_if(infos.begin(), infos.end(), [&](auto& entry) { return entry.name == name; });
  return found == infos.end() ? std::nullopt : std::optional(found->algorithm);
}

Point point_of(const Mesh& mesh, const PositionView& positions, ElementId element) {
  std::array<double, 3> carried{};
  for (int k = 0; k < mesh.space_dimension; ++k) {
    carried[k] = positions(element, k);
  }
  return mesh.to_point(carried.data());
}

std::unique_ptr<Solver> make_solver(const MeshPointer& mesh, Algorithm algorithm, Precision precision) {
  return precision == Precision::single_precision ? make_typed<float>(mesh, algorithm)
                                                  : make_typed<double>(mesh, algorithm);
}

}  // namespace chainmail
