#include "tools/measure_tool.h"

#include <QStringList>

#include "common/text.h"
#include "document/element_facts.h"
#include "panels/view.h"

namespace chainmail {
namespace {

/// Returns a text such as 'rest 3, × 1.07'; without the ratio if the distance at rest is 0.
QString restText(const Measurement::Figures& figures) {
  const QString rest = QStringLiteral("rest %1").arg(figure(figures.rest));
  return figures.rest > 0 ? QStringLiteral("%1, × %2").arg(rest, shownNumber(figures.now / figures.rest, 'f', 3))
                          : rest;
}

}  // namespace

Measurement::Measurement(const Document& document) : document_(document) {
  connect(&document, &Document::meshChanged, this, &Measurement::clear);
}

void Measurement::begin(ElementId from) { set(from, {}, false); }
void Measurement::lead(std::optional<ElementId> to) { set(from_, to == from_ ? std::nullopt : to, false); }
void Measurement::end(ElementId to) { set(from_, to, true); }
void Measurement::clear() { set({}, {}, false); }

void Measurement::set(std::optional<ElementId> from, std::optional<ElementId> to, bool complete) {
  if (from != from_ || to != to_ || complete != complete_) {
    from_ = from;
    to_ = to;
    complete_ = complete;
    emit changed();
  }
}

Measurement::Figures Measurement::figures(int panel) const {
  const Mesh& mesh = *document_.mesh();
  const Point apart = positionIn(document_, panel, *to_) - positionIn(document_, panel, *from_);
  return {apart, apart.norm(), (mesh.rest_position(*to_) - mesh.rest_position(*from_)).norm()};
}

QString Measurement::sentence() const {
  if (!from_) {
    return {};
  }
  if (!to_) {
    return QStringLiteral("From element %L1: click another one").arg(*from_);
  }
  QStringList panels;
  for (int panel = 0; panel < document_.panels(); ++panel) {
    const Figures of = figures(panel);
    panels << QStringLiteral("%1: <b>%2</b> (× %3; %4)")
                  .arg(panelName(panel), figure(of.now),
                       of.rest > 0 ? shownNumber(of.now / of.rest, 'f', 3) : QStringLiteral("–"),
                       coordinates(*document_.mesh(), of.apart, QStringLiteral("d")));
  }
  return QStringLiteral("From element %L1 to %L2, at rest %3  ·  %4")
      .arg(*from_)
      .arg(*to_)
      .arg(figure(figures(0).rest), panels.join(QStringLiteral("  ·  ")));
}

std::vector<Annotation> Measurement::annotations(const View& view) const {
  if (!from_) {
    return {};
  }
  const QPointF begin = view.viewPosition(*from_);
  if (!to_) {
    return {{QLineF(begin, begin), QStringLiteral("element %L1").arg(*from_)}};
  }
  const Figures of = figures(view.panel());
  return {{QLineF(begin, view.viewPosition(*to_)),
           QStringLiteral("%1 (%2)\n%3")
               .arg(figure(of.now), restText(of), coordinates(*document_.mesh(), of.apart, QStringLiteral("d")))}};
}

QString MeasureTool::hint() const {
  return QStringLiteral(
      "Left: click one element, then another: their distance now and at rest (mesh units)  ·  Esc: clear");
}

void MeasureTool::hover(View& view, QPointF position) {
  const auto element = view.search().elementAt(position);
  document_.highlight().set({element, false, {}});
  if (busy()) {
    measurement_.lead(element);
  }
}

void MeasureTool::press(View& view, QPointF position, Qt::KeyboardModifiers /*modifiers*/) {
  const auto element = view.search().elementAt(position);
  if (!element) {
    measurement_.clear();
  } else if (!busy()) {
    measurement_.begin(*element);
  } else if (element != measurement_.from()) {
    measurement_.end(*element);
  }
}

/// Clears an incomplete measurement. A complete one stays while another tool drags the elements.
void MeasureTool::cancel() {
  if (busy()) {
    measurement_.clear();
  }
  document_.highlight().set({});
}

void MeasureTool::escape() {
  measurement_.clear();
  document_.highlight().set({});
}

}  // namespace chainmail
