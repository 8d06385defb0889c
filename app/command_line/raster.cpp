#include "command_line/raster.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace chainmail::command_line {
namespace {

constexpr std::int64_t oversampling = 3;  // samples per pixel along each axis
constexpr double line_width = 1.0 / 128;  // of the picture

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

void Raster::draw_triangle(const std::array<Place, 3>& corners, Colour colour) {
  const Place &a = corners[0], &b = corners[1], &c = corners[2];
  const double whole = area(a, b, c);
  if (whole == 0) {
    return;
  }
  const auto range = [&](std::size_t axis) {
    const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
    const auto last = double(side_ - 1);
    return std::array{std::int64_t(std::clamp(std::floor(low * double(side_)), 0.0, last)),
                      std::int64_t(std::clamp(std::ceil(high * double(side_)), 0.0, last))};
  };
  const auto columns = range(0), rows = range(1);
  for (std::int64_t y = rows[0]; y <= rows[1]; ++y) {
    for (std::int64_t x = columns[0]; x <= columns[1]; ++x) {
      const Place at{(double(x) + 0.5) / double(side_), (double(y) + 0.5) / double(side_), 0};
      const std::array share{area(at, b, c) / whole, area(a, at, c) / whole, area(a, b, at) / whole};
      if (std::ranges::all_of(share, [](double one) { return one >= 0; })) {
        put(x, y, share[0] * a[2] + share[1] * b[2] + share[2] * c[2], colour);
      }
    }
  }
}

void Raster::draw_line(const Place& from, const Place& to, Colour colour) {
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]) * double(side_);
  const auto steps = std::int64_t(std::clamp(std::ceil(length), 1.0, 2.0 * double(side_)));
  const auto radius = std::max(std::int64_t{1}, std::int64_t(line_width * double(side_) / 2));
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
