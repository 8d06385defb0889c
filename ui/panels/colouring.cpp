#include "panels/colouring.h"

#include <QLocale>
#include <algorithm>
#include <cmath>

#include "common/panel_names.h"
#include "common/text.h"

namespace chainmail {
namespace {

constexpr int intervalMilliseconds = 16;
// As in the figures below the panels: smaller violations are rounding.
constexpr float violationThreshold = 1e-4F;

constexpr std::array infos{
    ColourModeInfo{ColourMode::plain, "plain", "Plain", "", ""},
    ColourModeInfo{ColourMode::compression, "compression", "Compression of links", "Compression", "of rest length"},
    ColourModeInfo{ColourMode::stretch, "stretch", "Stretch of links", "Stretch", "of rest length"},
    ColourModeInfo{ColourMode::shear, "shear", "Shear of links", "Shear", "of rest length"},
    ColourModeInfo{ColourMode::violation, "violation", "Violation of links", "Violation, live", "rest lengths"},
    ColourModeInfo{ColourMode::distance, "distance", "Distance between panels", "Distance", "mean rest lengths"},
    ColourModeInfo{ColourMode::violationDifference, "violationDifference", "Violation, difference of panels",
                   "Violation", "rest lengths"},
    ColourModeInfo{ColourMode::truth, "truth", "Error against physics", "Error against physics",
                   "of the handle's displacement"},
};

}  // namespace

std::span<const ColourModeInfo> colourModes() { return infos; }

const ColourModeInfo& info(ColourMode mode) {
  return *std::find_if(infos.begin(), infos.end(), [mode](auto& one) { return one.mode == mode; });
}

bool comparesPanels(ColourMode mode) { return mode == ColourMode::distance || mode == ColourMode::violationDifference; }

Colouring::Colouring(const Document& document) : document_(document), truth_(document), timer_(this) {
  timer_.setInterval(intervalMilliseconds);
  connect(&timer_, &QTimer::timeout, this, &Colouring::goOn);
  connect(&document, &Document::frameReady, this, &Colouring::receiveFrame);
  const auto outdate = [this] {
    for (Work& work : works_) {
      work.outdated = true;
    }
    if (mode_ != ColourMode::plain) {
      emit changed();
    }
  };
  connect(&document, &Document::softnessChanged, this, outdate);
  connect(&document, &Document::cutsChanged, this, outdate);
  connect(&document, &Document::meshChanged, this, &Colouring::startOver);
  connect(&document, &Document::panelsChanged, this, &Colouring::followPanels);
  connect(&truth_, &BackgroundReference::changed, this, &Colouring::followTruth);
}

void Colouring::receiveFrame(int panel) {
  if (mode_ == ColourMode::violation || mode_ == ColourMode::truth) {
    works_[panel].outdated = true;
  } else if (comparesPanels(mode_)) {
    for (Work& work : works_) {
      work.outdated = true;
    }
    emit changed();  // the other panels' colours follow from this frame too
  }
}

/// What was told of another truth is not shown any more.
void Colouring::followTruth() {
  if (mode_ == ColourMode::truth) {
    startOver();
    emit changed();
  }
}

void Colouring::setMode(ColourMode mode) {
  if (mode != mode_) {
    mode_ = mode;
    truth_.setWanted(mode == ColourMode::truth);
    startOver();
    emit modeChanged();
    emit changed();
  }
}

void Colouring::setReference(int panel) {
  if (panel != reference_) {
    reference_ = panel;
    startOver();
    emit modeChanged();
    emit changed();
  }
}

void Colouring::setSharesScale(bool shares) {
  if (shares != sharesScale_) {
    sharesScale_ = shares;
    updateScales();
    emit modeChanged();  // the legends say so
  }
}

void Colouring::followPanels() {
  if (reference_ >= document_.panels()) {
    reference_ = 0;
  }
  startOver();
  emit modeChanged();
  emit changed();
}

void Colouring::forget(int panel) {
  works_[panel] = {};
  updateScales();
}

QString Colouring::title(int panel) const {
  const auto& mode = info(mode_);
  QString what = text(mode.title);
  if (mode_ == ColourMode::truth && !truth_.answer()) {
    return QStringLiteral("%1: %2").arg(what, truth_.state());
  }
  if (mode_ == ColourMode::truth && works_[panel].shown.number != 0) {
    what += errorInWords(works_[panel]);
  }
  if (comparesPanels(mode_)) {
    const auto others = comparedWith(panel);
    const bool distance = mode_ == ColourMode::distance;
    const QString other = others.size() == 1 ? panelName(others.front())
                          : distance         ? QStringLiteral("the furthest of the others")
                                             : QStringLiteral("the one that differs most");
    what = distance ? QStringLiteral("%1 from %2").arg(what, other)
                    : QStringLiteral("%1, %2 less that of %3").arg(what, panelName(panel), other);
  }
  return QStringLiteral("%1 (%2)").arg(what, text(mode.unit));
}

/// The error of a panel, first over what the reference itself moves: an object that does not move has about 1 of that.
QString Colouring::errorInWords(const Work& work) const {
  const BackgroundReference::Answer& answer = *truth_.answer();
  const QLocale locale;
  return QStringLiteral(" on the same cells: relative %1, nothing moves %2; RMS %3")
      .arg(locale.toString(work.rms * answer.solution.handle_displacement / answer.rms, 'g', 3),
           locale.toString(answer.nothing, 'g', 3), locale.toString(work.rms, 'g', 3));
}

void Colouring::startOver() {
  timer_.stop();
  works_ = {};
  scales_ = {};
}

const ColourValues* Colouring::follow(int panel) {
  if (mode_ == ColourMode::plain) {
    return nullptr;
  }
  Work& work = works_[panel];
  if (work.outdated && !work.running && start(panel)) {
    advance(panel);
    if (work.running && !timer_.isActive()) {
      timer_.start();
    }
  }
  return work.shown.number != 0 ? &work.shown : nullptr;
}

std::vector<int> Colouring::comparedWith(int panel) const {
  std::vector<int> others;
  for (int other = 0; comparesPanels(mode_) && other < document_.panels(); ++other) {
    if (other != panel && (panel == reference_ || other == reference_)) {
      others.push_back(other);
    }
  }
  return others;
}

void Colouring::goOn() {
  bool running = false, finished = false;
  for (int panel = 0; panel < document_.panels(); ++panel) {
    if (works_[panel].running) {
      advance(panel);
      running = running || works_[panel].running;
      finished = finished || !works_[panel].running;
    }
  }
  if (!running) {
    timer_.stop();
  }
  if (finished) {
    emit changed();
  }
}

void Colouring::updateScales() {
  std::array<ColourScale, Document::mostPanels> scales;
  ColourScale all;
  for (std::size_t panel = 0; panel < works_.size(); ++panel) {
    const ColourValues& shown = works_[panel].shown;
    if (shown.number != 0 && shown.lowest <= shown.highest) {
      all.lowest = all.known() ? std::min(all.lowest, shown.lowest) : shown.lowest;
      all.highest = std::max(all.highest, shown.highest);
      scales[panel].lowest = shown.lowest;
      scales[panel].highest = shown.highest;
    }
  }
  for (ColourScale& scale : scales) {
    scale = finished(sharesScale_ ? all : scale);
  }
  if (scales != scales_) {
    scales_ = scales;
    emit changed();  // the other panels are painted by it too
  }
}

/// The values' own range, as the mode widens it.
ColourScale Colouring::finished(ColourScale scale) const {
  if (mode_ == ColourMode::violation) {
    scale.lowest = scale.threshold = violationThreshold;
    scale.highest = std::max(scale.highest, violationThreshold);
  } else if (mode_ == ColourMode::distance || (mode_ == ColourMode::truth && scale.known())) {
    scale.lowest = 0;
  } else if (mode_ == ColourMode::violationDifference && scale.known()) {
    scale.diverging = true;
    scale.threshold = violationThreshold;
    scale.highest = std::max({std::abs(scale.lowest), std::abs(scale.highest), violationThreshold});
    scale.lowest = -scale.highest;
  }
  return scale;
}

}  // namespace chainmail
