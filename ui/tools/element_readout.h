#pragma once

#include <QLabel>
#include <QTimer>
#include <functional>

#include "tools/measurement.h"

namespace chainmail {

/// The status bar's line: what is known of the element under the cursor, else of what is measured, else what the
/// mouse does. While the mouse and the object rest it does nothing.
class ElementReadout : public QLabel {
  Q_OBJECT

 public:
  /// `hovered` says which panel the cursor is over.
  ElementReadout(const Document& document, const Measurement& measurement, std::function<int()> hovered);

  void setHint(const QString& hint);

 private:
  void showWhatIs();
  QString describe(ElementId element) const;

  const Document& document_;
  const Measurement& measurement_;
  std::function<int()> hovered_;
  QString hint_;
  QTimer refresh_;  // figures change at a rate that can be read
};

}  // namespace chainmail
