#pragma once

#include <QTimer>
#include <memory>
#include <optional>

#include "common/jobs.h"
#include "document/document.h"
#include "measure/reference_solution.h"

namespace chainmail {

/// Computes the reference solution of the document's object: the shape in which a neo-Hookean solid with the document's
/// pins, cuts and material comes to rest while the handle holds the elements that were moved last.
///
/// The computation runs in the background once the handle rests. It is cancelled when the handle moves, or when pins,
/// cuts or material change. It computes nothing until setWanted(true) is called.
class BackgroundReference : public QObject {
  Q_OBJECT

 public:
  struct Answer {
    MeshPointer mesh;
    ReferenceSolution solution;
    double rms = 0;      // root mean square displacement of the solution (mesh units)
    double nothing = 0;  // relative error of an object in which only the handle and the pins move
    std::string fault;   // why there is no solution; empty if there is one
  };

  explicit BackgroundReference(const Document& document);

  void setWanted(bool wanted);
  /// Returns the answer for the current object; null while there is none.
  const std::shared_ptr<const Answer>& answer() const { return answer_; }
  /// Returns a short text that says why there is no answer.
  QString state() const;

 signals:
  /// The answer or the state has changed.
  void changed();

 private:
  /// The handle as it was moved last.
  struct Handle {
    std::vector<ElementId> elements;  // ascending
    Point target = Point::Zero();     // mesh units
    Rotation rotation;
    bool relative = false;  // the target is a way from where it was grabbed
    bool operator==(const Handle&) const = default;
  };
  /// The problem, and what the handle prescribes.
  struct Task {
    ElasticProblem problem;
    std::vector<ElementId> handle;
    std::vector<double> displacements;  // of the handle from rest, space_dimension coordinates each (mesh units)
    std::optional<Point> target;        // instead of the displacements, for a handle of one element
  };
  class Worker;

  std::optional<Handle> lastHandle() const;
  void followHandle();
  void outdate();
  void compute();
  static bool hasOneTarget(const Handle& handle);
  bool isAtRest() const;
  std::string whyNot() const;
  std::optional<Task> task() const;
  void start(Task task);
  void take(std::shared_ptr<const Answer> answer);
  void setState(const std::string& why);

  const Document& document_;
  bool wanted_ = false;
  std::optional<Handle> handle_;
  std::shared_ptr<const Answer> answer_;
  QString why_;
  QTimer delay_;                    // runs until the handle counts as resting
  QTimer progress_;                 // refreshes the progress of the computation
  std::shared_ptr<Worker> worker_;  // used by one job at a time
  Jobs jobs_;                       // the last member: its thread must end before the others are destroyed
};

}  // namespace chainmail
