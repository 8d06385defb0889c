// How the values of a panel are worked out, slice by slice.

#include <QElapsedTimer>
#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/violation.h"
#include "panels/colouring.h"

namespace chainmail {
namespace {

// Of each panel, in each interval: the rest of the time belongs to drawing and to the hand.
constexpr int sliceMilliseconds = 4;
constexpr std::size_t valuesBetweenLooks = 4096;  // at the clock

bool isOfElements(ColourMode mode) { return mode == ColourMode::distance || mode == ColourMode::truth; }

bool isOfSoftness(ColourMode mode) {
  return mode == ColourMode::compression || mode == ColourMode::stretch || mode == ColourMode::shear;
}

}  // namespace

void Colouring::Kept::follow(const Frame& frame) {
  if (number == 0 || series != frame.series) {
    positions = frame.positions;
    number = frame.number;
    series = frame.series;
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

/// Takes what the values follow from. Returns false while a panel has no frame of the object yet.
bool Colouring::start(int panel) {
  Work& work = works_[panel];
  work.others = comparedWith(panel);
  std::vector<int> all = work.others;
  all.push_back(panel);
  if (std::any_of(all.begin(), all.end(), [this](int one) { return document_.frame(one) == nullptr; }) ||
      (mode_ == ColourMode::truth && !truth_.answer())) {
    return false;
  }
  const Mesh& mesh = *document_.mesh();
  work.outdated = false;
  work.running = true;
  work.next = 0;
  work.squares = 0;
  work.building.mesh = document_.mesh();
  work.building.ofLinks = !isOfElements(mode_);
  work.building.values.resize(work.building.ofLinks ? mesh.link_count() : mesh.element_count());
  work.building.lowest = std::numeric_limits<float>::max();
  work.building.highest = 0;
  work.softness = document_.wholeSoftness();
  work.truth = truth_.answer();
  for (const int one : all) {
    if (!isOfSoftness(mode_)) {
      work.kept[one].follow(*document_.frame(one));
    }
  }
  return true;
}

void Colouring::advance(int panel) {
  QElapsedTimer clock;
  clock.start();
  Work& work = works_[panel];
  ColourValues& building = work.building;
  while (work.next < building.values.size() && clock.elapsed() < sliceMilliseconds) {
    const std::size_t end = std::min(work.next + valuesBetweenLooks, building.values.size());
    for (; work.next < end; ++work.next) {
      const bool counts = !building.ofLinks || !document_.cuts().is_cut(LinkId(work.next));
      const float one = counts ? value(panel, work.next) : 0;
      building.values[work.next] = one;
      if (counts) {
        work.squares += double(one) * double(one);
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
  work.rms = std::sqrt(work.squares / double(std::max<std::size_t>(1, work.building.values.size())));
  work.building.number = ++number_;
  std::swap(work.building, work.shown);
  updateScales();
}

float Colouring::value(int panel, std::size_t i) const {
  const Work& work = works_[panel];
  switch (mode_) {
    case ColourMode::compression:
      return float(work.softness->of(LinkId(i)).compression);
    case ColourMode::stretch:
      return float(work.softness->of(LinkId(i)).stretch);
    case ColourMode::shear:
      return float(work.softness->of(LinkId(i)).shear);
    case ColourMode::violation:
      return violation(work, panel, LinkId(i));
    case ColourMode::truth:
      return error(work, panel, ElementId(i));
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
  const PositionView positions(work.kept[panel].positions.data(), mesh.space_dimension * sizeof(float),
                               Precision::single_precision);
  return float(link_violation(mesh, *work.softness, positions, link));
}

float Colouring::distance(const Work& work, int panel, int other, ElementId element) const {
  const Mesh& mesh = *work.building.mesh;
  double squared = 0;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    const std::size_t at = std::size_t{element} * std::size_t(mesh.space_dimension) + std::size_t(k);
    const double apart = double(work.kept[panel].positions[at]) - double(work.kept[other].positions[at]);
    squared += apart * apart;
  }
  return mesh.mean_link_length > 0 ? float(std::sqrt(squared) / mesh.mean_link_length) : 0;
}

/// How far an element stands from where the truth has it.
float Colouring::error(const Work& work, int panel, ElementId element) const {
  const Mesh& mesh = *work.building.mesh;
  double squared = 0;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    const std::size_t at = std::size_t{element} * std::size_t(mesh.space_dimension) + std::size_t(k);
    const double apart =
        double(work.kept[panel].positions[at]) - mesh.rest[at] - work.truth->solution.displacements[at];
    squared += apart * apart;
  }
  return float(std::sqrt(squared) / work.truth->solution.hand);
}

}  // namespace chainmail
