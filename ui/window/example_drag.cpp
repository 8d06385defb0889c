#include "window/example_drag.h"

#include <QCoreApplication>
#include <QEvent>
#include <algorithm>
#include <cmath>

namespace chainmail {
namespace {

constexpr int moveMilliseconds = 16;  // between two moves
constexpr double longest = 40;        // seconds until the example stops without user input
constexpr double swing = 5.2;         // seconds per period, horizontal
constexpr double rise = 3.4;          // seconds per period, vertical
constexpr double beginning = 2;       // seconds until the full amplitude
constexpr double reachInLinks = 3.5;  // horizontal amplitude in mean link lengths; the vertical one is 0.6 of it

bool isTouch(const QEvent& event) {
  switch (event.type()) {
    case QEvent::MouseButtonPress:
    case QEvent::Wheel:
    case QEvent::TouchBegin:
    case QEvent::KeyPress:
    case QEvent::ShortcutOverride:  // comes before the action of a key
    case QEvent::DragEnter:
    case QEvent::Close:
      return true;
    default:
      return false;
  }
}

}  // namespace

ExampleDrag::ExampleDrag(Document& document, QObject* parent) : QObject(parent), document_(document) {
  clock_.setTimerType(Qt::PreciseTimer);
  clock_.setInterval(moveMilliseconds);
  connect(&clock_, &QTimer::timeout, this, &ExampleDrag::move);
}

ExampleDrag::~ExampleDrag() { QCoreApplication::instance()->removeEventFilter(this); }

void ExampleDrag::start() {
  if (running() || document_.undoStack().count() != 0 || document_.highlight().marks().grabbed) {
    return;
  }
  const Mesh& mesh = *document_.mesh();
  element_ = mesh.element_count() * 4 / 5;  // away from the centre, so that near and far elements move differently
  from_ = mesh.rest_position(element_);
  reach_ = reachInLinks * mesh.mean_link_length;
  QCoreApplication::instance()->installEventFilter(this);
  document_.handle().grab(element_);
  since_.start();
  clock_.start();
}

void ExampleDrag::move() {
  const double seconds = double(since_.elapsed()) / 1000;
  if (seconds > longest) {
    stop();
    return;
  }
  const double share = reach_ * std::min(1.0, seconds / beginning);
  document_.highlight().set({element_, true, {}});
  document_.handle().drag(from_ + Point(share * std::sin(2 * M_PI * seconds / swing),
                                        share * 0.6 * std::sin(2 * M_PI * seconds / rise), 0));
}

void ExampleDrag::stop() {
  if (!running()) {
    return;
  }
  clock_.stop();
  QCoreApplication::instance()->removeEventFilter(this);
  document_.handle().release();
  document_.undo();
  document_.undoStack().clear();
  document_.moves().forget();
  document_.highlight().set({});
}

bool ExampleDrag::eventFilter(QObject* /*watched*/, QEvent* event) {
  if (isTouch(*event)) {
    stop();
  }
  return false;
}

}  // namespace chainmail
