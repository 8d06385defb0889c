#include "tools/element_readout.h"

#include <QLocale>

#include "document/element_facts.h"

namespace chainmail {
namespace {

constexpr int refreshMilliseconds = 100;

}  // namespace

ElementReadout::ElementReadout(const Document& document, const Measurement& measurement, std::function<int()> hovered)
    : document_(document), measurement_(measurement), hovered_(std::move(hovered)), refresh_(this) {
  setObjectName(QStringLiteral("readout"));
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  refresh_.setSingleShot(true);
  refresh_.setInterval(refreshMilliseconds);
  connect(&refresh_, &QTimer::timeout, this, &ElementReadout::updateText);
  const auto later = [this] {
    if (!refresh_.isActive() && (document_.highlight().element || measurement_.from())) {
      refresh_.start();
    }
  };
  connect(&document, &Document::frameReady, this, later);
  connect(&document, &Document::softnessChanged, this, later);
  connect(&document, &Document::cutsChanged, this, later);
  connect(&document, &Document::highlightChanged, this, &ElementReadout::updateText);
  connect(&measurement, &Measurement::changed, this, &ElementReadout::updateText);
}

void ElementReadout::setHint(const QString& hint) {
  hint_ = hint;
  updateText();
}

void ElementReadout::updateText() {
  const auto& element = document_.highlight().element;
  // At an end of the measured distance, the distance is more useful.
  const bool measured = element && (element == measurement_.from() || element == measurement_.to());
  setText(element && !measured ? describe(*element) : measurement_.from() ? measurement_.sentence() : hint_);
}

/// Describes the element in all panels; the panel under the cursor comes first.
QString ElementReadout::describe(ElementId element) const {
  const int first = hovered_();
  QString places;
  for (int i = 0; i < document_.panels(); ++i) {
    const int panel = i == 0 ? first : i <= first ? i - 1 : i;
    places += QStringLiteral("  ·  %1: %2, violation %3")
                  .arg(i == 0 ? QStringLiteral("<b>%1</b>").arg(panelName(panel)) : panelName(panel),
                       coordinates(*document_.mesh(), positionIn(document_, panel, element)),
                       QLocale().toString(violationIn(document_, panel, element), 'g', 3));
  }
  const SoftnessRange softness = softnessOf(document_, element);
  QString links = QStringLiteral("no links");
  if (softness.links > 0) {
    links = QStringLiteral("%L1 %2: compression %3, stretch %4, shear %5")
                .arg(softness.links)
                .arg(softness.links == 1 ? QStringLiteral("link") : QStringLiteral("links"),
                     range(softness.least.compression, softness.most.compression),
                     range(softness.least.stretch, softness.most.stretch),
                     range(softness.least.shear, softness.most.shear));
  }
  return QStringLiteral("<b>Element %L1</b>%2%3  ·  %4")
      .arg(element)
      .arg(document_.isPinned(element) ? QStringLiteral(", pinned") : QString(), places, links);
}

}  // namespace chainmail
