#pragma once

#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "solve/chainmail_3d.h"
#include "solve/follow_pass.h"
#include "solve/natural_queue.h"
#include "solve/propagate.h"
#include "solve/waiting_history.h"

namespace chainmail {

/// A list-driven algorithm on a body of one scalar and one space dimension. Keeps what the last pass left for the next.
template <class Scalar, int Dimension>
class ListMethod {
 public:
  virtual ~ListMethod() = default;

  /// Answers the move of the grabbed element, which is at its target already. Returns the processed candidates, in
  /// order. `moved` receives the elements that moved, in order of update, without the grabbed one. It must be unchanged
  /// since the last pass, unless that pass was forgotten.
  virtual std::span<const Step> propagate(Body<Scalar, Dimension>& body, ElementId grabbed,
                                          std::vector<ElementId>& moved) = 0;

  /// Call this when the links, the pins, the regions or `moved` were changed by others.
  virtual void forget() = 0;
};

/// The common loop with one waiting list.
template <class List, class Scalar, int Dimension>
class OneList final : public ListMethod<Scalar, Dimension> {
 public:
  std::span<const Step> propagate(Body<Scalar, Dimension>& body, ElementId grabbed,
                                  std::vector<ElementId>& moved) override {
    chainmail::propagate(body, list_, record_, grabbed, moved);
    return record_.steps();
  }
  void forget() override { record_.forget(); }

 private:
  List list_;
  PassRecord record_;
};

/// 3D ChainMail: one list per direction.
template <class Scalar, int Dimension>
class ManyLists final : public ListMethod<Scalar, Dimension> {
 public:
  std::span<const Step> propagate(Body<Scalar, Dimension>& body, ElementId grabbed,
                                  std::vector<ElementId>& moved) override {
    lists_.propagate(body, record_, grabbed, moved);
    return record_.steps();
  }
  void forget() override { record_.forget(); }

 private:
  DirectionLists<> lists_;
  PassRecord record_;
};

/// Natural Queue ChainMail, which records its passes in its queue.
template <class Scalar, int Dimension>
class OneQueue final : public ListMethod<Scalar, Dimension> {
 public:
  std::span<const Step> propagate(Body<Scalar, Dimension>& body, ElementId grabbed,
                                  std::vector<ElementId>& moved) override {
    queue_.propagate(body, grabbed, moved);
    return queue_.steps();
  }
  void forget() override { queue_.forget(); }

 private:
  NaturalQueue<Scalar, Dimension> queue_;
};

/// The part of the algorithm table for list-driven algorithms: how to make the method, and how to find the waiting list
/// of a recorded pass.
struct ListAlgorithm {
  template <class Scalar, int Dimension>
  using Make = std::unique_ptr<ListMethod<Scalar, Dimension>> (*)();
  std::tuple<Make<float, 1>, Make<float, 2>, Make<float, 3>, Make<double, 1>, Make<double, 2>, Make<double, 3>> makers;
  WaitingHistory (*history)(const RecordedPass& pass);
  template <class Scalar, int Dimension>
  std::unique_ptr<ListMethod<Scalar, Dimension>> make() const {
    return std::get<Make<Scalar, Dimension>>(makers)();
  }
};

template <class Method, class Scalar, int Dimension>
std::unique_ptr<ListMethod<Scalar, Dimension>> make_list_method() {
  return std::make_unique<Method>();
}

/// Returns the entry of a method, for each scalar and space dimension.
template <template <class Scalar, int Dimension> class Method>
constexpr ListAlgorithm list_algorithm_of(WaitingHistory (*history)(const RecordedPass& pass)) {
  return {{make_list_method<Method<float, 1>, float, 1>, make_list_method<Method<float, 2>, float, 2>,
           make_list_method<Method<float, 3>, float, 3>, make_list_method<Method<double, 1>, double, 1>,
           make_list_method<Method<double, 2>, double, 2>, make_list_method<Method<double, 3>, double, 3>},
          history};
}

template <class List>
struct OneListOf {
  template <class Scalar, int Dimension>
  using Method = OneList<List, Scalar, Dimension>;
};

/// The entry of an algorithm that differs from others in its waiting list only.
template <class List>
inline constexpr ListAlgorithm list_algorithm =
    list_algorithm_of<OneListOf<List>::template Method>(follow_one_list<List>);

inline constexpr ListAlgorithm natural_queue_algorithm = list_algorithm_of<OneQueue>(follow_natural_queue);

inline constexpr ListAlgorithm chainmail_3d_algorithm = list_algorithm_of<ManyLists>(follow_directions);

}  // namespace chainmail
