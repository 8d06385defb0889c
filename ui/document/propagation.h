#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <memory>
#include <vector>

#include "document/document.h"
#include "document/pass_player.h"

namespace chainmail {

/// Looks at the last pass of every panel, step by step.
///
/// While it is open the solvers record their passes. It follows them, the panels showing the newest frames, until
/// someone goes to a step: then it holds that pass, and the panels show the object as it was at the step. To take an
/// element into the hand, or to change the object, lets go of the pass.
class Propagation : public QObject {
  Q_OBJECT

 public:
  explicit Propagation(Document& document);
  ~Propagation() override;

  void setOpen(bool open);
  bool isOpen() const { return open_; }
  bool follows() const { return follows_; }
  void setFollows(bool follows);

  /// A panel's pass; none as long as there is none of this object.
  const PassPlayer* player(int panel) const { return players_[std::size_t(panel)].get(); }
  bool hasPass() const;
  /// Of the longest pass.
  std::size_t stepCount() const;

  /// All panels go to the same step, each as far as its pass leads, or the chosen one alone.
  bool together() const { return together_; }
  void setTogether(bool together);
  int chosen() const { return chosen_; }
  void choose(int panel);
  /// Holds the pass, and goes to a step in the panel, or in all.
  void setStep(int panel, std::size_t step);
  /// The same for the chosen panel, or the furthest of all: by some steps, or to one end.
  void stepBy(std::ptrdiff_t steps);
  void goTo(std::size_t step) { setStep(chosen_, step); }

  bool plays() const { return clock_.isActive(); }
  void setPlays(bool plays);
  /// Steps a second.
  void setSpeed(double speed) { speed_ = speed; }

 signals:
  /// Other passes, another step, or another way to look.
  void changed();

 private:
  void awaitPass();
  bool tooLargeNow() const;
  void takePasses();
  void letGo();
  void forget();
  void show(int panel);
  bool atEnd() const;
  std::size_t position() const;
  void playOn();

  Document& document_;
  std::vector<std::unique_ptr<PassPlayer>> players_;
  bool open_ = false;
  bool follows_ = true;
  bool together_ = true;
  int chosen_ = 0;
  QTimer fetch_;  // passes are fetched at a rate that can be read, however fast they come
  QTimer clock_;  // of slow motion
  QElapsedTimer sinceStep_;
  double speed_ = 5;
  double due_ = 0;  // steps, and a part of one
};

}  // namespace chainmail
