#pragma once

#include <memory>
#include <string>
#include <vector>

#include "body/method.h"
#include "elastic/elastic.h"

namespace chainmail {

/// Deforms a body with a method of elasticity. Keeps its preparation until links, pins or the material change.
class ElasticDeformation final : public Method {
 public:
  explicit ElasticDeformation(Algorithm method) : method_(method) {}

  PassCount move(Body& body, HandleMove& move, PassOutput output) override;
  std::string remark() const override { return solver_ ? solver_->remark() : std::string(); }

 private:
  static Revisions revisions_of(const Body& body);
  static std::uint64_t positions_of(const Body& body);
  void prepare(const Body& body, const Progress& progress);
  void take_positions(const Body& body);
  void move_rigidly(const Mesh& mesh, HandleMove& move, const Progress& progress);
  void hold(const Body& body, const Handle& handle, const Progress& progress);
  void check_answer(const Body& body);
  PassCount take_answer(Body& body, std::span<const ElementId> handle, std::vector<ElementId>& moved) const;

  Algorithm method_;
  std::unique_ptr<ElasticSolver> solver_;
  Revisions made_for_;
  std::uint64_t positions_ = 0;  // revisions of the positions that the solver knows
  std::vector<double> pinned_;   // displacements of the pins that it was made for

  /// What the solver holds.
  struct Grab {
    ElementId first = no_element;
    std::uint64_t number = 0;  // of a handle of many
    bool operator==(const Grab&) const = default;
  };
  Grab held_;
};

/// Returns a motion in the coordinates that exist.
ElasticMotion elastic_motion(const Mesh& mesh, const RigidMotion& motion);

/// Makes the method of an entry of the algorithm table.
template <Algorithm Which>
std::unique_ptr<Method> make_elastic_method(Precision /*precision*/, int /*dimension*/) {
  return std::make_unique<ElasticDeformation>(Which);
}

}  // namespace chainmail
