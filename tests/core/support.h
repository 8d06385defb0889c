#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "body/region.h"
#include "mesh/generate.h"
#include "solver/deformer.h"

namespace chainmail {

// RapidCheck and Qt Test use these to compare and print.
inline bool operator==(const TraceRow& a, const TraceRow& b) {
  return a.element == b.element && a.sponsor == b.sponsor && a.moved == b.moved;
}

namespace test {

inline constexpr std::array precisions{Precision::single_precision, Precision::double_precision};

inline MeshPointer make_mesh(MeshKind kind, std::array<std::uint32_t, 3> size, std::optional<int> space = {},
                             double spacing = 1) {
  return generate({kind, size, spacing, space});
}

/// Returns all coordinates that exist, element by element. Float converts to double exactly.
inline std::vector<double> positions_of(const Deformer& solver, const Mesh& mesh) {
  std::vector<double> positions(mesh.rest.size());
  solver.body().copy_positions(std::span(positions));
  return positions;
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

inline Point position_of(const Deformer& solver, const Mesh& mesh, ElementId element) {
  std::array<double, 3> coordinates{};
  for (int k = 0; k < mesh.space_dimension; ++k) {
    coordinates[k] = solver.body().positions()(element, k);
  }
  return mesh.to_point(coordinates.data());
}

/// Returns the largest step of any element on any axis between two states (mesh units).
inline double largest_step(const std::vector<double>& before, const std::vector<double>& after) {
  double largest = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    largest = std::max(largest, std::abs(after[i] - before[i]));
  }
  return largest;
}

inline double largest_coordinate(const std::vector<double>& positions) {
  return largest_step(std::vector<double>(positions.size()), positions);
}

/// Returns all algorithms that work on this mesh.
inline std::vector<AlgorithmInfo> algorithms_for(const Mesh& mesh) {
  std::vector<AlgorithmInfo> all(algorithms().begin(), algorithms().end());
  std::erase_if(all, [&](const AlgorithmInfo& one) { return !fits(one.algorithm, mesh); });
  return all;
}

inline double half_ulp(Precision precision) { return precision == Precision::single_precision ? 0x1p-24 : 0x1p-53; }

/// Returns the largest displacement from rest along an axis (mesh units).
inline double largest_displacement(const Mesh& mesh, const std::vector<double>& positions) {
  return largest_step(mesh.rest, positions);
}

/// Draws a uniform number that is the same on every machine. The distributions of the standard library do not promise
/// this.
inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Returns the intersection of the valid regions about an element's neighbours, on one axis (mesh units).
inline std::array<double, 2> valid_interval(const Mesh& mesh, const Softness& softness,
                                            const std::vector<double>& positions, ElementId element, int k) {
  std::array<double, 2> interval{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const int n = mesh.space_dimension;
  for (EntryId entry = mesh.first_entry[element]; entry < mesh.first_entry[element + 1]; ++entry) {
    const std::size_t a = std::size_t{element} * n, b = std::size_t{mesh.neighbours[entry]} * n;
    const LinkSoftness& of_link = softness.of(mesh.entry_link[entry]);
    const double along = mesh.rest[b + k] - mesh.rest[a + k];
    double across = 0;
    for (int j = 0; j < n; ++j) {
      across += j == k ? 0 : std::abs(mesh.rest[b + j] - mesh.rest[a + j]);
    }
    const auto [low, high] = std::minmax({of_link.compression * along, of_link.stretch * along});
    interval[0] = std::max(interval[0], positions[b + k] - high - of_link.shear * across);
    interval[1] = std::min(interval[1], positions[b + k] - low + of_link.shear * across);
  }
  return interval;
}

/// Returns a random state in which every link is valid with room to spare, for any mesh. Starting from rest, each
/// element moves to a point inside the regions of all its neighbours, `reach` (0 to 1) of the way to their border.
inline std::vector<double> random_valid_state(const Mesh& mesh, const Softness& softness, double reach,
                                              std::mt19937_64& random) {
  std::vector<double> positions = mesh.rest;
  for (int sweep = 0; sweep < 3; ++sweep) {
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      for (int k = 0; k < mesh.space_dimension; ++k) {
        double& x = positions[std::size_t{e} * mesh.space_dimension + k];
        const auto [low, high] = valid_interval(mesh, softness, positions, e, k);
        if (std::isfinite(low) && low < high) {
          x += reach * (uniform(random, low, high) - x);
        }
      }
    }
  }
  return positions;
}

}  // namespace test
}  // namespace chainmail
