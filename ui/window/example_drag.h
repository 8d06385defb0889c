#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include "document/document.h"

namespace chainmail {

/// An animated drag that shows the object in motion on the first start. It ends before the first press of a button or
/// key takes effect, or after 40 s. For the solvers, the object is then exactly at rest, without an undo step or a last
/// drag; the views show it with their next frame.
class ExampleDrag : public QObject {
  Q_OBJECT

 public:
  ExampleDrag(Document& document, QObject* parent);
  ~ExampleDrag() override;

  /// Starts the drag, unless the object has undo steps.
  void start();
  void stop();
  bool running() const { return clock_.isActive(); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void move();

  Document& document_;
  ElementId element_ = 0;
  Point from_ = Point::Zero();
  double reach_ = 0;  // mesh units
  QTimer clock_;
  QElapsedTimer since_;
};

}  // namespace chainmail
