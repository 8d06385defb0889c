// The order of this file: construction, figures, state line, drawing for print.

#include "panels/panel.h"

#include <QPainter>
#include <QTextDocument>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "common/colours.h"
#include "common/text.h"
#include "document/element_facts.h"
#include "document/panel_colour.h"
#include "panels/panel_state.h"

namespace chainmail {
namespace {

constexpr qsizetype mostFigures = 4;   // in a line
constexpr int lateMilliseconds = 300;  // a solver that works for longer without a frame is said to work
constexpr int printMargin = 8;         // pixels, the same as on the screen
const colours::Colour& ink = colours::marked;

/// Draws a part of the panel, in coordinates of that part.
void drawAt(QPainter& painter, const QRect& part, const std::function<void()>& draw) {
  painter.save();
  painter.translate(part.topLeft());
  painter.setClipRect(QRect(QPoint(), part.size()));
  painter.setPen(QColor(ink));
  draw();
  painter.restore();
}

}  // namespace

Panel::Panel(Document& document, Colouring& colouring, PanelLinks& links, int panel, std::shared_ptr<Camera> camera,
             std::shared_ptr<MeshLevels> levels, QTimer& refresh)
    : document_(document),
      colouring_(colouring),
      panel_(panel),
      violation_(new ViolationLine),
      unsettled_(new QWidget),
      distance_(new QLabel),
      statistics_(new QLabel),
      view_(new View(document, colouring, links, panel, std::move(camera), std::move(levels))),
      head_(new PanelHead(document, *view_, panel)),
      legend_(new Legend),
      refresh_(refresh),
      late_(this) {
  view_->setObjectName(QStringLiteral("view%1").arg(panel));
  legend_->setObjectName(QStringLiteral("legend%1").arg(panel));
  violation_->setObjectName(QStringLiteral("violation%1").arg(panel));
  statistics_->setTextFormat(Qt::RichText);
  statistics_->setObjectName(QStringLiteral("statistics%1").arg(panel));
  statistics_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  statistics_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  arrange();
  listen();
  showStatistics();
}

void Panel::arrange() {
  auto* foot = new QVBoxLayout;
  foot->setContentsMargins(8, 5, 8, 6);
  auto* line = new QHBoxLayout;
  line->addWidget(violation_, 1);
  line->addWidget(unsettled_);
  foot->addLayout(line);
  makeUnsettled();
  foot->addWidget(statistics_);
  statistics_->hide();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(head_);
  column->addWidget(legend_);
  column->addWidget(view_, 1);
  column->addLayout(foot);
  connect(head_, &PanelHead::leftOver, new StateChips(*view_), &StateChips::setStates);
}

/// Says that relaxation has stopped before it has settled, with a button that continues it.
void Panel::makeUnsettled() {
  distance_->setObjectName(QStringLiteral("unsettled%1").arg(panel_));
  distance_->setToolTip(
      QStringLiteral("Relaxation came no closer to the equilibrium, so it has stopped. At an equilibrium this figure "
                     "is below 0.0001"));
  auto* goOn = new QToolButton;
  goOn->setText(QStringLiteral("Continue"));
  goOn->setObjectName(QStringLiteral("continueRelaxation%1").arg(panel_));
  goOn->setToolTip(QStringLiteral("Begins relaxation again from the present shape, in all panels"));
  auto* row = new QHBoxLayout(unsettled_);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(distance_);
  row->addWidget(goOn);
  unsettled_->hide();
  connect(goOn, &QToolButton::clicked, &document_, &Document::continueRelaxation);
  followTheme(*distance_, [this] {
    QPalette amber = palette();
    amber.setColor(QPalette::WindowText, QColor(colours::warningSign));
    distance_->setPalette(amber);
  });
}

void Panel::listen() {
  connect(&refresh_, &QTimer::timeout, this, &Panel::showStatistics);
  connect(&document_.solvers(), &PanelSolvers::frameReady, this, [this](int ready) {
    if (ready == panel_) {
      busy_.invalidate();
      answered_ = true;
    }
    refreshLater();  // also for other panels: the bar is relative to the worst of them
  });
  connect(&document_, &Document::meshChanged, this, &Panel::showStatistics);
  followWork();
  connect(view_, &View::drawnStepChanged, this, &Panel::refreshLater);
  connect(view_, &View::resized, this, &Panel::refreshLater);
  connect(view_, &View::ghostChanged, this, &Panel::refreshLater);
  connect(&document_, &Document::pinsChanged, this, &Panel::refreshLater);
  connect(&document_, &Document::cutsChanged, this, &Panel::refreshLater);
  connect(&colouring_, &Colouring::modeChanged, this, &Panel::showStatistics);
  connect(&colouring_, &Colouring::changed, this, &Panel::refreshLater);
}

void Panel::refreshLater() {
  if (!refresh_.isActive()) {
    refresh_.start();
  }
}

/// Looks whether the solver works each time it may have begun, and while it does.
void Panel::followWork() {
  late_.setSingleShot(true);
  late_.setInterval(lateMilliseconds);
  connect(&late_, &QTimer::timeout, this, &Panel::showStatistics);
  const auto look = [this] {
    if (!late_.isActive()) {
      late_.start();
    }
  };
  const auto prepares = [this, look] {
    answered_ = false;
    look();
  };
  connect(&document_, &Document::pinsChanged, this, prepares);
  connect(&document_, &Document::cutsChanged, this, prepares);
  connect(&document_, &Document::meshChanged, this, prepares);
  connect(&document_, &Document::algorithmChanged, this, prepares);
  connect(&document_.moves(), &MovePlayer::changed, this, look);
  connect(&document_.highlight(), &Highlight::changed, this, [this, look] {
    const bool grabbed = document_.highlight().marks().grabbed;
    answered_ = answered_ && (grabbed_ || !grabbed);
    grabbed_ = grabbed;
    if (grabbed) {
      look();
    }
  });
}

/// Returns what the solver has been doing for a while without a new frame; usually empty.
QString Panel::work(const Statistics& statistics) {
  if (document_.solvers().idle(panel_)) {
    busy_.invalidate();
    return {};
  }
  if (!busy_.isValid()) {
    busy_.start();
  }
  if (!late_.isActive()) {
    late_.start();
  }
  if (busy_.elapsed() < lateMilliseconds / 2 || statistics.relaxing) {
    return {};
  }
  const double share = document_.solvers().share(panel_);
  return (answered_ ? QStringLiteral("Computing…") : QStringLiteral("Preparing…")) +
         (share > 0 && share < 1 ? QStringLiteral(" %1 %").arg(std::lround(100 * share)) : QString());
}

/// True if the panel's object is not at rest, however it came there: a session may bring positions without moves.
bool Panel::hasMoved(const Statistics& statistics) {
  const Frame& frame = *document_.solvers().frame(panel_);
  if (frame.mesh != movedMesh_) {  // the solver goes on counting when another object replaces the one before
    movedMesh_ = frame.mesh;
    passesBefore_ = statistics.passes;
  }
  const MoveHistory& history = document_.moves().history();  // a session brings moves that this solver has not made
  return statistics.passes != passesBefore_ || document_.cuts().count() > 0 || history.passes(history.position()) > 0 ||
         !frame.is_at_rest;
}

/// Returns the RMS violation of the panel where it is largest.
double Panel::worstViolation() const {
  double worst = 0;
  for (int panel = 0; panel < document_.panels(); ++panel) {
    if (document_.solvers().frame(panel) != nullptr) {
      const double rms = document_.solvers().statistics(panel).violation.rms;
      worst = std::isfinite(rms) ? std::max(worst, rms) : worst;
    }
  }
  return worst;
}

void Panel::refresh() {
  view_->update();
  refreshLater();
}

void Panel::showStatistics() {
  if (const auto legend = view_->overlayLegend()) {
    legend_->show(*legend);
  } else {
    legend_->follow(colouring_, panel_);
  }
  emit legendChanged();
  if (document_.solvers().frame(panel_) == nullptr) {  // what was shown is of another object
    violation_->clear();
    statistics_->clear();
    head_->showStates({});
    return;
  }
  const Statistics& statistics = document_.solvers().statistics(panel_);
  update(statistics);
  head_->showStates(states(statistics));
}

QString Panel::overlayTitle() const {
  const auto legend = view_->overlayLegend();
  return legend ? legend->title : QString();
}

void Panel::showFigures(bool on) {
  statistics_->setVisible(on);
  refresh();
}

void Panel::setLecture(bool on) {
  view_->setLecture(on);
  violation_->setLarge(on);
}

/// Shows the sentence and the figures of the last pass. Uses a shorter text if the panel is narrow.
void Panel::update(const Statistics& statistics) {
  const double worst = worstViolation();
  violation_->show(statistics, {hasMoved(statistics), view_->isInMidPass(), work(statistics), worst});
  const QString help =
      QStringLiteral(
          "The bar is as long as the RMS violation, which weighs how many links are violated and by how\n"
          "much. A full bar is %1 rest lengths: the worst panel, but at least 0.1.\n"
          "Violation: how far links lie outside their valid regions, in rest lengths. The last figure is\n"
          "the share of links above 1e-4 rest lengths.\n")
          .arg(shownNumber(ViolationLine::fullAt(worst), 'g', 2)) +
      QStringLiteral(
          "It is of all links, also during a drag; 'so far' if there was no time for some of those that\n"
          "moved. While the Propagation dock shows a candidate, it is the violation after the whole pass.");
  unsettled_->setVisible(statistics.unsettled && document_.relaxation().on);
  distance_->setText(QStringLiteral("not settled: %1 %2")
                         .arg(statistics.residual ? QStringLiteral("residual") : QStringLiteral("step"),
                              shownNumber(statistics.unsettled.value_or(0), 'g', 2)));
  statistics_->setToolTip(statistics.remark.empty() ? help : QString::fromStdString(statistics.remark));
  violation_->setToolTip(QStringLiteral("%1\n\n%2\n\n%3").arg(violation_->sentence(), inWords(statistics), help));
  statistics_->setText(describe(statistics, false, mostFigures));
  for (qsizetype parts = mostFigures; parts > 0 && statistics_->sizeHint().width() > statistics_->width(); --parts) {
    statistics_->setText(describe(statistics, true, parts));
  }
}

/// Returns the first figures as HTML, in two lines. If the solver reports a problem, its remark replaces the violation.
QString Panel::describe(const Statistics& statistics, bool briefly, qsizetype parts) const {
  const QString dot = QStringLiteral(" · ");
  return describePass(statistics, briefly).mid(0, parts).join(dot) + QStringLiteral("<br>") +
         (statistics.remark.empty() ? describeViolation(statistics, briefly).mid(0, parts).join(dot)
                                    : describeRemark(statistics));
}

/// Returns the figures as plain text.
QString Panel::inWords(const Statistics& statistics) {
  const QString dot = QStringLiteral(" · ");
  QString figures =
      describePass(statistics, false).join(dot) + QLatin1Char('\n') + describeViolation(statistics, false).join(dot);
  figures.remove(QStringLiteral("<b>")).remove(QStringLiteral("</b>"));
  return statistics.remark.empty() ? figures : figures + QLatin1Char('\n') + QString::fromStdString(statistics.remark);
}

QStringList Panel::describePass(const Statistics& statistics, bool briefly) {
  const QLocale locale;
  const bool solved = !info(statistics.algorithm).has_steps();
  const QLatin1String several(statistics.last_pass.checked == 1 ? "" : "s");
  const QString checked = solved    ? QStringLiteral("solved for <b>%1</b> element") + several
                          : briefly ? QStringLiteral("<b>%1</b> checked")
                                    : QStringLiteral("<b>%1</b> link") + several + QStringLiteral(" checked");
  QStringList figures{QStringLiteral("<b>%1</b> moved").arg(locale.toString(qulonglong(statistics.last_pass.moved))),
                      checked.arg(locale.toString(qulonglong(statistics.last_pass.checked))),
                      QStringLiteral("<b>%1</b>").arg(shownTime(statistics.last_pass_ms)) +
                          (briefly ? QString() : QStringLiteral(" per pass"))};
  if (statistics.relaxation_ms > 0) {
    figures << QStringLiteral("<b>%1</b> relaxation").arg(shownTime(statistics.relaxation_ms)) +
                   (briefly ? QString() : QStringLiteral(" per frame"));
  }
  return figures;
}

QStringList Panel::describeViolation(const Statistics& statistics, bool briefly) {
  const MeasuredViolation& violation = statistics.violation;
  const QString of = briefly              ? QString()
                     : violation.is_whole ? QStringLiteral(" of all links:")
                                          : QStringLiteral(" so far:");
  return {QStringLiteral("violation%1 max <b>%2</b>").arg(of, shownNumber(violation.max, 'g', 3)),
          QStringLiteral("RMS <b>%1</b>").arg(shownNumber(violation.rms, 'g', 3)),
          QStringLiteral("<b>%1</b> %").arg(shownNumber(100 * violation.fraction, 'f', 1))};
}

QString Panel::describeRemark(const Statistics& statistics) const {
  const QString remark = QString::fromStdString(statistics.remark);
  return statistics_->fontMetrics().elidedText(remark, Qt::ElideRight, statistics_->width()).toHtmlEscaped();
}

QStringList Panel::states(const Statistics& statistics) const {
  QStringList states;
  if (lacksPins(document_, panel_)) {
    states << QStringLiteral("nothing pinned: no solution");
  }
  if (statistics.last_pass.stopped) {
    states << (statistics.remark.empty() ? QStringLiteral("taut: pins stop the handle")
                                         : QString::fromStdString(statistics.remark));
  }
  if (document_.parts() > 1) {
    states << QStringLiteral("%L1 parts").arg(document_.parts());
  }
  if (!document_.pins().empty()) {
    states << QStringLiteral("%L1 pinned").arg(document_.pins().size());
  }
  if (statistics.estimate) {
    const double percent = 100 * *statistics.estimate;
    states << (percent < 100 ? QStringLiteral("about %1 % from the full equilibrium")
                                   .arg(shownNumber(percent, 'g', percent < 9.5 ? 1 : 2))
                             : QStringLiteral("far from the full equilibrium"));
  } else if (statistics.relaxing) {
    states << (statistics.residual ? QStringLiteral("settling, iteration %L1") : QStringLiteral("relaxing, sweep %L1"))
                  .arg(statistics.sweeps);
  }
  if (const Ghost& ghost = view_->ghost(); ghost.of) {
    states << QStringLiteral("%2 % ghost of %1").arg(panelName(*ghost.of)).arg(std::lround(100 * ghost.blend));
  }
  if (view_->drawnStep() > 1) {
    states << QStringLiteral("1 of %1 links drawn").arg(view_->drawnStep());
  }
  if (view_->leavesLinksOut()) {
    states << QStringLiteral("zoom in to see links");
  }
  return states + view_->notes();
}

void Panel::drawIn(QPainter& painter, const QColor& ground, std::optional<double> pixelRatio, bool legend) {
  painter.fillRect(rect(), ground);
  painter.setFont(font());
  drawAt(painter, head_->geometry(), [&] { drawHead(painter); });
  drawAt(painter, view_->geometry(), [&] {
    pixelRatio ? painter.drawImage(QPoint(), view_->picture(*pixelRatio, true)) : view_->drawIn(painter, ground);
  });
  if (legend ? legend_->isWanted() : legend_->isVisibleTo(this)) {
    const QPoint at = legend_->isVisibleTo(this) ? legend_->pos() : view_->pos();
    const int height = legend ? legend_->wholeHeight() : legend_->height();
    drawAt(painter, QRect(at, QSize(width(), height)), [&] { legend_->draw(painter); });
  }
  drawAt(painter, violation_->geometry(), [&] {
    painter.setPen(QColor(ink));
    painter.drawText(QRect(QPoint(), violation_->size()), Qt::AlignLeft | Qt::AlignVCenter, violation_->sentence());
  });
  if (statistics_->isVisibleTo(this)) {
    drawAt(painter, statistics_->geometry(), [&] { drawStatistics(painter); });
  }
}

/// Draws the colour and the letter of the panel and the name of its algorithm.
void Panel::drawHead(QPainter& painter) const {
  const QRect whole = QRect(QPoint(), head_->size()).adjusted(printMargin, 0, -printMargin, 0);
  const int swatch = fontMetrics().ascent();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(panelColour(document_, panel_)));
  painter.drawEllipse(QRect(whole.left(), whole.center().y() - swatch / 2, swatch, swatch));
  const QRect line = whole.adjusted(swatch + printMargin, 0, 0, 0);
  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  painter.setPen(QColor(ink));
  QRect letter;
  painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, panelName(panel_), &letter);
  painter.setFont(font());
  painter.drawText(line.adjusted(letter.width() + printMargin, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter,
                   text(info(document_.algorithm(panel_)).label));
}

void Panel::drawStatistics(QPainter& painter) const {
  QTextDocument figures;
  figures.setDefaultFont(font());
  figures.setDocumentMargin(0);
  figures.setDefaultStyleSheet(QStringLiteral("p { color: %1 }").arg(QColor(ink).name()));
  figures.setHtml(QStringLiteral("<p>%1</p>").arg(statistics_->text()));
  figures.drawContents(&painter);
}

}  // namespace chainmail
