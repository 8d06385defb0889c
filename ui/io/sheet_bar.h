#pragma once

#include <QSize>
#include <QSpinBox>

#include "common/ask_bar.h"

namespace chainmail {

/// Asks how many elements across a picture's sheet has.
class SheetBar : public AskBar {
  Q_OBJECT

 public:
  static constexpr int standardAcross = 32;

  SheetBar();

  /// About a picture of so many pixels.
  void ask(const QString& name, QSize picture);
  int across() const { return across_->value(); }

 private:
  void describe();

  QSize picture_;
  QSpinBox* across_;
};

}  // namespace chainmail
