#include "equilibrium/surface_steps.h"

namespace chainmail {
namespace {

// Factors take as long as 5 to 20 steps, and serve at least these steps. They are computed anew when a step leaves more
// than this share of the distance. Measured on sheets of 17 x 17 to 65 x 65 elements: with 2 steps there are as many
// steps and twice as many factors.
constexpr int fewest_steps = 5;
constexpr double little_gain = 0.5;

}  // namespace

void SurfaceSteps::begin(const SurfaceEnergy& energy, const Progress& progress) {
  can_factor_ = energy.mesh().element_count() <= max_factored;
  if (can_factor_) {
    inverse_.begin(energy, progress);
  }
  forget();
}

void SurfaceSteps::forget() {
  newton_.forget();
  is_outdated_ = true;
}

void SurfaceSteps::factor(const SurfaceEnergy& energy, const LaplacianPreconditioner<3>& laplacian,
                          const RegionPenalties<3>& regions, const Vectors& at, const Progress& progress) {
  inverse_.factor(
      energy, regions, at, [&](ElementId e) { return laplacian.is_fixed(e); }, progress);
  newton_.forget();
  is_outdated_ = false;
  has_prepared_ = true;
  steps_ = 0;
}

void SurfaceSteps::note_step() {
  const double distance = newton_.distance();
  is_outdated_ = ++steps_ >= fewest_steps && distance > little_gain * last_distance_;
  last_distance_ = distance;
}

}  // namespace chainmail
