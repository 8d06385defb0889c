// The order of this file: modes, changes that make values outdated, computing in slices, single values, scales, titles.

#include "panels/colouring.h"

#include <QElapsedTimer>
#include <algorithm>

#include "common/text.h"
#include "measure/violation.h"

namespace chainmail {
namespace {

constexpr int sliceIntervalMilliseconds = 16;
constexpr int sliceMilliseconds = 4;  // per panel and interval; drawing and dragging need the rest of the time
constexpr std::size_t valuesPerClockCheck = 4096;
// In rest lengths, as in the figures below the panels. Smaller violations are rounding errors.
constexpr float violationThreshold = 1e-4F;
constexpr float logarithmicSpan = 1000;  // of a logarithmic scale whose lowest value is not positive

constexpr float unlimited = std::numeric_limits<float>::infinity();
constexpr std::array modeInfos{
    ColourModeInfo{ColourMode::plain, "plain", "Plain", "", "", "Each object has the colour of its panel"},
    ColourModeInfo{ColourMode::compression, "compression", "Limit of compression", "Limit of compression",
                   "of rest length", "How short a link may become, divided by its rest length", 0, 1},
    ColourModeInfo{ColourMode::stretch, "stretch", "Limit of stretch", "Limit of stretch", "of rest length",
                   "How long a link may become, divided by its rest length", 1},
    ColourModeInfo{ColourMode::shear, "shear", "Limit of shear", "Limit of shear", "of length along the other axes",
                   "How far a link may lean along an axis, divided by its rest length along the other axes"},
    ColourModeInfo{ColourMode::length, "length", "Length / rest length", "Length of links, live", "of rest length",
                   "The length of a link now, divided by its rest length", 0, unlimited, 1},
    ColourModeInfo{ColourMode::violation, "violation", "Violation of links", "Violation, live", "rest lengths",
                   "How far a link lies outside its valid region, divided by its rest length"},
    ColourModeInfo{ColourMode::distance, "distance", "Distance between panels", "Distance", "mean rest lengths",
                   "The distance between the positions of an element in two panels, divided by the mean rest length"},
    ColourModeInfo{ColourMode::violationDifference, "violationDifference", "Violation, difference of panels",
                   "Violation", "rest lengths", "The violation of a link in one panel minus that in another",
                   -unlimited},
    ColourModeInfo{ColourMode::physicsError, "truth", "Error against physics", "Error against physics",
                   "of the handle's displacement",
                   "The distance of an element from its position in the reference solution, divided by the "
                   "displacement of the handle"},
};

bool isOfElements(ColourMode mode) { return mode == ColourMode::distance || mode == ColourMode::physicsError; }

bool isOfSoftness(ColourMode mode) {
  return mode == ColourMode::compression || mode == ColourMode::stretch || mode == ColourMode::shear;
}

/// True if a panel's values depend on its own frame alone.
bool followsFrame(ColourMode mode) {
  return mode == ColourMode::length || mode == ColourMode::violation || mode == ColourMode::physicsError;
}

}  // namespace

// Modes

std::span<const ColourModeInfo> colourModes() { return modeInfos; }

const ColourModeInfo& info(ColourMode mode) {
  return *std::find_if(modeInfos.begin(), modeInfos.end(), [mode](auto& one) { return one.mode == mode; });
}

bool isDiverging(ColourMode mode) { return mode == ColourMode::length || mode == ColourMode::violationDifference; }

bool comparesPanels(ColourMode mode) { return mode == ColourMode::distance || mode == ColourMode::violationDifference; }

Colouring::Colouring(const Document& document) : document_(document), solution_(document), timer_(this) {
  timer_.setInterval(sliceIntervalMilliseconds);
  connect(&timer_, &QTimer::timeout, this, &Colouring::advanceAll);
  connect(&document.solvers(), &PanelSolvers::frameReady, this, &Colouring::receiveFrame);
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
  connect(&solution_, &BackgroundReference::changed, this, &Colouring::followSolution);
}

void Colouring::setMode(ColourMode mode) {
  if (mode != mode_) {
    mode_ = mode;
    solution_.setWanted(mode == ColourMode::physicsError);
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
    emit modeChanged();  // for the legends
  }
}

void Colouring::setRange(ColourMode mode, const ColourRange& range) {
  if (range != ranges_[std::size_t(mode)]) {
    ranges_[std::size_t(mode)] = range;
    updateScales();
    emit modeChanged();  // for the legends
  }
}

// Changes

void Colouring::receiveFrame(int panel) {
  if (followsFrame(mode_)) {
    works_[panel].outdated = true;
    if (mode_ == ColourMode::violation) {
      updateScales();
    }
  } else if (comparesPanels(mode_)) {
    for (Work& work : works_) {
      work.outdated = true;
    }
    emit changed();  // the colours of the other panels depend on this frame too
  }
}

/// Drops values that were computed with an older reference solution.
void Colouring::followSolution() {
  if (mode_ == ColourMode::physicsError) {
    startOver();
    emit changed();
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

void Colouring::startOver() {
  timer_.stop();
  works_ = {};
  scales_ = {};
}

// Computing in slices

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

/// Starts to compute the values of a panel: copies everything that they depend on. Returns false while a required frame
/// or the reference solution is missing. If memory runs out, the values are outdated as before.
bool Colouring::start(int panel) {
  Work& work = works_[panel];
  work.others = comparedWith(panel);
  std::vector<int> all = work.others;
  all.push_back(panel);
  if (std::any_of(all.begin(), all.end(), [this](int one) { return document_.solvers().frame(one) == nullptr; }) ||
      (mode_ == ColourMode::physicsError && !solution_.answer())) {
    return false;
  }
  const Mesh& mesh = *document_.mesh();
  work.next = 0;
  work.squares = 0;
  work.building.mesh = document_.mesh();
  work.building.ofLinks = !isOfElements(mode_);
  work.building.values.resize(work.building.ofLinks ? mesh.link_count() : mesh.element_count());
  work.building.atElements.assign(work.building.ofLinks && mesh.space_dimension == 3 ? mesh.element_count() : 0,
                                  info(mode_).centre);
  work.building.lowest = unlimited;
  work.building.highest = -unlimited;
  work.softness = document_.wholeSoftness();
  work.solution = solution_.answer();
  for (const int one : all) {
    if (!isOfSoftness(mode_)) {
      work.copies[one].follow(*document_.solvers().frame(one));
    }
  }
  work.outdated = false;
  work.running = true;
  return true;
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

void Colouring::Copy::follow(const Frame& frame) {
  if (number == 0 || series != frame.series) {
    positions = frame.positions;
    number = frame.number;
    series = frame.series;
    space = frame.space;
    return;
  }
  const std::size_t perBlock = std::size_t{Frame::block_elements} * frame.mesh->space_dimension;
  for (std::size_t block = 0; block < frame.changed.size(); ++block) {
    if (frame.changed[block] > number) {
      const std::size_t first = block * perBlock, count = std::min(perBlock, positions.size() - first);
      std::copy_n(frame.positions.data() + first, count, positions.data() + first);
    }
  }
  number = frame.number;
}

void Colouring::advanceAll() {
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

void Colouring::advance(int panel) {
  QElapsedTimer clock;
  clock.start();
  Work& work = works_[panel];
  ColourValues& building = work.building;
  while (work.next < building.values.size() && clock.elapsed() < sliceMilliseconds) {
    const std::size_t end = std::min(work.next + valuesPerClockCheck, building.values.size());
    for (; work.next < end; ++work.next) {
      const bool counts = !building.ofLinks || !document_.cuts().is_cut(LinkId(work.next));
      const float one = counts ? value(panel, work.next) : 0;
      building.values[work.next] = one;
      if (counts) {
        take(work, work.next, one);
      }
    }
  }
  if (work.next == building.values.size()) {
    finish(work);
  }
}

/// Takes a value into the range, the sum, and the values of the faces.
void Colouring::take(Work& work, std::size_t i, float value) const {
  ColourValues& building = work.building;
  work.squares += double(value) * double(value);
  building.lowest = std::min(building.lowest, value);
  building.highest = std::max(building.highest, value);
  if (!building.atElements.empty()) {
    const float centre = info(mode_).centre;
    for (const ElementId end : building.mesh->links[i]) {
      float& largest = building.atElements[end];
      largest = std::abs(value - centre) > std::abs(largest - centre) ? value : largest;
    }
  }
}

void Colouring::finish(Work& work) {
  work.running = false;
  work.rms = std::sqrt(work.squares / double(std::max<std::size_t>(1, work.building.values.size())));
  work.building.number = ++number_;
  std::swap(work.building, work.shown);
  updateScales();
}

// Single values

float Colouring::value(int panel, std::size_t i) const {
  const Work& work = works_[panel];
  switch (mode_) {
    case ColourMode::compression:
      return float(work.softness->of(LinkId(i)).compression);
    case ColourMode::stretch:
      return float(work.softness->of(LinkId(i)).stretch);
    case ColourMode::shear:
      return float(work.softness->of(LinkId(i)).shear);
    case ColourMode::length:
      return length(work, panel, LinkId(i));
    case ColourMode::violation:
      return violation(work, panel, LinkId(i));
    case ColourMode::physicsError:
      return physicsError(work, panel, ElementId(i));
    default:
      break;
  }
  float furthest = 0;
  for (const int other : work.others) {
    const float one = mode_ == ColourMode::distance
                          ? distance(work, panel, other, ElementId(i))
                          : violation(work, panel, LinkId(i)) - violation(work, other, LinkId(i));
    furthest = std::abs(one) > std::abs(furthest) ? one : furthest;
  }
  return furthest;
}

float Colouring::violation(const Work& work, int panel, LinkId link) const {
  const Mesh& mesh = *work.building.mesh;
  const PositionView positions = work.copies[panel].space.view(work.copies[panel].positions);
  return float(link_violation(mesh, *work.softness, positions, link));
}

/// Returns the length of a link as a fraction of its rest length. A link without a rest length counts as one of mean
/// length, as for the violation.
float Colouring::length(const Work& work, int panel, LinkId link) const {
  const Mesh& mesh = *work.building.mesh;
  const PositionView positions = work.copies[panel].space.view(work.copies[panel].positions);
  const auto [a, b] = mesh.links[link];
  const double now = (point_of(mesh, positions, b) - point_of(mesh, positions, a)).norm(),
               rest = rest_length(mesh, link);
  return float(rest > 0 ? now / rest : mesh.mean_link_length > 0 ? 1 + now / mesh.mean_link_length : 1);
}

float Colouring::distance(const Work& work, int panel, int other, ElementId element) const {
  const Mesh& mesh = *work.building.mesh;
  double squared = 0;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    const std::size_t at = std::size_t{element} * std::size_t(mesh.space_dimension) + std::size_t(k);
    const double apart = double(work.copies[panel].positions[at]) - double(work.copies[other].positions[at]);
    squared += apart * apart;
  }
  const double unit = work.copies[panel].space.unit();
  return mesh.mean_link_length > 0 ? float(std::sqrt(squared) * unit / mesh.mean_link_length) : 0;
}

/// Returns the distance of an element from its position in the reference solution, as a fraction of the handle's
/// displacement.
float Colouring::physicsError(const Work& work, int panel, ElementId element) const {
  const Mesh& mesh = *work.building.mesh;
  const PositionView positions = work.copies[panel].space.view(work.copies[panel].positions);
  double squared = 0;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    const std::size_t at = std::size_t{element} * std::size_t(mesh.space_dimension) + std::size_t(k);
    const double apart = positions(element, k) - mesh.rest[at] - work.solution->solution.displacements[at];
    squared += apart * apart;
  }
  return float(std::sqrt(squared) / work.solution->solution.handle_displacement);
}

// Scales and titles

/// Returns the highest value of a panel. The largest violation is that of the statistics, which the window also shows
/// in words; the colours may be of a frame before.
float Colouring::highestOf(int panel) const {
  const Frame* frame = mode_ == ColourMode::violation ? document_.solvers().frame(panel) : nullptr;
  return frame != nullptr && frame->statistics.violation.links > 0 ? float(frame->statistics.violation.max)
                                                                   : works_[std::size_t(panel)].shown.highest;
}

void Colouring::updateScales() {
  std::array<ColourScale, Document::maxPanels> scales;
  ColourScale all;
  for (std::size_t panel = 0; panel < works_.size(); ++panel) {
    const ColourValues& shown = works_[panel].shown;
    if (shown.number != 0 && shown.lowest <= shown.highest) {
      const float highest = highestOf(int(panel));
      all.lowest = all.known() ? std::min(all.lowest, shown.lowest) : shown.lowest;
      all.highest = all.known() ? std::max(all.highest, highest) : highest;
      scales[panel].lowest = shown.lowest;
      scales[panel].highest = highest;
    }
  }
  for (ColourScale& scale : scales) {
    scale = ranged(finished(sharesScale_ ? all : scale));
  }
  if (scales != scales_) {
    scales_ = scales;
    emit changed();  // the other panels use the shared scale too
  }
}

/// Returns `scale` with the range and threshold that the mode requires.
ColourScale Colouring::finished(ColourScale scale) const {
  if (mode_ == ColourMode::violation) {
    scale.lowest = scale.threshold = violationThreshold;
    scale.highest = std::max(scale.highest, violationThreshold);
  } else if (isDiverging(mode_) && scale.known()) {
    scale.diverging = true;
    scale.centre = info(mode_).centre;
    scale.threshold = violationThreshold;
    const float off = std::max({scale.centre - scale.lowest, scale.highest - scale.centre, violationThreshold});
    scale.lowest = scale.centre - off;
    scale.highest = scale.centre + off;
  } else if (mode_ == ColourMode::distance || (mode_ == ColourMode::physicsError && scale.known())) {
    scale.lowest = 0;
  }
  return scale;
}

/// Returns `scale` with the range that the user has chosen. A logarithmic scale begins at the threshold, or at a
/// thousandth of the highest value.
ColourScale Colouring::ranged(ColourScale scale) const {
  if (!scale.known()) {
    return scale;
  }
  if (range().kind == ColourRange::Kind::fixed) {
    scale.lowest = float(range().lowest);
    scale.highest = float(range().highest);
    if (scale.diverging) {  // both sides are equally long
      const float off = std::max(std::abs(scale.lowest - scale.centre), std::abs(scale.highest - scale.centre));
      scale.lowest = scale.centre - off;
      scale.highest = scale.centre + off;
    }
  } else if (range().kind == ColourRange::Kind::logarithmic && !scale.diverging && scale.highest > 0) {
    scale.logarithmic = true;
    scale.lowest = scale.lowest > 0 ? scale.lowest : scale.highest / logarithmicSpan;
  }
  scale.lowest = std::max(scale.lowest, info(mode_).least);
  scale.highest = std::max(std::min(scale.highest, info(mode_).most), scale.lowest);
  return scale;
}

QString Colouring::title() const {
  return QStringLiteral("%1 (%2)").arg(text(info(mode_).title), text(info(mode_).unit));
}

QString Colouring::title(int panel) const {
  const auto& mode = info(mode_);
  QString what = text(mode.title);
  if (mode_ == ColourMode::physicsError && !solution_.answer()) {
    return QStringLiteral("%1: %2").arg(what, solution_.state());
  }
  if (mode_ == ColourMode::physicsError && works_[panel].shown.number != 0) {
    return errorText(works_[panel]) + title();
  }
  if (comparesPanels(mode_)) {
    const auto others = comparedWith(panel);
    const bool distance = mode_ == ColourMode::distance;
    const QString other = others.size() == 1 ? panelName(others.front())
                          : distance         ? QStringLiteral("the furthest other panel")
                                             : QStringLiteral("the panel that differs most");
    what = distance ? QStringLiteral("%1 from %2").arg(what, other)
                    : QStringLiteral("%1, %2 minus %3").arg(what, panelName(panel), other);
  }
  return QStringLiteral("%1 (%2)").arg(what, text(mode.unit));
}

/// Returns the errors of a panel as text, in parts of which a narrow legend shows the first ones. The relative error is
/// divided by the RMS displacement of the reference solution, so it is about 1 for an object that does not move.
QString Colouring::errorText(const Work& work) const {
  const BackgroundReference::Answer& answer = *solution_.answer();
  return QStringLiteral("%1 relative error on the same cells · %2 if nothing moves · %3 RMS · ")
      .arg(shownNumber(work.rms * answer.solution.handle_displacement / answer.rms, 'g', 3),
           shownNumber(answer.nothing, 'g', 3), shownNumber(work.rms, 'g', 3));
}

}  // namespace chainmail
