#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <vector>

namespace chainmail::command_line {

/// A square picture that is drawn without a window. Near shapes hide far ones; what is not drawn is transparent.
class Raster {
 public:
  /// x to the right, y down (0 to 1 over the picture), and the depth, larger is farther.
  using Place = std::array<double, 3>;
  /// Red, green, blue.
  using Colour = std::array<std::uint8_t, 3>;

  /// `size` is the width in pixels. Inside, the picture is larger, so that edges are smooth.
  explicit Raster(std::uint32_t size);

  void draw_triangle(const std::array<Place, 3>& corners, Colour colour);
  void draw_line(const Place& from, const Place& to, Colour colour);
  /// Estimate the time that drawing takes, in samples that are written.
  double cost_of_triangle(const std::array<Place, 3>& corners) const;
  double cost_of_line(const Place& from, const Place& to) const;

  /// Writes the picture as PNG.
  void write_png(std::ostream& out) const;

 private:
  struct Sample {
    float depth;
    Colour colour;
    bool is_drawn;
  };

  std::array<std::int64_t, 2> range(double low, double high) const;
  std::array<std::int64_t, 2> columns_inside(const std::array<double, 3>& first,
                                             const std::array<double, 3>& slope) const;
  std::int64_t line_radius() const;
  void put(std::int64_t x, std::int64_t y, double depth, Colour colour);
  std::vector<std::uint8_t> pixels() const;

  std::uint32_t size_;
  std::int64_t side_;  // in samples
  std::vector<Sample> samples_;
};

}  // namespace chainmail::command_line
