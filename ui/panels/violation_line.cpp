#include "panels/violation_line.h"

#include <QHBoxLayout>
#include <QLocale>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "common/colours.h"

namespace chainmail {
namespace {

constexpr int shareWidth = 44, shareHeight = 10, shareMargin = 8;  // pixels
constexpr double leastShown = 0.04;  // a smaller share is drawn as this fraction of the bar
constexpr double leastFull = 0.1;    // rest lengths; see fullAt()

/// Returns a number with two digits, or without decimals.
QString rounded(double value) {
  return value < 99.5 ? QLocale().toString(value, 'g', 2) : QLocale().toString(value, 'f', 0);
}

/// Returns a share as a percentage that is not rounded to none or all.
QString percentage(double share) {
  const double percent = 100 * share;
  const QLocale locale;
  return percent < 1    ? QStringLiteral("less than 1 %")
         : percent > 99 ? QStringLiteral("%1 %").arg(share < 1 ? QStringLiteral("more than 99") : QStringLiteral("100"))
                        : QStringLiteral("%1 %").arg(locale.toString(std::lround(percent)));
}

/// Says that a sentence is about the end of the pass.
QString afterThePass(QString sentence) {
  sentence[0] = sentence[0].toLower();
  return QStringLiteral("After the pass: ") + sentence;
}

}  // namespace

QString violationInWords(const Statistics& statistics, bool hasMoved) {
  if (!statistics.remark.empty()) {
    return QString::fromStdString(statistics.remark);
  }
  const Violation& violation = statistics.violation;
  const bool whole = statistics.violation_of_whole_mesh, sampled = statistics.violation_of_sample;
  if (std::isnan(violation.fraction)) {
    return QStringLiteral("Some links without a finite length");
  }
  if (violation.fraction == 0) {
    return !hasMoved ? QStringLiteral("Nothing has moved yet")
           : whole   ? QStringLiteral("All links are valid")
           : sampled ? QStringLiteral("All links in a sample of the touched links are valid")
                     : QStringLiteral("All touched links are valid");
  }
  const QString share = QStringLiteral("%1 of %2violated, ")
                            .arg(percentage(violation.fraction), whole     ? QStringLiteral("links ")
                                                                 : sampled ? QStringLiteral("sampled touched links ")
                                                                           : QStringLiteral("touched links "));
  return share + (std::isfinite(violation.max) ? QStringLiteral("worst %1 × rest length").arg(rounded(violation.max))
                                               : QStringLiteral("some without a finite length"));
}

ViolationLine::ViolationLine() : sentence_(new QLabel) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(shareWidth + shareMargin, 0, 0, 0);
  row->addWidget(sentence_);
  words_ = brief_ = QStringLiteral("No figures yet");
  sentence_->setTextFormat(Qt::PlainText);
  sentence_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  sentence_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  followTheme(*this, [this] { update(); });
}

double ViolationLine::fullAt(double worst) { return std::isfinite(worst) ? std::max(worst, leastFull) : leastFull; }

void ViolationLine::show(const Statistics& statistics, const State& state) {
  const Violation& violation = statistics.violation;
  const bool inMidPass = state.inMidPass;
  const double share = violation.rms / fullAt(state.worst);
  share_ = !state.hasMoved || violation.fraction == 0 ? 0 : std::isfinite(share) ? std::min(share, 1.0) : 1;
  words_ = brief_ = violationInWords(statistics, state.hasMoved);
  if (!state.work.isEmpty()) {
    share_ = -1;
    words_ = brief_ = state.work;
    fitWords();
    update();
    return;
  }
  const bool isViolated = statistics.remark.empty() && violation.fraction > 0;
  if (isViolated) {
    brief_ = QStringLiteral("%1 violated").arg(percentage(violation.fraction));
    brief_ += inMidPass                      ? QString()
              : std::isfinite(violation.max) ? QStringLiteral(", worst %1 ×").arg(rounded(violation.max))
                                             : QStringLiteral(", some not finite");
  }
  if (inMidPass) {
    words_ = afterThePass(words_);
    brief_ = afterThePass(statistics.remark.empty() && violation.fraction == 0 ? QStringLiteral("all valid") : brief_);
  }
  fitWords();
  update();
}

/// Shortens the sentence only as far as the room requires.
void ViolationLine::fitWords() {
  const QFontMetrics metrics = sentence_->fontMetrics();
  const bool fits = metrics.horizontalAdvance(words_) <= sentence_->width();
  sentence_->setText(metrics.elidedText(fits ? words_ : brief_, Qt::ElideRight, sentence_->width()));
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
