#pragma once

#include <atomic>
#include <memory>
#include <new>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "body/body_view.h"
#include "body/method.h"
#include "solver/algorithms.h"

namespace chainmail::test {

/// The kinds of exceptions that nothing may let through.
enum class Failure { none, memory, system, other, number };

inline void fail(Failure failure) {
  switch (failure) {
    case Failure::memory:
      throw std::bad_alloc();
    case Failure::system:
      throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
    case Failure::other:
      throw std::runtime_error("a surprise");
    case Failure::number:
      throw 7;
    case Failure::none:
      return;
  }
}

/// What the moves of a failing method do, and how many there were. Shared by its bodies and the test.
struct FailingMoves {
  std::atomic<Failure> failure = Failure::none;
  std::atomic<int> count = 0;
};

/// Moves the handle alone, and fails after that if the test wants it.
class FailingMethod : public Method {
 public:
  explicit FailingMethod(std::shared_ptr<FailingMoves> moves) : moves_(std::move(moves)) {}

  PassCount move(Body& body, HandleMove& move, PassOutput output) override {
    ++moves_->count;
    output.moved.clear();
    body.with_view([&](const auto& view) {
      for (int axis = 0; axis < body.mesh().space_dimension; ++axis) {
        view.set_position(move.handle.elements()[0], axis, move.pose.pivot[axis]);
      }
    });
    fail(moves_->failure);
    return {};
  }

 private:
  std::shared_ptr<FailingMoves> moves_;
};

constexpr auto failing_algorithm = Algorithm(1001);

inline AlgorithmInfo failing_entry(const std::shared_ptr<FailingMoves>& moves) {
  return {.algorithm = failing_algorithm,
          .name = "failing",
          .label = "Failing",
          .source = "nobody 2000",
          .summary = "fails",
          .style = {"M0 0H1V1Z", "#123456"},
          .make = [moves](Precision, int) { return std::make_unique<FailingMethod>(moves); }};
}

}  // namespace chainmail::test
