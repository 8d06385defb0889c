#pragma once

#include <QLabel>
#include <QTimer>
#include <functional>

#include "tools/measure_tool.h"

namespace chainmail {

/// The text in the status bar: data of the element under the cursor or of a handle of many, otherwise the measured
/// distance, otherwise the hint of the tool. It does nothing while neither the mouse nor the object moves.
class ElementReadout : public QLabel {
  Q_OBJECT

 public:
  /// `hovered` returns the panel under the cursor.
  ElementReadout(const Document& document, const Measurement& measurement, std::function<int()> hovered);

  void setHint(const QString& hint);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void updateText();
  QString describe(ElementId element) const;
  bool hasRoomFor(const QString& text) const;
  bool holdsMany() const;
  QString describeHandle() const;
  std::vector<int> panelsInOrder() const;

  const Document& document_;
  const Measurement& measurement_;
  std::function<int()> hovered_;
  QString hint_;
  QTimer refresh_;  // limits how often the text changes, so that it can be read
};

}  // namespace chainmail
