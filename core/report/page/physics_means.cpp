#include "report/page/physics_means.h"

#include <algorithm>

namespace chainmail::report {
namespace {

using Drags = std::vector<const PhysicsDrag*>;

void mix(double& mean, double other, double weight) { mean += weight * (other - mean); }

void mix(TimeSpread& mean, const TimeSpread& other, double weight) {
  for (const auto member : {&TimeSpread::median, &TimeSpread::lower_quartile, &TimeSpread::upper_quartile,
                            &TimeSpread::min, &TimeSpread::max}) {
    mix(mean.*member, other.*member, weight);
  }
  mean.count = std::min(mean.count, other.count);
}

void mix(PhysicalError& mean, const PhysicalError& other, double weight) {
  for (const auto member : {&PhysicalError::relative, &PhysicalError::rms, &PhysicalError::moving_rms}) {
    mix(mean.*member, other.*member, weight);
  }
  mean.max = std::max(mean.max, other.max);
  mean.moving_max = std::max(mean.moving_max, other.moving_max);
}

PhysicsEntry mean_of(const Drags& drags, std::size_t entry) {
  PhysicsEntry mean{drags.front()->entries[entry].contestant, std::nullopt, {}};
  int count = 0;
  for (const PhysicsDrag* drag : drags) {
    const PhysicsEntry& other = drag->entries[entry];
    if (!other.measurement) {
      mean.refusal = mean.refusal.empty() ? other.refusal : mean.refusal;
      ++mean.left_out;
      continue;
    }
    if (count++ == 0) {
      mean.measurement = other.measurement;
      continue;
    }
    const double weight = 1 / double(count);
    PhysicsMeasurement& to = *mean.measurement;
    const PhysicsMeasurement& from = *other.measurement;
    mix(to.ms_per_move, from.ms_per_move, weight);
    mix(to.first_move, from.first_move, weight);
    mix(to.move_after_cut, from.move_after_cut, weight);
    mix(to.prepare.factorize, from.prepare.factorize, weight);
    mix(to.prepare.grab, from.prepare.grab, weight);
    mix(to.error, from.error, weight);
    take_worst(to.shape, from.shape);
    to.residual = std::max(to.residual, from.residual);
    to.binds = std::max(to.binds, from.binds);
  }
  return mean;
}

PhysicsDrag mean_of(const std::string& name, const Drags& drags) {
  PhysicsDrag mean;
  mean.name = name;
  if (drags.empty()) {
    mean.no_reference = "no drag has a reference solution";
    return mean;
  }
  mean.has_cut = drags.front()->has_cut;
  for (std::size_t i = 0; i < drags.front()->entries.size(); ++i) {
    mean.entries.push_back(mean_of(drags, i));
  }
  return mean;
}

}  // namespace

std::vector<PhysicsDrag> means_by_name(const PhysicsObject& object) {
  std::vector<std::string> names;
  for (const PhysicsDrag& drag : object.drags) {
    if (std::ranges::find(names, drag.name) == names.end()) {
      names.push_back(drag.name);
    }
  }
  std::vector<PhysicsDrag> means;
  for (const std::string& name : names) {
    Drags drags;
    for (const PhysicsDrag& drag : object.drags) {
      if (drag.name == name && drag.no_reference.empty()) {
        drags.push_back(&drag);
      }
    }
    means.push_back(mean_of(name, drags));
  }
  return means;
}

PhysicsDrag mean_of_drags(const PhysicsObject& object) {
  Drags drags;
  for (const PhysicsDrag& drag : object.drags) {
    if (!drag.has_cut && drag.no_reference.empty()) {
      drags.push_back(&drag);
    }
  }
  return mean_of(object.name, drags);
}

}  // namespace chainmail::report
