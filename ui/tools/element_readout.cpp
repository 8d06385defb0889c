#include "tools/element_readout.h"

#include <QTextDocument>
#include <algorithm>

#include "common/text.h"
#include "document/element_facts.h"

namespace chainmail {
namespace {

constexpr int refreshMilliseconds = 100;

QString softnessInWords(const SoftnessRange& softness) {
  QStringList numbers;
  for (const auto& [parameter, value] : std::span(softness_numbers).first(region_numbers)) {
    numbers << text(parameter->name) + QLatin1Char(' ') + range(softness.least.*value, softness.most.*value);
  }
  return softness.links == 0 ? QString() : QStringLiteral(": ") + numbers.join(QStringLiteral(", "));
}

}  // namespace

ElementReadout::ElementReadout(const Document& document, const Measurement& measurement, std::function<int()> hovered)
    : document_(document), measurement_(measurement), hovered_(std::move(hovered)), refresh_(this) {
  setObjectName(QStringLiteral("readout"));
  setTextFormat(Qt::RichText);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  refresh_.setSingleShot(true);
  refresh_.setInterval(refreshMilliseconds);
  connect(&refresh_, &QTimer::timeout, this, &ElementReadout::updateText);
  const auto later = [this] {
    if (!refresh_.isActive() && (document_.highlight().marks().element || holdsMany() || measurement_.from())) {
      refresh_.start();
    }
  };
  connect(&document.solvers(), &PanelSolvers::frameReady, this, later);
  connect(&document, &Document::softnessChanged, this, later);
  connect(&document, &Document::cutsChanged, this, later);
  connect(&document.highlight(), &Highlight::changed, this, &ElementReadout::updateText);
  connect(&measurement, &Measurement::changed, this, &ElementReadout::updateText);
}

void ElementReadout::setHint(const QString& hint) {
  hint_ = hint;
  updateText();
}

void ElementReadout::updateText() {
  const auto& element = document_.highlight().marks().element;
  // At an end of the measured distance, the distance is more useful.
  const bool measured = element && (element == measurement_.from() || element == measurement_.to());
  setText(wholeParts(element && !measured  ? describe(*element)
                     : holdsMany()         ? describeHandle()
                     : measurement_.from() ? measurement_.sentence()
                                           : hint_,
                     [this](const QString& text) { return hasRoomFor(text); }));
}

void ElementReadout::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  updateText();
}

bool ElementReadout::holdsMany() const {
  return document_.highlight().marks().grabbed && !document_.highlight().marks().handle.empty();
}

/// Returns the panels; the panel under the cursor comes first.
std::vector<int> ElementReadout::panelsInOrder() const {
  std::vector<int> panels{hovered_()};
  for (int panel = 0; panel < document_.panels(); ++panel) {
    if (panel != panels.front()) {
      panels.push_back(panel);
    }
  }
  return panels;
}

/// Describes a handle of many elements in all panels by the position of its middle.
QString ElementReadout::describeHandle() const {
  QString text = QStringLiteral("<b>Handle of %1</b>")
                     .arg(counted(document_.highlight().marks().handle.size(), QStringLiteral("element")));
  for (const int panel : panelsInOrder()) {
    text += QStringLiteral("  ·  %1: middle %2")
                .arg(panelName(panel),
                     coordinates(*document_.mesh(), middleIn(document_, panel, document_.highlight().marks().handle)));
  }
  return text;
}

/// Describes the element in all panels; the panel under the cursor comes first.
QString ElementReadout::describe(ElementId element) const {
  QString places;
  for (const int panel : panelsInOrder()) {
    places += QStringLiteral("  ·  %1: %2, violation %3")
                  .arg(panel == hovered_() ? QStringLiteral("<b>%1</b>").arg(panelName(panel)) : panelName(panel),
                       coordinates(*document_.mesh(), positionIn(document_, panel, element)),
                       shownNumber(violationIn(document_, panel, element), 'g', 3));
  }
  const SoftnessRange softness = softnessOf(document_, element);
  const QString links = softness.links == 0 ? QStringLiteral("  ·  no links")
                                            : QStringLiteral("  ·  ") + counted(softness.links, QStringLiteral("link"));
  const QString head = QStringLiteral("<b>Element %L1</b>%2")
                           .arg(element)
                           .arg(isPinned(document_, element) ? QStringLiteral(", pinned") : QString());
  return head + places + links + softnessInWords(softness);
}

bool ElementReadout::hasRoomFor(const QString& text) const {
  QTextDocument whole;
  whole.setDefaultFont(font());
  whole.setDocumentMargin(0);
  whole.setHtml(text);
  return whole.idealWidth() <= width();
}

}  // namespace chainmail
