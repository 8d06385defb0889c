#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <vector>

#include "body/body.h"
#include "command_line/common.h"
#include "command_line/limited_work.h"
#include "command_line/raster.h"
#include "command_line/samples.h"
#include "files/session/session.h"
#include "files/text/limits.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "mesh/surface.h"

namespace chainmail::command_line {
namespace {

constexpr std::uint32_t smallest = 16, largest = 1024, default_size = 256;  // pixels
constexpr Raster::Colour face_colour{86, 156, 214}, link_colour{38, 92, 140};
constexpr double margin = 0.06;     // of the picture
constexpr double line_lift = 1e-3;  // of the object: links on faces are in front of them

constexpr WorkLimits work_limits{limits::thumbnail_seconds, limits::thumbnail_memory, limits::thumbnail_bytes};

/// What a file shows: an object in a state.
struct LoadedScene {
  MeshPointer mesh;
  Cuts cuts;
  std::vector<double> positions;
};

LoadedScene at_rest(const MeshPointer& mesh) { return {mesh, Cuts(mesh), mesh->rest}; }

LoadedScene session_of(const std::filesystem::path& path) {
  const auto open = [&](const std::string& name, std::uint32_t, const Progress& progress) {
    const std::filesystem::path beside = path.parent_path() / name, sample = samples_folder() / name;
    std::error_code none;
    const bool is_sample = !exists(beside, none) && exists(sample, none);
    if (has_used_half(work_limits)) {
      throw Error(chainmail::shown(path), "it takes too long to read", "open it in the workbench");
    }
    return chainmail::open_mesh(is_sample ? sample : beside, {}, progress).mesh;
  };
  const Session session = read_session(path, {}, open);
  Body body(session.mesh, Precision::double_precision);
  ElementBlocks all(session.mesh->element_count());
  all.insert_all();
  body.restore(session.panels.front().positions, all);
  LoadedScene shown = at_rest(session.mesh);
  body.copy_positions(shown.positions);
  for (const LinkId link : session.cuts) {
    shown.cuts.cut(link);
  }
  return shown;
}

/// Looks at an object so that it fills the picture: from the front in a plane, else from the front, the right and
/// above.
class ThumbnailView {
 public:
  explicit ThumbnailView(const LoadedScene& shown) : shown_(shown) {
    const bool is_spatial = shown.mesh->space_dimension == 3;
    const double yaw = is_spatial ? std::numbers::pi / 6 : 0, pitch = is_spatial ? std::numbers::pi / 7 : 0;
    right_ = {std::cos(yaw), 0, -std::sin(yaw)};
    up_ = {-std::sin(pitch) * std::sin(yaw), std::cos(pitch), -std::sin(pitch) * std::cos(yaw)};
    toward_ = right_.cross(up_);
    seen_.reserve(shown.mesh->element_count());
    for (ElementId e = 0; e < shown.mesh->element_count(); ++e) {
      seen_.push_back(seen_from_the_eye(e));
      const Point& at = seen_.back();
      low_ = low_.cwiseMin(at);
      high_ = high_.cwiseMax(at);
    }
    const double extent = (high_ - low_).head<2>().maxCoeff();
    scale_ = extent > 0 ? (1 - 2 * margin) / extent : 1;
  }

  Raster::Place place(ElementId element, double lift = 0) const {
    const Point at = scale_ * (seen_[element] - (low_ + high_) / 2);
    return {0.5 + at.x(), 0.5 - at.y(), -at.z() - lift};
  }
  /// The colour of a face in a light that comes from the eye.
  Raster::Colour lit(const std::array<ElementId, 3>& corners) const {
    const Point &a = seen_[corners[0]], &b = seen_[corners[1]], &c = seen_[corners[2]];
    const Point normal = (b - a).cross(c - a);
    const double length = normal.norm(), light = length > 0 ? 0.4 + 0.6 * std::abs(normal.z()) / length : 1;
    Raster::Colour colour{};
    std::ranges::transform(face_colour, colour.begin(), [&](auto one) { return std::uint8_t(light * one); });
    return colour;
  }

 private:
  /// The position of an element along the axes of the picture; z points to the eye.
  Point seen_from_the_eye(ElementId element) const {
    Point at = shown_.mesh->origin;
    for (int k = 0; k < shown_.mesh->space_dimension; ++k) {
      at[shown_.mesh->axes[std::size_t(k)]] =
          shown_.positions[std::size_t{element} * std::size_t(shown_.mesh->space_dimension) + std::size_t(k)];
    }
    if (shown_.mesh->space_dimension < 3) {
      at = in_plane(at);
    }
    return {right_.dot(at), up_.dot(at), toward_.dot(at)};
  }
  /// Puts the axes of a plane object into the plane of the picture.
  Point in_plane(const Point& at) const {
    const auto& axes = shown_.mesh->axes;
    return {at[axes[0]], shown_.mesh->space_dimension > 1 ? at[axes[1]] : 0, 0};
  }

  const LoadedScene& shown_;
  std::vector<Point> seen_;  // position of each element along the axes of the picture
  Point right_, up_, toward_;
  Point low_ = Point::Constant(std::numeric_limits<double>::infinity());
  Point high_ = Point::Constant(-std::numeric_limits<double>::infinity());
  double scale_ = 1;
};

/// Returns the faces of the object and of its cells.
std::vector<std::array<ElementId, 3>> faces_of(const LoadedScene& shown) {
  std::vector<std::array<ElementId, 3>> faces;
  for (const auto& [a, b, c] : shown.mesh->triangles) {
    if (!is_cut_between(*shown.mesh, shown.cuts, a, b) && !is_cut_between(*shown.mesh, shown.cuts, b, c) &&
        !is_cut_between(*shown.mesh, shown.cuts, c, a)) {
      faces.push_back({a, b, c});
    }
  }
  const Surface surface(std::make_shared<const CellTable>(shown.mesh), shown.cuts);
  const std::vector<ElementId> corners = surface.triangles();
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  return faces;
}

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

void draw_faces(Raster& picture, const ThumbnailView& view, const std::vector<std::array<ElementId, 3>>& faces) {
  const auto corners = [&](std::size_t i) {
    return std::array{view.place(faces[i][0]), view.place(faces[i][1]), view.place(faces[i][2])};
  };
  draw_within(
      limits::thumbnail_samples, faces.size(), [&](std::size_t i) { return picture.cost_of_triangle(corners(i)); },
      [&](std::size_t i) { picture.draw_triangle(corners(i), view.lit(faces[i])); });
}

void draw_links(Raster& picture, const ThumbnailView& view, const LoadedScene& shown) {
  const auto& links = shown.mesh->links;
  draw_within(
      limits::thumbnail_samples, links.size(),
      [&](std::size_t i) {
        return shown.cuts.is_cut(LinkId(i)) ? 0
                                            : picture.cost_of_line(view.place(links[i][0]), view.place(links[i][1]));
      },
      [&](std::size_t i) {
        if (!shown.cuts.is_cut(LinkId(i))) {
          picture.draw_line(view.place(links[i][0], line_lift), view.place(links[i][1], line_lift), link_colour);
        }
      });
}

Raster draw(const LoadedScene& shown, std::uint32_t size) {
  Raster picture(size);
  const ThumbnailView view(shown);
  const auto faces = faces_of(shown);
  draw_faces(picture, view, faces);
  // Links inside a volume are hidden anyway, and so many on a large surface that they would hide it.
  constexpr std::size_t max_links = 3000;
  if (faces.empty() || (shown.mesh->tetrahedra.empty() && shown.mesh->links.size() <= max_links)) {
    draw_links(picture, view, shown);
  }
  return picture;
}

/// Returns the picture of a file as PNG.
std::string png_of(const std::filesystem::path& path, std::uint32_t pixels) {
  const LoadedScene shown = is_session(path) ? session_of(path) : at_rest(chainmail::open_mesh(path).mesh);
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
            Outputs outputs;
            outputs.keep(path);
            const std::string png =
                run_limited(chainmail::shown(path), work_limits, [&] { return png_of(path, pixels); });
            outputs.add(*value_of(output), [&](std::ostream& out) { out << png; });
            outputs.commit();
          }};
}

}  // namespace chainmail::command_line
