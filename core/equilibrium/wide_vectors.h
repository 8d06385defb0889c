#pragma once

#include <cstddef>
#include <new>
#include <vector>

#include "equilibrium/simplex_batches.h"

namespace chainmail {

/// Numbers that the processor computes at once. A vector of the space is the first three.
using Doubles4 = double __attribute__((vector_size(32)));
using Floats4 = float __attribute__((vector_size(16)));

inline double square_of(const Doubles4& a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

/// Memory as FourNumbers have it: vectors alone are aligned as the registers are for which a source is compiled.
template <class T>
struct WideAllocator {
  using value_type = T;  // NOLINT(readability-identifier-naming): a name of the standard library

  static constexpr std::align_val_t alignment{alignof(FourNumbers)};
  static T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment)); }
  static void deallocate(T* memory, std::size_t /*count*/) { ::operator delete(memory, alignment); }
  bool operator==(const WideAllocator& /*other*/) const { return true; }
};

using WideVectors = std::vector<Doubles4, WideAllocator<Doubles4>>;

inline FourNumbers* four_numbers(WideVectors& all) { return reinterpret_cast<FourNumbers*>(all.data()); }

}  // namespace chainmail
