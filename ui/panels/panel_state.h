#pragma once

#include <QLabel>
#include <QStringList>
#include <QWidget>
#include <vector>

#include "simulate/simulation.h"

namespace chainmail {

/// The states of a panel's object for which its head has no room, as chips that wrap. They lie over the upper edge of
/// the view, which they do not move, and let the mouse through.
class StateChips : public QWidget {
  Q_OBJECT

 public:
  explicit StateChips(QWidget& view);
  void setStates(const QStringList& states);
  QStringList states() const { return states_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void changeEvent(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void place();

  QWidget& view_;
  QStringList states_;
  std::vector<QRect> chips_;  // one for each state
};

/// A bar and a sentence that say how many links of a panel are violated, and by how much. The bar weighs both: its
/// length is the RMS violation. Many small violations may weigh less than a few large ones.
class ViolationLine : public QWidget {
  Q_OBJECT

 public:
  ViolationLine();

  /// What a panel shows beside its figures.
  struct State {
    bool hasMoved = true;    // false: the object is at rest
    bool inMidPass = false;  // true if the panel shows the object before the end of the pass
    QString work = {};       // what the solver has been doing for a while, if it is late; its figures are old then
    double worst = 0;        // RMS violation of the panel where it is largest; see fullAt()
  };
  /// Shows the figures of the last measurement.
  void show(const Statistics& statistics, const State& state);
  /// Says that there are no figures of the object yet.
  void clear() { say({QStringLiteral("No figures yet")}, QStringLiteral("–"), -1); }
  /// Shows the share of violated links in large digits before the sentence, for an audience.
  void setLarge(bool on);
  /// Returns the RMS violation (rest lengths) at which the bar is full: that of the worst panel, but at least 0.1, so
  /// that tiny violations do not look large.
  static double fullAt(double worst);
  const QString& sentence() const { return sentences_.front(); }
  /// Length of the bar, from 0 to 1; negative while there is nothing to show.
  double share() const { return share_; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void say(const QStringList& sentences, const QString& number, double share);
  void fitWords();

  QLabel *number_, *sentence_;
  QStringList sentences_;  // the whole sentence, and shorter ones for narrow panels
  double share_ = -1;
};

}  // namespace chainmail
