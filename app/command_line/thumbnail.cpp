#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <vector>

#include "chainmail/session.h"
#include "command_line/common.h"
#include "command_line/limited_work.h"
#include "command_line/raster.h"
#include "command_line/samples.h"

namespace chainmail::command_line {
namespace {

constexpr std::uint32_t smallest = 16, largest = 1024, default_size = 256;  // pixels
constexpr Raster::Colour face_colour{86, 156, 214}, link_colour{38, 92, 140};
constexpr double margin = 0.06;     // of the picture
constexpr double line_lift = 1e-3;  // of the object: links on faces are in front of them

// Of seconds of processor time, and of bytes of memory and of the picture. The manual lists them.
constexpr WorkLimits work_limits{2, std::uint64_t{1} << 30, std::uint64_t{16} << 20};
/// Points of the picture, with those that a nearer face hides. Of more faces, or more links, some are not drawn.
constexpr double most_samples = 1e8;

api::Body session_of(const std::filesystem::path& path) {
  return api::read_session(path, [&](const std::string& name) {
    const std::filesystem::path beside = path.parent_path() / name, sample = samples_folder() / name;
    std::error_code none;
    const bool is_sample = !exists(beside, none) && exists(sample, none);
    if (has_used_half(work_limits)) {
      throw api::Error(api::shown(path), "it takes too long to read", "open it in the workbench");
    }
    return api::read_mesh(is_sample ? sample : beside);
  });
}

/// Looks at an object so that it fills the picture: from the front in a plane, else from the front, the right and
/// above.
class ThumbnailView {
 public:
  explicit ThumbnailView(const api::Body& shown) {
    const api::Mesh& mesh = shown.mesh();
    const bool is_spatial = mesh.space_dimension() == 3;
    const double yaw = is_spatial ? std::numbers::pi / 6 : 0, pitch = is_spatial ? std::numbers::pi / 7 : 0;
    right_ = {std::cos(yaw), 0, -std::sin(yaw)};
    up_ = {-std::sin(pitch) * std::sin(yaw), std::cos(pitch), -std::sin(pitch) * std::cos(yaw)};
    toward_ = api::cross(right_, up_);
    const std::string axes = mesh.axes();
    seen_.reserve(mesh.element_count());
    for (api::ElementId e = 0; e < mesh.element_count(); ++e) {
      const api::Vector3 at = is_spatial ? shown.position(e) : in_plane(shown.position(e), axes);
      seen_.push_back({api::dot(right_, at), api::dot(up_, at), api::dot(toward_, at)});
      const auto& [x, y, z] = seen_.back();
      low_ = {std::min(low_.x, x), std::min(low_.y, y), std::min(low_.z, z)};
      high_ = {std::max(high_.x, x), std::max(high_.y, y), std::max(high_.z, z)};
    }
    const double extent = std::max(high_.x - low_.x, high_.y - low_.y);
    scale_ = extent > 0 ? (1 - 2 * margin) / extent : 1;
  }

  Raster::Place place(api::ElementId element, double lift = 0) const {
    const api::Vector3 at = scale_ * (seen_[element] - 0.5 * (low_ + high_));
    return {0.5 + at.x, 0.5 - at.y, -at.z - lift};
  }
  /// The colour of a face in a light that comes from the eye.
  Raster::Colour lit(const std::array<api::ElementId, 3>& corners) const {
    const api::Vector3 &a = seen_[corners[0]], &b = seen_[corners[1]], &c = seen_[corners[2]];
    const api::Vector3 normal = api::cross(b - a, c - a);
    const double length = std::sqrt(api::dot(normal, normal));
    const double light = length > 0 ? 0.4 + 0.6 * std::abs(normal.z) / length : 1;
    Raster::Colour colour{};
    std::ranges::transform(face_colour, colour.begin(), [&](auto one) { return std::uint8_t(light * one); });
    return colour;
  }

 private:
  /// Puts the axes of a plane object into the plane of the picture.
  static api::Vector3 in_plane(const api::Vector3& at, const std::string& axes) {
    const auto along = [&](char axis) { return axis == 'x' ? at.x : axis == 'y' ? at.y : at.z; };
    return {along(axes[0]), axes.size() > 1 ? along(axes[1]) : 0, 0};
  }

  std::vector<api::Vector3> seen_;  // position of each element along the axes of the picture; z points to the eye
  api::Vector3 right_, up_, toward_;
  api::Vector3 low_ = everywhere, high_ = -1 * everywhere;
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr api::Vector3 everywhere{infinite, infinite, infinite};
  double scale_ = 1;
};

/// Draws some of `count` shapes, evenly spread, so that all together cost little more than `budget`. `cost(i)` is what
/// shape i costs.
template <class Cost, class Draw>
void draw_within(double budget, std::size_t count, Cost cost, Draw draw) {
  double all = 0;
  for (std::size_t i = 0; i < count; ++i) {
    all += cost(i);
  }
  double spent = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (all <= budget || spent <= budget * double(i) / double(count)) {
      spent += cost(i);
      draw(i);
    }
  }
}

void draw_faces(Raster& picture, const ThumbnailView& view, const std::vector<std::array<api::ElementId, 3>>& faces) {
  const auto corners = [&](std::size_t i) {
    return std::array{view.place(faces[i][0]), view.place(faces[i][1]), view.place(faces[i][2])};
  };
  draw_within(
      most_samples, faces.size(), [&](std::size_t i) { return picture.cost_of_triangle(corners(i)); },
      [&](std::size_t i) { picture.draw_triangle(corners(i), view.lit(faces[i])); });
}

void draw_links(Raster& picture, const ThumbnailView& view, const api::Body& shown) {
  const auto links = shown.mesh().links();
  draw_within(
      most_samples, links.size(),
      [&](std::size_t i) {
        return shown.is_cut(api::LinkId(i)) ? 0
                                            : picture.cost_of_line(view.place(links[i][0]), view.place(links[i][1]));
      },
      [&](std::size_t i) {
        if (!shown.is_cut(api::LinkId(i))) {
          picture.draw_line(view.place(links[i][0], line_lift), view.place(links[i][1], line_lift), link_colour);
        }
      });
}

Raster draw(const api::Body& shown, std::uint32_t size) {
  Raster picture(size);
  const ThumbnailView view(shown);
  const auto faces = shown.visible_triangles();
  draw_faces(picture, view, faces);
  // Links inside a volume are hidden anyway, and so many on a large surface that they would hide it.
  constexpr std::size_t max_links = 3000;
  if (faces.empty() || (shown.mesh().tetrahedra().empty() && shown.mesh().link_count() <= max_links)) {
    draw_links(picture, view, shown);
  }
  return picture;
}

/// Returns the picture of a file as PNG.
std::string png_of(const std::filesystem::path& path, std::uint32_t pixels) {
  const api::Body shown = api::is_session(path) ? session_of(path) : api::Body(api::read_mesh(path));
  finish_in_sandbox();
  std::ostringstream png;
  draw(shown, pixels).write_png(png);
  return png.str();
}

}  // namespace

Command add_thumbnail(CLI::App& root) {
  CLI::App& app = *root.add_subcommand("thumbnail", "Draw a mesh or a session as a small picture");
  CLI::Option* file = add_value(app, "FILE", "", "a session (.chainmail) or a mesh file")->required();
  CLI::Option* output = add_value(app, "-o", "PNG", "output file")->required();
  CLI::Option* size = add_value(app, "--size", "PIXELS", "width and height of the picture: 16 to 1024 [256]");
  app.footer("File managers use it. It needs no display.\n\nExample:\n  chainmail thumbnail organ.msh -o organ.png");
  return {&app, [file, output, size] {
            const std::filesystem::path path = *value_of(file);
            const std::uint32_t pixels = whole_number_of(size, smallest, default_size, largest);
            api::Outputs outputs;
            outputs.keep(path);
            const std::string png = run_limited(api::shown(path), work_limits, [&] { return png_of(path, pixels); });
            outputs.add(*value_of(output), [&](std::ostream& out) { out << png; });
            outputs.commit();
          }};
}

}  // namespace chainmail::command_line
