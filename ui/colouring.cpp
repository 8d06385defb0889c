#include "colouring.h"

#include <QElapsedTimer>
#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/violation.h"

namespace chainmail {
namespace {

// Of each panel, in each interval: the rest of the time belongs to drawing and to the hand.
constexpr int sliceMilliseconds = 4;
constexpr int intervalMilliseconds = 16;
constexpr std::size_t valuesBetweenLooks = 4096;  // at the clock
// As in the figures below the panels: smaller violations are rounding.
constexpr float violationThreshold = 1e-4F;

constexpr std::array infos{
    ColourModeInfo{ColourMode::plain, "plain", "Plain", "", ""},
    ColourModeInfo{ColourMode::compression, "compression", "Compression of links", "Compression", "of rest length"},
    ColourModeInfo{ColourMode::stretch, "stretch", "Stretch of links", "Stretch", "of rest length"},
    ColourModeInfo{ColourMode::shear, "shear", "Shear of links", "Shear", "of rest length"},
    ColourModeInfo{ColourMode::violation, "violation", "Violation of links", "Violation, live", "rest lengths"},
    ColourModeInfo{ColourMode::distance, "distance", "Distance between panels", "Distance between the panels",
                   "mean rest lengths"},
};

bool isOfSoftness(ColourMode mode) {
  return mode == ColourMode::compression || mode == ColourMode::stretch || mode == ColourMode::shear;
}

}  // namespace

std::span<const ColourModeInfo> colourModes() { return infos; }

const ColourModeInfo& info(ColourMode mode) {
  return *std::find_if(infos.begin(), infos.end(), [mode](auto& one) { return one.mode == mode; });
}

Colouring::Colouring(const Document& document) : document_(document) {
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
}

void Colouring::Kept::follow(const Frame& frame) {
  if (number == 0) {
    positions = frame.positions;
  }
  const std::size_t perBlock = std::size_t{Frame::block_elements} * frame.mesh->space_dimension;
  for (std::size_t block = 0; number != 0 && block < frame.changed.size(); ++block) {
    if (frame.changed[block] > number) {
      const std::size_t first = block * perBlock, count = std::min(perBlock, positions.size() - first);
      std::copy_n(frame.positions.data() + first, count, positions.data() + first);
    }
  }
  number = frame.number;
}

void Colouring::receiveFrame(int panel) {
  if (mode_ == ColourMode::violation) {
    works_[panel].outdated = true;
  } else if (mode_ == ColourMode::distance) {
    for (Work& work : works_) {
      work.outdated = true;
    }
    emit changed();  // the other panel's colours follow from this frame too
  }
}

void Colouring::setMode(ColourMode mode) {
  if (mode != mode_) {
    mode_ = mode;
    startOver();
    emit modeChanged();
    emit changed();
  }
}

void Colouring::startOver() {
  timer_.stop();
  for (Work& work : works_) {
    work = {};
  }
  scale_ = {};
}

const ColourValues* Colouring::follow(int panel) {
  if (mode_ == ColourMode::plain) {
    return nullptr;
  }
  Work& work = works_[panel];
  if (work.outdated && !work.running && start(panel)) {
    advance(work);
    if (work.running && !timer_.isActive()) {
      timer_.start();
    }
  }
  return work.shown.number != 0 ? &work.shown : nullptr;
}

/// Takes what the values follow from. Returns false while a panel has no frame of the object yet.
bool Colouring::start(int panel) {
  const Frame* frame = document_.frame(panel);
  const Frame* other = document_.frame(1 - panel);
  if (frame == nullptr || (mode_ == ColourMode::distance && other == nullptr)) {
    return false;
  }
  Work& work = works_[panel];
  work.outdated = false;
  work.running = true;
  work.next = 0;
  work.building.mesh = frame->mesh;
  work.building.ofLinks = mode_ != ColourMode::distance;
  work.building.values.resize(work.building.ofLinks ? frame->mesh->link_count() : frame->mesh->element_count());
  work.building.lowest = std::numeric_limits<float>::max();
  work.building.highest = 0;
  work.softness = document_.wholeSoftness();
  if (!isOfSoftness(mode_)) {
    work.own.follow(*frame);
  }
  if (mode_ == ColourMode::distance) {
    work.other.follow(*other);
  }
  return true;
}

void Colouring::advance(Work& work) {
  QElapsedTimer clock;
  clock.start();
  ColourValues& building = work.building;
  while (work.next < building.values.size() && clock.elapsed() < sliceMilliseconds) {
    const std::size_t end = std::min(work.next + valuesBetweenLooks, building.values.size());
    for (; work.next < end; ++work.next) {
      const bool counts = !building.ofLinks || !document_.cuts().is_cut(LinkId(work.next));
      const float one = counts ? value(work, work.next) : 0;
      building.values[work.next] = one;
      if (counts) {
        building.lowest = std::min(building.lowest, one);
        building.highest = std::max(building.highest, one);
      }
    }
  }
  if (work.next == building.values.size()) {
    finish(work);
  }
}

void Colouring::finish(Work& work) {
  work.running = false;
  work.building.number = ++number_;
  std::swap(work.building, work.shown);
  updateScale();
}

float Colouring::value(const Work& work, std::size_t i) const {
  const Mesh& mesh = *work.building.mesh;
  switch (mode_) {
    case ColourMode::compression:
      return float(work.softness->of(LinkId(i)).compression);
    case ColourMode::stretch:
      return float(work.softness->of(LinkId(i)).stretch);
    case ColourMode::shear:
      return float(work.softness->of(LinkId(i)).shear);
    case ColourMode::violation: {
      const PositionView positions(work.own.positions.data(), mesh.space_dimension * sizeof(float),
                                   Precision::single_precision);
      return float(link_violation(mesh, *work.softness, positions, LinkId(i)));
    }
    default:
      break;
  }
  double squared = 0;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    const std::size_t at = i * std::size_t(mesh.space_dimension) + std::size_t(k);
    const double apart = double(work.own.positions[at]) - double(work.other.positions[at]);
    squared += apart * apart;
  }
  return mesh.mean_link_length > 0 ? float(std::sqrt(squared) / mesh.mean_link_length) : 0;
}

void Colouring::goOn() {
  bool running = false, finished = false;
  for (Work& work : works_) {
    if (work.running) {
      advance(work);
      running = running || work.running;
      finished = finished || !work.running;
    }
  }
  if (!running) {
    timer_.stop();
  }
  if (finished) {
    emit changed();
  }
}

void Colouring::updateScale() {
  ColourScale scale;
  for (const Work& work : works_) {
    if (work.shown.number != 0 && work.shown.lowest <= work.shown.highest) {
      scale.lowest = scale.known() ? std::min(scale.lowest, work.shown.lowest) : work.shown.lowest;
      scale.highest = std::max(scale.highest, work.shown.highest);
    }
  }
  if (mode_ == ColourMode::violation) {
    scale.lowest = scale.threshold = violationThreshold;
    scale.highest = std::max(scale.highest, violationThreshold);
  } else if (mode_ == ColourMode::distance) {
    scale.lowest = 0;
  }
  if (scale != scale_) {
    scale_ = scale;
    emit changed();  // the other panel is painted by it too
  }
}

}  // namespace chainmail
