#pragma once

#include <QLabel>
#include <QWidget>

#include "simulate/simulation.h"

namespace chainmail {

/// A bar and a sentence that say how many links of a panel are violated, and by how much.
class ViolationLine : public QWidget {
  Q_OBJECT

 public:
  ViolationLine();

  /// Shows the figures of the last pass. `inMidPass`: the panel shows the object before the end of that pass.
  void show(const Statistics& statistics, bool hasMoved, bool inMidPass);
  const QString& sentence() const { return words_; }
  /// Fraction of the violated links; negative while there is none to show.
  double share() const { return share_; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fitWords();

  QLabel* sentence_;
  QString words_, brief_;  // the whole sentence, and one for narrow panels
  double share_ = -1;
};

/// Describes the violation of links in a sentence.
QString violationInWords(const Statistics& statistics, bool hasMoved);

}  // namespace chainmail
