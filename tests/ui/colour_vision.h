#pragma once

#include <QColor>
#include <algorithm>
#include <array>
#include <cmath>

namespace chainmail::colour_vision {

/// What eyes see: all colours, or without red cones (protanopia) or green cones (deuteranopia).
enum class Eyes { usual, protanopia, deuteranopia };
inline constexpr std::array allEyes{Eyes::usual, Eyes::protanopia, Eyes::deuteranopia};

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

/// Returns the matrix that simulates these eyes in linear sRGB, at full severity (Machado, Oliveira and Fernandes 2009,
/// "A physiologically-based model for simulation of color vision deficiency").
inline const Matrix& matrixOf(Eyes eyes) {
  static const Matrix usual{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  static const Matrix protanopia{
      {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
  static const Matrix deuteranopia{
      {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
  return eyes == Eyes::usual ? usual : eyes == Eyes::protanopia ? protanopia : deuteranopia;
}

inline double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

inline Triple product(const Matrix& matrix, const Triple& vector) {
  Triple result{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      result[row] += matrix[row][k] * vector[k];
    }
  }
  return result;
}

/// Returns a colour, as these eyes see it, in CIELAB (white of D65).
inline Triple lab(const QColor& colour, Eyes eyes) {
  Triple seen = product(matrixOf(eyes), {linear(colour.redF()), linear(colour.greenF()), linear(colour.blueF())});
  std::ranges::for_each(seen, [](double& one) { one = std::clamp(one, 0.0, 1.0); });
  static const Matrix toXyz{
      {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}}};
  const Triple xyz = product(toXyz, seen);
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f(xyz[0] / 0.95047), y = f(xyz[1]), z = f(xyz[2] / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// Returns the distance of two colours in CIELAB (CIE 1976).
inline double distance(const QColor& one, const QColor& other, Eyes eyes = Eyes::usual) {
  const Triple a = lab(one, eyes), b = lab(other, eyes);
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Returns the distance for the eyes that see the least of it.
inline double leastDistance(const QColor& one, const QColor& other) {
  double least = distance(one, other);
  for (const Eyes eyes : allEyes) {
    least = std::min(least, distance(one, other, eyes));
  }
  return least;
}

}  // namespace chainmail::colour_vision
