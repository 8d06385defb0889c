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

/// Puts the chips into rows from left to right. A state that is wider than the view is shortened when it is painted.
void StateChips::place() {
  chips_.clear();
  const int width = std::max(0, view_.width() - 2 * distance - rightSpace);
  const int height = fontMetrics().height() + 2 * marginY;
  QPoint at;
  for (const QString& state : states_) {
    const int wide = std::min(width, fontMetrics().horizontalAdvance(state) + 2 * marginX);
    if (at.x() > 0 && at.x() + wide > width) {
      at = {0, at.y() + height + distance};
    }
    chips_.emplace_back(at, QSize(wide, height));
    at.rx() += wide + distance;
  }
  setGeometry({view_.pos() + QPoint(distance, distance), QSize(width, at.y() + height)});
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
    painter.drawRoundedRect(chips_[i], chips_[i].height() / 2.0, chips_[i].height() / 2.0);
    painter.setPen(palette().color(QPalette::WindowText));
    const QRect inside = chips_[i].adjusted(marginX, 0, -marginX, 0);
    painter.drawText(inside, Qt::AlignVCenter | Qt::AlignLeft,
                     fontMetrics().elidedText(states_[qsizetype(i)], Qt::ElideRight, inside.width()));
  }
}

}  // namespace chainmail
