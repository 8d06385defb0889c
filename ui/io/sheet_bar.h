#pragma once

#include <QSize>
#include <QSpinBox>

#include "common/ask_bar.h"

namespace chainmail {

/// Asks how many elements a picture's sheet has along its width.
class SheetBar : public AskBar {
  Q_OBJECT

 public:
  static constexpr int standardAcross = 32;

  SheetBar();

  /// Asks about a picture of this size in pixels.
  void ask(const QString& name, QSize picture);
  int across() const { return across_->value(); }

 private:
  void describe();

  QSize picture_;
  QSpinBox* across_;
};

}  // namespace chainmail
