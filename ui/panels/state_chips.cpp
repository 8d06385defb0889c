#include "panels/state_chips.h"

#include <QEvent>
#include <QPainter>
#include <algorithm>

#include "common/colours.h"

namespace chainmail {
namespace {

constexpr int distance = 6;              // pixels, from the edges of the view and between chips
constexpr int marginX = 8, marginY = 3;  // pixels, around the text of a chip
constexpr int rightSpace = 70;           // pixels, for the orientation cube
constexpr double opacity = 0.85;         // of the ground, so that the object shines through

}  // namespace

StateChips::StateChips(QWidget& view) : QWidget(view.parentWidget()), view_(view) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  view.installEventFilter(this);
  hide();
}

void StateChips::setStates(const QStringList& states) {
  if (states != states_) {
    states_ = states;
    setAccessibleName(states.join(QStringLiteral(", ")));
    place();
  }
}

bool StateChips::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize || event->type() == QEvent::Move) {
    place();
  }
  return QWidget::eventFilter(watched, event);
}

void StateChips::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) {
    place();
  }
}

/// Puts the chips into rows from left to right. A state that is wider than the view has several lines.
void StateChips::place() {
  chips_.clear();
  const int width = std::max(0, view_.width() - 2 * distance - rightSpace);
  QPoint at;
  int bottom = 0;
  for (const QString& state : states_) {
    const QRect room(0, 0, std::max(1, width - 2 * marginX), QWIDGETSIZE_MAX);
    const QRect words = fontMetrics().boundingRect(room, Qt::TextWordWrap, state);
    if (at.x() > 0 && at.x() + words.width() + 2 * marginX > width) {
      at = {0, bottom + distance};
    }
    chips_.emplace_back(at, words.size() + QSize(2 * marginX, 2 * marginY));
    bottom = std::max(bottom, at.y() + chips_.back().height());
    at.rx() += chips_.back().width() + distance;
  }
  setGeometry({view_.pos() + QPoint(distance, distance), QSize(width, bottom)});
  setVisible(!states_.isEmpty());
  raise();
  update();
}

void StateChips::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QColor ground = palette().color(QPalette::Window);
  ground.setAlphaF(float(opacity));
  for (std::size_t i = 0; i < chips_.size(); ++i) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(ground);
    const double round = fontMetrics().height() / 2.0 + marginY;
    painter.drawRoundedRect(chips_[i], round, round);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(chips_[i].adjusted(marginX, marginY, 0, 0), Qt::TextWordWrap, states_[qsizetype(i)]);
  }
}

}  // namespace chainmail
