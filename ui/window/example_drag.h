#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include "document/document.h"

namespace chainmail {

/// A hand that moves the object gently for who sees the workbench for the first time. It ends at the first press of a
/// button or a key in the window, before that is acted on, or after a while; then the object is at rest to the bit, and
/// nothing is left of it: no step of undo, no last drag.
class ExampleDrag : public QObject {
  Q_OBJECT

 public:
  ExampleDrag(Document& document, QObject* parent);
  ~ExampleDrag() override;

  /// Only on an object that nothing was done to yet.
  void start();
  void stop();
  bool running() const { return clock_.isActive(); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void move();
  bool showsRest() const;

  Document& document_;
  ElementId element_ = 0;
  Point from_ = Point::Zero();
  double reach_ = 0;  // mesh units
  QTimer clock_;
  QElapsedTimer since_;
};

}  // namespace chainmail
