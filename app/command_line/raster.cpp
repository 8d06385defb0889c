#include "command_line/raster.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace chainmail::command_line {
namespace {

constexpr std::int64_t oversampling = 3;  // samples per pixel along each axis
constexpr double line_width = 1.0 / 128;  // of the picture
constexpr double row_cost = 10;           // time of a row of a triangle, in samples

/// Twice the area of a triangle in the picture, with the sign of its orientation.
double area(const Raster::Place& a, const Raster::Place& b, const Raster::Place& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

}  // namespace

Raster::Raster(std::uint32_t size)
    : size_(size), side_(oversampling * size), samples_(std::size_t(side_ * side_), {0, {}, false}) {}

void Raster::put(std::int64_t x, std::int64_t y, double depth, Colour colour) {
  Sample& sample = samples_[std::size_t(y * side_ + x)];
  if (!sample.is_drawn || float(depth) < sample.depth) {
    sample = {float(depth), colour, true};
  }
}

/// Returns the first and the last row or column of samples that a shape touches between two places on an axis.
std::array<std::int64_t, 2> Raster::range(double low, double high) const {
  const auto last = double(side_ - 1);
  return {std::int64_t(std::clamp(std::floor(low * double(side_)), 0.0, last)),
          std::int64_t(std::clamp(std::ceil(high * double(side_)), 0.0, last))};
}

double Raster::cost_of_triangle(const std::array<Place, 3>& corners) const {
  const auto [low, high] = std::minmax({corners[0][1], corners[1][1], corners[2][1]});
  const auto rows = range(low, high);
  return row_cost * double(rows[1] - rows[0] + 1) +
         std::abs(area(corners[0], corners[1], corners[2])) / 2 * double(side_) * double(side_);
}

void Raster::draw_triangle(const std::array<Place, 3>& corners, Colour colour) {
  const Place &a = corners[0], &b = corners[1], &c = corners[2];
  const double whole = area(a, b, c);
  if (whole == 0) {
    return;
  }
  const auto [lowest, highest] = std::minmax({a[1], b[1], c[1]});
  const auto rows = range(lowest, highest);
  for (std::int64_t y = rows[0]; y <= rows[1]; ++y) {
    // The shares of the corners at a sample are linear in its column: `first` + `slope` * column.
    const Place start{0.5 / double(side_), (double(y) + 0.5) / double(side_), 0};
    const std::array first{area(start, b, c) / whole, area(a, start, c) / whole, area(a, b, start) / whole};
    const std::array slope{(b[1] - c[1]) / whole / double(side_), (c[1] - a[1]) / whole / double(side_),
                           (a[1] - b[1]) / whole / double(side_)};
    const auto [from, to] = columns_inside(first, slope);
    const double depth = first[0] * a[2] + first[1] * b[2] + first[2] * c[2];
    const double depth_slope = slope[0] * a[2] + slope[1] * b[2] + slope[2] * c[2];
    for (std::int64_t x = from; x <= to; ++x) {
      put(x, y, depth + depth_slope * double(x), colour);
    }
  }
}

/// Returns the first and the last column in which no share is below 0. There is none if the first is larger.
std::array<std::int64_t, 2> Raster::columns_inside(const std::array<double, 3>& first,
                                                   const std::array<double, 3>& slope) const {
  double from = 0;
  auto to = double(side_ - 1);
  for (std::size_t k = 0; k < 3; ++k) {
    if (slope[k] > 0) {
      from = std::max(from, std::ceil(-first[k] / slope[k]));
    } else if (slope[k] < 0) {
      to = std::min(to, std::floor(first[k] / -slope[k]));
    } else if (first[k] < 0) {
      return {0, -1};
    }
  }
  return {std::int64_t(std::min(from, double(side_))), std::int64_t(std::max(to, -1.0))};
}

double Raster::cost_of_line(const Place& from, const Place& to) const {
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]) * double(side_);
  const auto width = double(2 * line_radius() + 1);
  return std::clamp(length + 1, 1.0, 2.0 * double(side_)) * width * width;
}

std::int64_t Raster::line_radius() const {
  return std::max(std::int64_t{1}, std::int64_t(line_width * double(side_) / 2));
}

void Raster::draw_line(const Place& from, const Place& to, Colour colour) {
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]) * double(side_);
  const auto steps = std::int64_t(std::clamp(std::ceil(length), 1.0, 2.0 * double(side_)));
  const std::int64_t radius = line_radius();
  for (std::int64_t step = 0; step <= steps; ++step) {
    const double share = double(step) / double(steps);
    const auto at = [&](std::size_t axis) { return from[axis] + share * (to[axis] - from[axis]); };
    const auto column = std::int64_t(at(0) * double(side_)), row = std::int64_t(at(1) * double(side_));
    for (std::int64_t y = std::max<std::int64_t>(0, row - radius); y <= std::min(side_ - 1, row + radius); ++y) {
      for (std::int64_t x = std::max<std::int64_t>(0, column - radius); x <= std::min(side_ - 1, column + radius);
           ++x) {
        put(x, y, at(2), colour);
      }
    }
  }
}

/// Returns red, green, blue and alpha of each pixel: the mean of its samples.
std::vector<std::uint8_t> Raster::pixels() const {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(std::size_t{4} * size_ * size_);
  for (std::int64_t y = 0; y < side_; y += oversampling) {
    for (std::int64_t x = 0; x < side_; x += oversampling) {
      std::array<unsigned, 3> sum{};
      unsigned drawn = 0;
      for (std::int64_t i = 0; i < oversampling * oversampling; ++i) {
        const Sample& sample = samples_[std::size_t((y + i / oversampling) * side_ + x + i % oversampling)];
        drawn += sample.is_drawn ? 1 : 0;
        for (std::size_t k = 0; sample.is_drawn && k < 3; ++k) {
          sum[k] += sample.colour[k];
        }
      }
      for (const unsigned one : sum) {
        pixels.push_back(std::uint8_t(drawn == 0 ? 0 : one / drawn));
      }
      pixels.push_back(std::uint8_t(255 * drawn / (oversampling * oversampling)));
    }
  }
  return pixels;
}

void Raster::write_png(std::ostream& out) const {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = image.height = size_;
  image.format = PNG_FORMAT_RGBA;
  const auto rows = pixels();
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<char> file(size);
  if (png_image_write_to_memory(&image, file.data(), &size, 0, rows.data(), 0, nullptr) == 0) {
    throw std::runtime_error(std::string("the picture could not be written: ") + image.message);
  }
  out.write(file.data(), std::streamsize(size));
}

}  // namespace chainmail::command_line
