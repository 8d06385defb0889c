#include "equilibrium/simplex_batches.h"

// Warns of how functions pass vectors of four numbers. All that do are inlined. GCC warns at the end of the source.
#pragma GCC diagnostic ignored "-Wpsabi"

#define KERNEL_NAMESPACE portable_kernel
#define KERNEL_TARGET
#define KERNEL_REGISTER 2
#include "equilibrium/simplex_kernel.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_TARGET
#undef KERNEL_REGISTER

#ifdef __x86_64__
#define KERNEL_NAMESPACE avx2_kernel
#define KERNEL_TARGET [[gnu::target("avx2")]]
#define KERNEL_REGISTER 4
#include "equilibrium/simplex_kernel.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_TARGET
#undef KERNEL_REGISTER
#else
namespace chainmail {
namespace avx2_kernel = portable_kernel;
}
#endif

namespace chainmail {

BatchInstructions batch_instructions() {
#ifdef __x86_64__
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  return has_avx2 ? BatchInstructions::avx2 : BatchInstructions::portable;
#else
  return BatchInstructions::portable;
#endif
}

template <int D>
BatchSum evaluate_batches(std::span<const SimplexBatch<D>> batches, const BatchDensity& density,
                          const FourNumbers* displacements, FourNumbers* force, BatchInstructions instructions) {
  const auto evaluate =
      instructions == BatchInstructions::avx2
          ? (force != nullptr ? avx2_kernel::evaluate<D, true> : avx2_kernel::evaluate<D, false>)
          : (force != nullptr ? portable_kernel::evaluate<D, true> : portable_kernel::evaluate<D, false>);
  return evaluate(batches, density, displacements, force);
}

template BatchSum evaluate_batches(std::span<const SimplexBatch<1>>, const BatchDensity&, const FourNumbers*,
                                   FourNumbers*, BatchInstructions);
template BatchSum evaluate_batches(std::span<const SimplexBatch<2>>, const BatchDensity&, const FourNumbers*,
                                   FourNumbers*, BatchInstructions);
template BatchSum evaluate_batches(std::span<const SimplexBatch<3>>, const BatchDensity&, const FourNumbers*,
                                   FourNumbers*, BatchInstructions);

}  // namespace chainmail
