#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "elastic/stiffening.h"

namespace chainmail {

/// Four numbers that the processor computes at once. A point or a force has a coordinate in each, and 0 in those that
/// its space does not have.
struct alignas(32) FourNumbers {
  std::array<double, 4> at{};
};

/// Four simplices that the processor computes at once. One that is not there has no volume, and any corners.
template <int Dimension>
struct SimplexBatch {
  static constexpr std::size_t lanes = 4;

  std::array<std::array<std::uint32_t, lanes>, Dimension + 1> corner;  // places in the displacements
  std::array<std::array<FourNumbers, Dimension>, Dimension> gradient;  // [corner − 1][axis]: of its shape function
  FourNumbers volume;
};

/// The density of a material. Axes that a simplex does not have are free of stress.
struct BatchDensity {
  bool is_neo_hookean = true;
  Lame lame;
  const ExtendedDensity* extended = nullptr;
  /// Of neo-Hookean tetrahedra: the ratios of volumes below which a parabola continues the energy of each, in place of
  /// that of `extended`; and where their ratios are written. One for each batch, or null.
  const FourNumbers* least_volumes = nullptr;
  FourNumbers* ratios = nullptr;
};

struct BatchSum {
  double energy = 0;
  double least = 1;  // ratio of the volume of a simplex to that at rest
};

/// The instructions that compute batches. The results have the same bits with all of them: every operation is rounded
/// as IEEE 754 says, none is fused with another, and the logarithm is our own.
enum class BatchInstructions { portable, avx2 };
/// Returns the fastest that this processor has.
BatchInstructions batch_instructions();

/// Returns the energy of batches at these displacements from rest of their corners, and adds its negative gradient to
/// `force`, unless it is null.
template <int Dimension>
BatchSum evaluate_batches(std::span<const SimplexBatch<Dimension>> batches, const BatchDensity& density,
                          const FourNumbers* displacements, FourNumbers* force,
                          BatchInstructions instructions = batch_instructions());

}  // namespace chainmail
