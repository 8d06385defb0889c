#include "panels/panel_state.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLocale>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "common/colours.h"

namespace chainmail {
namespace {

constexpr int distance = 6;              // pixels, from the edges of the view and between chips
constexpr int marginX = 8, marginY = 3;  // pixels, around the text of a chip
constexpr int rightSpace = 70;           // pixels, for the orientation cube
constexpr double opacity = 0.85;         // of the ground, so that the object shines through

constexpr int shareWidth = 44, shareHeight = 10, shareMargin = 8;  // pixels
constexpr int largeDigits = 48;      // pixels, which the last row of a lecture hall can read
constexpr double leastShown = 0.04;  // a smaller share is drawn as this fraction of the bar
constexpr double leastFull = 0.1;    // rest lengths; see fullAt()

/// Returns a number with two digits, or without decimals.
QString rounded(double value) {
  return value < 99.5 ? QLocale().toString(value, 'g', 2) : QLocale().toString(value, 'f', 0);
}

/// Returns a share as a percentage that is not rounded to none or all.
QString percentage(double share) {
  return share > 0 && share < 0.01   ? QStringLiteral("< 1 %")
         : share < 1 && share > 0.99 ? QStringLiteral("> 99 %")
                                     : QStringLiteral("%1 %").arg(std::lround(100 * share));
}

/// Says in a sentence how many links are violated, and by how much. Shorter sentences follow; they begin with the same
/// number.
QStringList inSentences(const Statistics& statistics, const ViolationLine::State& state) {
  if (!statistics.remark.empty()) {
    return {QString::fromStdString(statistics.remark)};
  }
  const MeasuredViolation& violation = statistics.violation;
  const QString when = state.inMidPass      ? QStringLiteral(" after the pass")
                       : violation.is_whole ? QString()
                                            : QStringLiteral(" so far");
  if (violation.fraction == 0) {
    return {state.hasMoved ? QStringLiteral("All links are valid") + when : QStringLiteral("Nothing has moved yet"),
            QStringLiteral("All valid")};
  }
  const QString number = percentage(violation.fraction), brief = number + QStringLiteral(" violated");
  const bool finite = std::isfinite(violation.max);
  const QString worst =
      finite ? QStringLiteral(", worst %1 ×").arg(rounded(violation.max)) : QStringLiteral(", some not finite");
  return {number + QStringLiteral(" of links violated") + when +
              (finite ? worst + QStringLiteral(" rest length") : QStringLiteral(", some without a finite length")),
          brief + when + worst, brief, number};
}

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

ViolationLine::ViolationLine() : number_(new QLabel), sentence_(new QLabel) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(shareWidth + shareMargin, 0, 0, 0);
  row->addWidget(number_);
  row->addWidget(sentence_, 1);
  number_->setObjectName(QStringLiteral("number"));
  number_->setTextFormat(Qt::PlainText);
  number_->setAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  number_->hide();
  sentence_->setObjectName(QStringLiteral("sentence"));
  sentence_->setTextFormat(Qt::PlainText);
  sentence_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  sentence_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  clear();
  followTheme(*this, [this] { update(); });
}

/// The width has room for every number, so that it does not change while dragging.
void ViolationLine::setLarge(bool on) {
  QFont large = font();
  large.setPixelSize(largeDigits);
  large.setBold(true);
  number_->setFont(large);
  number_->setFixedWidth(QFontMetrics(large).horizontalAdvance(percentage(0.999)) + shareMargin);
  number_->setVisible(on);
  fitWords();
}

double ViolationLine::fullAt(double worst) { return std::isfinite(worst) ? std::max(worst, leastFull) : leastFull; }

void ViolationLine::show(const Statistics& statistics, const State& state) {
  if (!state.work.isEmpty()) {
    say({state.work}, QStringLiteral("–"), -1);
    return;
  }
  const Violation& violation = statistics.violation;
  const double share = violation.rms / fullAt(state.worst);
  const bool none = !state.hasMoved || violation.fraction == 0;
  say(inSentences(statistics, state), percentage(state.hasMoved ? violation.fraction : 0),
      none                   ? 0
      : std::isfinite(share) ? std::min(share, 1.0)
                             : 1);
}

void ViolationLine::say(const QStringList& sentences, const QString& number, double share) {
  sentences_ = sentences;
  number_->setText(number);
  share_ = share;
  fitWords();
  update();
}

/// Shows the longest sentence for which there is room. After the large number, it does not begin with that number.
void ViolationLine::fitWords() {
  const QFontMetrics metrics = sentence_->fontMetrics();
  QString fitting;
  for (const QString& sentence : sentences_) {
    const bool repeats = number_->isVisibleTo(this) && sentence.startsWith(number_->text());
    fitting = repeats ? sentence.mid(number_->text().size()).trimmed() : sentence;
    if (metrics.horizontalAdvance(fitting) <= sentence_->width()) {
      break;
    }
  }
  sentence_->setText(metrics.elidedText(fitting, Qt::ElideRight, sentence_->width()));
}

void ViolationLine::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fitWords();
}

void ViolationLine::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  const QRectF bar(0, (height() - shareHeight) / 2.0, shareWidth, shareHeight);
  painter.setBrush(share_ < 0 ? palette().color(QPalette::Mid) : QColor(colours::inside));
  painter.drawRoundedRect(bar, 3, 3);
  if (share_ > 0) {
    painter.setClipRect(QRectF(bar.topLeft(), QSizeF(std::max(leastShown, share_) * shareWidth, shareHeight)));
    painter.setBrush(QColor(colours::outside));
    painter.drawRoundedRect(bar, 3, 3);
  }
}

}  // namespace chainmail
