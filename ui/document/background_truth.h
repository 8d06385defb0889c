#pragma once

#include <QTimer>
#include <memory>
#include <optional>

#include "common/jobs.h"
#include "document/document.h"
#include "measure/reference_solution.h"

namespace chainmail {

/// What physics says of the object: where a neo-Hookean solid with the document's pins, cuts and material comes to rest
/// while the element that was moved last is held at its place.
///
/// It is computed in the background once the hand rests, and given up when the hand moves on or what holds the object
/// changes. As long as it is not wanted nothing is done.
class BackgroundTruth : public QObject {
  Q_OBJECT

 public:
  struct Answer {
    MeshPointer mesh;
    ReferenceSolution truth;
    double rms = 0;      // of the truth's displacements (mesh units)
    double nothing = 0;  // the relative error of an object of which only the handle and the pins move
    std::string fault;   // why it is none; empty where it is one
  };

  explicit BackgroundTruth(const Document& document);

  void setWanted(bool wanted);
  /// None while there is no answer for the object as it stands.
  const std::shared_ptr<const Answer>& answer() const { return answer_; }
  /// Why there is none, in a few words.
  QString state() const;

 signals:
  /// There is an answer, or none any more, or the state is another.
  void changed();

 private:
  struct Hand {
    ElementId element = 0;
    Point target = Point::Zero();  // mesh units
    bool operator==(const Hand&) const = default;
  };
  class Worker;

  std::optional<Hand> lastHand() const;
  void followHand();
  void outdate();
  void ask();
  std::string whyNot() const;
  std::optional<ElasticProblem> problem() const;
  void compute(ElasticProblem problem);
  void take(std::shared_ptr<const Answer> answer);
  void say(const std::string& why);

  const Document& document_;
  bool wanted_ = false;
  std::optional<Hand> hand_;
  std::shared_ptr<const Answer> answer_;
  QString why_;
  QTimer delay_;                    // until the hand is taken to rest
  QTimer progress_;                 // is shown while it is computed
  std::shared_ptr<Worker> worker_;  // the jobs', one after the other
  Jobs jobs_;                       // last: its thread ends first
};

}  // namespace chainmail
