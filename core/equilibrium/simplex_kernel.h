// The energy and the gradient of batches of simplices, see simplex_batches.h, which includes this file once for each
// set of instructions: KERNEL_NAMESPACE is the namespace of its functions, KERNEL_TARGET their attribute, and
// KERNEL_REGISTER how many numbers a register has.

namespace chainmail::KERNEL_NAMESPACE {

#define KERNEL_FUNCTION [[gnu::always_inline]] KERNEL_TARGET inline

using V = double __attribute__((vector_size(32), may_alias));
using Bits = std::uint64_t __attribute__((vector_size(32), may_alias));

KERNEL_FUNCTION const V& vector_of(const FourNumbers& numbers) { return reinterpret_cast<const V&>(numbers); }
KERNEL_FUNCTION V& vector_of(FourNumbers& numbers) { return reinterpret_cast<V&>(numbers); }
/// Returns `yes` where x > y, else `no`.
KERNEL_FUNCTION V where_greater(const V& x, const V& y, const V& yes, const V& no) {
  const Bits is_greater = (Bits)(x > y);
  return (V)(((Bits)yes & is_greater) | ((Bits)no & ~is_greater));
}
KERNEL_FUNCTION V greater(const V& a, const V& b) { return where_greater(a, b, a, b); }

/// Exchanges rows and columns of the square of these four.
KERNEL_FUNCTION void transpose(V& a, V& b, V& c, V& d) {
  if constexpr (KERNEL_REGISTER == 4) {
    const V ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const V cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
    c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
    d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
  } else {  // in halves: GCC would take the numbers one by one
    using Half = double __attribute__((vector_size(16), may_alias));
    const V rows[] = {a, b, c, d};
    V columns[4];
    const auto* const from = reinterpret_cast<const Half*>(rows);
    auto* const to = reinterpret_cast<Half*>(columns);
    for (int half = 0; half < 2; ++half) {
      for (int pair = 0; pair < 2; ++pair) {
        const Half &one = from[4 * pair + half], &next = from[4 * pair + 2 + half];
        to[4 * half + pair] = __builtin_shufflevector(one, next, 0, 2);
        to[4 * half + 2 + pair] = __builtin_shufflevector(one, next, 1, 3);
      }
    }
    a = columns[0];
    b = columns[1];
    c = columns[2];
    d = columns[3];
  }
}

/// Returns the natural logarithm of normal numbers above 0. With x = 2^k m and s = (m − 1) / (m + 1), it is
/// k ln 2 + 2 (s + s³/3 + s⁵/5 + …).
KERNEL_FUNCTION V log_of(const V& x) {
  constexpr std::uint64_t bias = 1023, root_of_half = 0x3fe6a09e667f3bcd, two_to_52 = 0x4330000000000000;
  const Bits bits = (Bits)x, biased = (bits + ((bias << 52) - root_of_half)) >> 52;
  const V k = (V)(biased | two_to_52) - (4503599627370496.0 + bias);
  const V f = (V)(bits - ((biased - bias) << 52)) - 1.0, s = f / (2.0 + f), z = s * s;
  V series = 1 / 19.0 + z * (1 / 21.0);
  series = 1 / 17.0 + z * series;
  series = 1 / 15.0 + z * series;
  series = 1 / 13.0 + z * series;
  series = 1 / 11.0 + z * series;
  series = 1 / 9.0 + z * series;
  series = 1 / 7.0 + z * series;
  series = 1 / 5.0 + z * series;
  series = 1 / 3.0 + z * series;
  constexpr double high = 0x1.62e42fefa38p-1, low = 0x1.ef35793c7673p-45;  // of ln 2
  return k * high + (k * low + 2.0 * (s + s * (z * series)));
}

/// Returns ln s for the stretch s of the axes that are free of stress, as log_of_free_stretch() of elastic/energy.cpp
/// does: by Newton's method for s².
KERNEL_FUNCTION V log_of_free_stretch(const V& log_volume, double mu, double lambda, double free_axes) {
  constexpr int most = 60;
  const double half = free_axes * lambda / 2;
  const V linear = lambda / (mu + half) * log_volume;  // −ln s², at small strains
  V square = where_greater(linear, V{}, 1.0 / (1.0 + linear), 1.0 - linear);
  for (int turn = 0; turn < most; ++turn) {
    const V newton = square * (half * (1.0 - log_of(square)) + mu - lambda * log_volume) / (mu * square + half);
    const V next = greater(newton, square / 16.0);  // from below, all steps are forward
    const V step = next - square, far = greater(step, -step) - 1e-4 * square;
    square = next;
    if (far[0] <= 0 && far[1] <= 0 && far[2] <= 0 && far[3] <= 0) {
      break;
    }
  }
  const V log = 0.5 * log_of(square);  // one more step, in ln s, for small strains: 1 + x has not all digits of x
  return log - (mu * (square - 1.0) + lambda * (log_volume + free_axes * log)) / (2 * mu * square + free_axes * lambda);
}

/// What continues the density below a ratio of volumes.
struct Continuation {
  V least, slope, curvature;
};
KERNEL_FUNCTION Continuation continuation_of(const BatchDensity& density, std::size_t batch, const V& determinant) {
  const ExtendedDensity& extended = *density.extended;
  Continuation result{V{} + extended.least_volume(), V{} + extended.slope_below(), V{} + extended.curvature_below()};
  if (density.least_volumes != nullptr) {
    const double mu = density.lame.mu, lambda = density.lame.lambda;
    const V& least = vector_of(density.least_volumes[batch]);
    result.least = least;
    const Bits is_below = (Bits)(determinant < least);
    if ((is_below[0] | is_below[1] | is_below[2] | is_below[3]) != 0) {  // rarely, and a logarithm takes time
      const V log = log_of(least);
      result.slope = (lambda * log - mu) / least;
      result.curvature = (lambda + mu - lambda * log) / (least * least);
    }
  }
  return result;
}

template <int D>
KERNEL_FUNCTION void density_at(const BatchDensity& density, std::size_t batch, const V& shape, const V& determinant,
                                V& value, V& by_shape, V& by_volume) {
  if (!density.is_neo_hookean) {
    for (int lane = 0; lane < 4; ++lane) {
      const auto one = density.extended->at(shape[lane], determinant[lane]);
      value[lane] = one.value;
      by_shape[lane] = one.by_shape;
      by_volume[lane] = one.by_volume;
    }
    return;
  }
  constexpr double free_axes = 3 - D;
  const double mu = density.lame.mu, lambda = density.lame.lambda;
  const auto [least, slope, curvature] = continuation_of(density, batch, determinant);
  const V inside = greater(determinant, least), below = determinant - inside;
  V log = log_of(inside);  // of the whole volume: with the axes that are free of stress
  if constexpr (D < 3) {
    log += free_axes * log_of_free_stretch(log, mu, lambda, free_axes);
  }
  // The free axes add μ/2 (s² − 1) each, which is −λ/2 ln J for the stretch s that minimizes W.
  value = mu / 2 * shape + log * (lambda / 2 * log - (mu + free_axes * lambda / 2)) +
          below * (slope + curvature / 2 * below);
  by_shape = V{} + mu / 2;
  by_volume = (lambda * log - mu) / inside + curvature * below;
}

template <int D>
KERNEL_FUNCTION V determinant_of(const V (&f)[D][D], V (&cofactor)[D][D]) {
  if constexpr (D == 1) {
    cofactor[0][0] = V{} + 1;
  } else if constexpr (D == 2) {
    cofactor[0][0] = f[1][1], cofactor[0][1] = -f[1][0];
    cofactor[1][0] = -f[0][1], cofactor[1][1] = f[0][0];
  } else {
    for (int i = 0; i < 3; ++i) {
      const int a = (i + 1) % 3, b = (i + 2) % 3;
      for (int j = 0; j < 3; ++j) {
        const int c = (j + 1) % 3, d = (j + 2) % 3;
        cofactor[i][j] = f[a][c] * f[b][d] - f[a][d] * f[b][c];
      }
    }
  }
  V determinant = f[0][0] * cofactor[0][0];
  for (int j = 1; j < D; ++j) {
    determinant += f[0][j] * cofactor[0][j];
  }
  return determinant;
}

/// Finds F − 1 of each simplex.
template <int D>
KERNEL_FUNCTION void find_strain(const SimplexBatch<D>& batch, const FourNumbers* displacements, V (&strain)[D][D]) {
  V apart[D][4];  // [corner − 1][axis]: from the first corner's displacement
  for (std::size_t k = 0; k < D; ++k) {
    for (std::size_t lane = 0; lane < 4; ++lane) {
      apart[k][lane] =
          vector_of(displacements[batch.corner[k + 1][lane]]) - vector_of(displacements[batch.corner[0][lane]]);
    }
    transpose(apart[k][0], apart[k][1], apart[k][2], apart[k][3]);
  }
  for (std::size_t row = 0; row < D; ++row) {
    for (std::size_t column = 0; column < D; ++column) {
      V sum = apart[0][row] * vector_of(batch.gradient[0][column]);
      for (std::size_t k = 1; k < D; ++k) {
        sum += apart[k][row] * vector_of(batch.gradient[k][column]);
      }
      strain[row][column] = sum;
    }
  }
}

template <int D>
KERNEL_FUNCTION void add_forces(const SimplexBatch<D>& batch, const V (&stress)[D][D], FourNumbers* force) {
  V first[4]{};
  for (std::size_t k = 0; k < D; ++k) {
    V pull[4]{};
    for (std::size_t axis = 0; axis < D; ++axis) {
      pull[axis] = stress[axis][0] * vector_of(batch.gradient[k][0]);
      for (std::size_t column = 1; column < D; ++column) {
        pull[axis] += stress[axis][column] * vector_of(batch.gradient[k][column]);
      }
    }
    transpose(pull[0], pull[1], pull[2], pull[3]);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      vector_of(force[batch.corner[k + 1][lane]]) -= pull[lane];
      first[lane] += pull[lane];
    }
  }
  for (std::size_t lane = 0; lane < 4; ++lane) {
    vector_of(force[batch.corner[0][lane]]) += first[lane];
  }
}

template <int D, bool wants_force>
KERNEL_TARGET BatchSum evaluate(std::span<const SimplexBatch<D>> batches, const BatchDensity& density,
                                const FourNumbers* displacements, FourNumbers* force) {
  V energy{}, least = V{} + 1;
  for (std::size_t b = 0; b < batches.size(); ++b) {
    const SimplexBatch<D>& batch = batches[b];
    V f[D][D], cofactor[D][D];
    find_strain<D>(batch, displacements, f);
    V shape{};  // |F|² less its value at rest
    for (int i = 0; i < D; ++i) {
      shape += 2.0 * f[i][i];
      for (int j = 0; j < D; ++j) {
        shape += f[i][j] * f[i][j];
      }
    }
    for (int i = 0; i < D; ++i) {
      f[i][i] += 1;
    }
    const V determinant = determinant_of<D>(f, cofactor), volume = vector_of(batch.volume);
    V value, by_shape, by_volume;
    density_at<D>(density, b, shape, determinant, value, by_shape, by_volume);
    energy += volume * value;
    if (density.ratios != nullptr) {
      vector_of(density.ratios[b]) = determinant;
    }
    least = where_greater(volume, V{}, where_greater(least, determinant, determinant, least), least);
    if constexpr (wants_force) {
      by_shape *= 2.0 * volume;
      by_volume *= volume;
      for (int i = 0; i < D; ++i) {
        for (int j = 0; j < D; ++j) {
          f[i][j] = by_shape * f[i][j] + by_volume * cofactor[i][j];  // the first Piola-Kirchhoff stress
        }
      }
      add_forces<D>(batch, f, force);
    }
  }
  BatchSum sum{(energy[0] + energy[1]) + (energy[2] + energy[3])};
  for (int lane = 0; lane < 4; ++lane) {
    sum.least = least[lane] < sum.least ? least[lane] : sum.least;
  }
  return sum;
}

#undef KERNEL_FUNCTION

}  // namespace chainmail::KERNEL_NAMESPACE
