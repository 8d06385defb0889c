#include "files/mesh/warp.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using TexelPoint = Eigen::Vector2d;  // in texels from the first corner of a picture

// Rounding error of positions (texels). A range that reaches into a row of pixels by less than this does not include
// the row.
constexpr double rounding = 1e-3;

bool is_whole(const Mesh& mesh, const Cuts& cuts, const std::array<ElementId, 3>& triangle) {
  const auto [a, b, c] = triangle;
  return !is_cut_between(mesh, cuts, a, b) && !is_cut_between(mesh, cuts, b, c) && !is_cut_between(mesh, cuts, c, a);
}

/// Converts positions from mesh units to texels of the picture.
class TexelPositions {
 public:
  explicit TexelPositions(const Texture& picture)
      : origin_(picture.box[0].head<2>()),
        per_unit_(TexelPoint(picture.size[0], picture.size[1]).array() /
                  (picture.box[1] - picture.box[0]).head<2>().array()) {}
  TexelPoint operator()(const Point& point) const { return (point.head<2>() - origin_).cwiseProduct(per_unit_); }

 private:
  TexelPoint origin_, per_unit_;
};

/// An edge of a triangle. It includes the points to its left, and those points on it that do not belong to the
/// neighbour triangle.
class Edge {
 public:
  /// Starts both triangles at an edge from the same end, so that both compute the same numbers.
  Edge(const TexelPoint& a, const TexelPoint& b)
      : turned_(b.x() < a.x() || (b.x() == a.x() && b.y() < a.y())),
        from_(turned_ ? b : a),
        along_((turned_ ? a : b) - from_),
        owns_((b - a).y() < 0 || ((b - a).y() == 0 && (b - a).x() < 0)) {}

  bool holds(const TexelPoint& point) const {
    const double left = along_.x() * (point.y() - from_.y()) - along_.y() * (point.x() - from_.x());
    return left == 0 ? owns_ : (left > 0) != turned_;
  }
  /// Extends a range to the point where the edge crosses the line at this height.
  void cross(double y, double& low, double& high) const {
    const double share = (y - from_.y()) / along_.y();
    if (share >= 0 && share <= 1) {  // false for NaN, which means that the edge is horizontal
      const double x = from_.x() + share * along_.x();
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }

 private:
  bool turned_;
  TexelPoint from_, along_;
  bool owns_;
};

/// Interpolates the four channels between the four nearest texels. Outside the picture, it uses the texels of the
/// border.
class Sampler {
 public:
  explicit Sampler(const Texture& picture) : picture_(picture) {}

  void sample(const TexelPoint& point, std::uint8_t* out) const {
    const TexelPoint at = point - TexelPoint(0.5, 0.5), corner = at.array().floor();
    const TexelPoint share = at - corner;
    Eigen::Vector4d sum = Eigen::Vector4d::Zero(), plain = Eigen::Vector4d::Zero();
    for (int i = 0; i < 4; ++i) {
      const bool right = (i & 1) != 0, up = (i & 2) != 0;
      const double weight = (right ? share.x() : 1 - share.x()) * (up ? share.y() : 1 - share.y());
      const Eigen::Vector4d texel = at_texel(corner.x() + (right ? 1 : 0), corner.y() + (up ? 1 : 0));
      plain += weight * texel;
      sum += weight * texel[3] * Eigen::Vector4d(texel[0], texel[1], texel[2], 1);
    }
    // Transparent texels do not contribute colour.
    const Eigen::Vector4d colour = sum[3] > 0 ? Eigen::Vector4d(sum / sum[3]) : plain;
    for (int k = 0; k < 4; ++k) {
      out[k] = static_cast<std::uint8_t>(std::lround(std::clamp(k == 3 ? plain[3] : colour[k], 0.0, 255.0)));
    }
  }

 private:
  Eigen::Vector4d at_texel(double x, double y) const {
    const auto column = static_cast<std::size_t>(std::clamp(x, 0.0, picture_.size[0] - 1.0));
    const auto row = static_cast<std::size_t>(std::clamp(y, 0.0, picture_.size[1] - 1.0));
    const std::uint8_t* texel = picture_.texels.data() + 4 * (row * picture_.size[0] + column);
    return {double(texel[0]), double(texel[1]), double(texel[2]), double(texel[3])};
  }

  const Texture& picture_;
};

/// Draws triangles of one picture into another.
class Warper {
 public:
  Warper(const Texture& from, Texture& to) : sampler_(from), to_(to) {}

  /// `corners` are in texels of the drawn picture, `sources` in texels of the original.
  void draw(std::array<TexelPoint, 3> corners, std::array<TexelPoint, 3> sources, const Progress& progress);

 private:
  void draw_row(std::uint32_t y, const std::array<Edge, 3>& edges, const Eigen::Affine2d& map);

  Sampler sampler_;
  Texture& to_;
};

/// Returns the pixels of a side whose centres may be in a range.
std::array<std::uint32_t, 2> pixels_in(double low, double high, std::uint32_t side) {
  const double first = std::floor(low - 0.5), end = std::ceil(high + 0.5);
  return {static_cast<std::uint32_t>(std::clamp(first, 0.0, double(side))),
          static_cast<std::uint32_t>(std::clamp(end, 0.0, double(side)))};
}

void Warper::draw(std::array<TexelPoint, 3> corners, std::array<TexelPoint, 3> sources, const Progress& progress) {
  Eigen::Matrix2d sides;
  sides << corners[1] - corners[0], corners[2] - corners[0];
  if (const double area = sides.determinant(); area == 0 || !std::isfinite(area)) {
    return;
  } else if (area < 0) {  // folded, and seen from behind
    std::swap(corners[1], corners[2]);
    std::swap(sources[1], sources[2]);
    sides.col(0).swap(sides.col(1));
  }
  Eigen::Matrix2d source_sides;
  source_sides << sources[1] - sources[0], sources[2] - sources[0];
  Eigen::Affine2d map;
  map.linear() = source_sides * sides.inverse();
  map.translation() = sources[0] - map.linear() * corners[0];
  const std::array edges{Edge(corners[0], corners[1]), Edge(corners[1], corners[2]), Edge(corners[2], corners[0])};
  const auto [low, high] = std::minmax({corners[0].y(), corners[1].y(), corners[2].y()});
  const auto [first, end] = pixels_in(low, high, to_.size[1]);
  for (std::uint32_t y = first; y < end; ++y) {
    progress.report(double(y - first) / (end - first));
    draw_row(y, edges, map);
  }
}

void Warper::draw_row(std::uint32_t y, const std::array<Edge, 3>& edges, const Eigen::Affine2d& map) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const Edge& edge : edges) {
    edge.cross(y + 0.5, low, high);
  }
  if (low > high) {
    return;
  }
  const auto [first, end] = pixels_in(low, high, to_.size[0]);
  std::uint8_t* row = to_.texels.data() + std::size_t{4} * y * to_.size[0];
  for (std::uint32_t x = first; x < end; ++x) {
    const TexelPoint centre(x + 0.5, y + 0.5);
    if (std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) { return edge.holds(centre); })) {
      sampler_.sample(map * centre, row + std::size_t{4} * x);
    }
  }
}

Texture empty_picture(const PictureFrame& frame) {
  const double pixels = frame.size[0] * frame.size[1];
  if (!(pixels >= 1)) {
    throw Error("warped picture", "no triangle of the sheet is whole", "undo some cuts");
  }
  if (!(pixels <= picture_limit)) {
    throw Error("warped picture",
                "the sheet spans more than " + std::to_string(std::lround(picture_limit / 1e6)) + " million pixels",
                "drag it less far, or use the frame of the picture");
  }
  Texture picture;
  picture.size = {static_cast<std::uint32_t>(frame.size[0]), static_cast<std::uint32_t>(frame.size[1]), 1};
  picture.box = {Point(frame.from[0], frame.from[1], 0),
                 Point(frame.from[0] + frame.size[0], frame.from[1] + frame.size[1], 0)};
  picture.texels.resize(picture.byte_count());
  return picture;
}

}  // namespace

PictureFrame own_frame(const Mesh& sheet) {
  return {{0, 0}, {double(sheet.texture->size[0]), double(sheet.texture->size[1])}};
}

PictureFrame frame_about(const Mesh& sheet, const Cuts& cuts, const PositionView& positions) {
  const TexelPositions to_texels(*sheet.texture);
  TexelPoint low = TexelPoint::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const auto& triangle : sheet.triangles) {
    if (is_whole(sheet, cuts, triangle)) {
      for (const ElementId corner : triangle) {
        const TexelPoint point = to_texels(point_of(sheet, positions, corner));
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
      }
    }
  }
  if (low.x() > high.x()) {
    return {};
  }
  const TexelPoint from = (low.array() + rounding).floor();
  const TexelPoint size = ((high.array() - rounding).ceil() - from.array()).max(0);
  return {{from.x(), from.y()}, {size.x(), size.y()}};
}

Texture warped(const Mesh& sheet, const Cuts& cuts, const PositionView& positions, const PictureFrame& frame,
               const Progress& progress) {
  Texture picture = empty_picture(frame);
  const TexelPositions to_texels(*sheet.texture);
  const TexelPoint from(frame.from[0], frame.from[1]);
  Warper warper(*sheet.texture, picture);
  for (std::size_t i = 0; i < sheet.triangles.size(); ++i) {
    const auto& triangle = sheet.triangles[i];
    if (!is_whole(sheet, cuts, triangle)) {
      continue;
    }
    std::array<TexelPoint, 3> corners, sources;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = to_texels(point_of(sheet, positions, triangle[k])) - from;
      sources[k] = to_texels(sheet.rest_position(triangle[k]));
    }
    const auto count = double(sheet.triangles.size());
    warper.draw(corners, sources, progress.part(double(i) / count, double(i + 1) / count));
  }
  return picture;
}

}  // namespace chainmail
