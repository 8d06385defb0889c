#include "drawing/drawn_parts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "drawing/picking.h"

namespace chainmail {
namespace {

/// A multiplicative hash (Knuth 1973) that separates neighbouring ids.
ElementId scatter(ElementId e) { return e * 2654435761U >> 16; }

// A plane object or the links of an object with more links and faces than this are drawn by clusters. They are drawn
// more coarsely if the links of a lattice are shorter than `minPixels`, or if the view shows more than the scene
// allows.
constexpr std::size_t minShapes = DetailBudget::minShapes;
constexpr double minPixels = 3;  // per link
constexpr unsigned coarsestStep = MeshLevels::coarsestStep;

/// Returns the approximate number of links and faces per element of a level.
double shapesPerElement(const Mesh& mesh, unsigned step) {
  const double faces = double(mesh.triangles.size()) / mesh.element_count();
  if (step == 1 || !mesh.lattice) {
    return faces + double(mesh.link_count()) / mesh.element_count();
  }
  const auto& size = mesh.lattice->size;
  return faces + double(std::count_if(size.begin(), size.end(), [](auto one) { return one > 1; }));
}

}  // namespace

DrawnLinks drawnLinks(const MeshLevel& level, const Cuts& cuts, const std::vector<std::uint32_t>& clusters,
                      std::size_t nth) {
  DrawnLinks drawn;
  std::size_t count = 0;
  for (const std::uint32_t cluster : clusters) {
    for (const std::uint32_t link : level.clusterLinks[cluster]) {
      if (count++ % nth == 0 && level.isUncut(link, cuts)) {
        drawn.numbers.push_back(link);
        drawn.ends.insert(drawn.ends.end(), level.links[link].begin(), level.links[link].end());
      }
    }
  }
  return drawn;
}

std::vector<ElementId> drawnFaces(const MeshLevel& level, const Cuts& cuts,
                                  const std::vector<std::uint32_t>& clusters) {
  std::vector<ElementId> indices;
  for (const std::uint32_t cluster : clusters) {
    for (const std::uint32_t face : level.clusterFaces[cluster]) {
      if (level.isWhole(face, cuts)) {
        indices.insert(indices.end(), level.faces[face].begin(), level.faces[face].end());
      }
    }
  }
  return indices;
}

namespace {

/// Returns every `nth` of the visible links of a volume: links on its surface, and uncut links that belong to no cell.
DrawnLinks surfaceLinks(const Surface& surface, const Cuts& cuts, std::size_t nth) {
  const CellTable& table = surface.table();
  DrawnLinks drawn;
  std::size_t count = 0;
  const auto add = [&](LinkId link) {
    if (count++ % nth == 0 && !cuts.is_cut(link)) {
      drawn.numbers.push_back(link);
      const auto& ends = table.mesh()->links[link];
      drawn.ends.insert(drawn.ends.end(), ends.begin(), ends.end());
    }
  };
  std::ranges::for_each(surface.links(), add);
  std::ranges::for_each(table.loose_links(), add);
  return drawn;
}

/// Returns the corners of the triangles of the skin, and of the mesh's own triangles that belong to no cell and have no
/// cut side.
std::vector<ElementId> surfaceFaces(const Surface& surface, const Cuts& cuts) {
  const CellTable& table = surface.table();
  std::vector<ElementId> corners;
  for (const SideId side : surface.sides()) {
    if (!surface.is_inner(side)) {
      append_triangles(table.side(side), corners);
    }
  }
  for (const std::uint32_t i : table.loose_triangles()) {
    if (const auto& face = table.mesh()->triangles[i]; isWholeFace(*table.mesh(), cuts, face)) {
      corners.insert(corners.end(), face.begin(), face.end());
    }
  }
  return corners;
}

/// Returns the corners of the triangles inside the uncut volume that cuts have made visible.
std::vector<ElementId> freshSurfaceFaces(const Surface& surface) {
  std::vector<ElementId> corners;
  for (const SideId side : surface.sides()) {
    if (surface.is_inner(side)) {
      append_triangles(surface.table().side(side), corners);
    }
  }
  return corners;
}

}  // namespace

std::vector<ElementId> thinned(const std::vector<ElementId>& elements, std::size_t atMost) {
  const std::size_t share = (elements.size() + atMost - 1) / atMost;
  if (share <= 1) {
    return elements;
  }
  std::vector<ElementId> indices;
  std::copy_if(elements.begin(), elements.end(), std::back_inserter(indices),
               [share](ElementId e) { return scatter(e) % share == 0; });
  return indices;
}

void DrawnParts::setFrame(const Frame& frame, const Cuts& cuts) {
  frame_ = &frame;
  cuts_ = &cuts;
  if (frame.mesh != mesh_) {
    mesh_ = frame.mesh;
    level_.reset();
    outdated_ = sectionOutdated_ = true;
  }
}

bool DrawnParts::choose(const ObjectDrawing::Scene& scene, const ObjectDrawing::Paint& paint, double pixelsPerUnit) {
  chooseParts(scene, paint, pixelsPerUnit);
  if (parts_.ofSurface) {
    step_ = 1;
    return std::exchange(outdated_, false);
  }
  chooseStep(scene, pixelsPerUnit);
  if (level_ == nullptr || level_->step != step_) {
    level_ = levels_->at(mesh_, step_);
    outdated_ = true;
  }
  auto clusters = visibleClusters(scene, level_, boxes_);
  if (!outdated_ && clusters == clusters_) {
    return false;
  }
  outdated_ = false;
  clusters_ = std::move(clusters);
  return true;
}

void DrawnParts::chooseParts(const ObjectDrawing::Scene& scene, const ObjectDrawing::Paint& paint,
                             double pixelsPerUnit) {
  const Parts parts = partsOf(scene, paint, pixelsPerUnit);
  outdated_ = outdated_ || parts != parts_;
  parts_ = parts;
  const auto plane = parts_.ofSurface ? paint.options.section : std::nullopt;
  sectionOutdated_ = sectionOutdated_ || plane != plane_;
  plane_ = plane;
}

/// Chooses the parts of the object. Faces come first: if the scene allows too few shapes, links are left out, or some
/// of them if their colours are values.
DrawnParts::Parts DrawnParts::partsOf(const ObjectDrawing::Scene& scene, const ObjectDrawing::Paint& paint,
                                      double pixelsPerUnit) const {
  const DrawOptions& options = paint.options;
  // Only links are shown while the surface of a large mesh is being computed.
  const bool ofSurface =
      options.faces && mesh_->space_dimension == 3 && mesh_->has_cells() && levels_->hasSurface(mesh_);
  Parts parts{options.faces, options.links, ofSurface,
              ObjectDrawing::isSolid(*mesh_, options) && (ofSurface || !mesh_->has_cells())};
  if (!parts.solid || !options.links) {
    return parts;
  }
  const bool valued = paint.values != nullptr && paint.values->ofLinks;
  const auto [faces, links] = countSurface(ofSurface);
  parts.tooFine = !valued && !ObjectDrawing::distinguishesEdges(*mesh_, pixelsPerUnit);
  parts.links = !parts.tooFine && (valued || faces + links <= scene.maxShapes);
  if (valued && faces + links > scene.maxShapes) {
    const std::size_t room = std::max(scene.maxShapes - std::min(faces, scene.maxShapes), scene.maxShapes / 4);
    parts.nthLink = (links + room - 1) / room;
  }
  return parts;
}

/// Returns the numbers of faces and links of the surface.
std::array<std::size_t, 2> DrawnParts::countSurface(bool ofSurface) const {
  if (ofSurface) {
    return {2 * surface().sides().size(), surface().links().size() + surface().table().loose_links().size()};
  }
  return {mesh_->triangles.size(), mesh_->links.size()};
}

/// Chooses the finest step that the scene allows. A surface is drawn with all its faces if possible. The links of a
/// lattice must be distinguishable. A volume may have too many links even if they are long.
void DrawnParts::chooseStep(const ObjectDrawing::Scene& scene, double pixelsPerUnit) {
  step_ = 1;
  const double pixels = mesh_->mean_link_length * pixelsPerUnit;
  const std::size_t all = parts_.solid ? mesh_->triangles.size() : mesh_->links.size() + mesh_->triangles.size();
  if (all <= (parts_.solid ? scene.maxShapes : minShapes) || !(pixels > 0)) {
    return;
  }
  while (mesh_->lattice && !parts_.solid && step_ < coarsestStep && pixels * step_ < minPixels) {
    step_ = MeshLevels::after(step_, *mesh_);
  }
  const auto shapes = [&] { return MeshLevels::elementsAt(*mesh_, step_) * shapesPerElement(*mesh_, step_); };
  const auto most = double(scene.maxShapes);
  if (shapes() <= most) {
    return;
  }
  const double share = shareInView(scene);
  while (step_ < coarsestStep && share * shapes() > most) {
    step_ = MeshLevels::after(step_, *mesh_);
  }
}

/// Returns the fraction of the clusters that may be visible.
double DrawnParts::shareInView(const ObjectDrawing::Scene& scene) {
  const auto whole = levels_->at(mesh_, 1);
  const auto seen = visibleClusters(scene, whole, wholeBoxes_);
  return double(seen.size()) / double(whole->clusterCount());
}

std::vector<std::uint32_t> DrawnParts::visibleClusters(const ObjectDrawing::Scene& scene, const MeshLevelPointer& level,
                                                       ClusterBoxes& boxes) const {
  if (parts_.solid || level->links.size() + level->faces.size() <= minShapes) {
    std::vector<std::uint32_t> all(level->clusterCount());
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  boxes.follow(level, *frame_);
  return clustersSeen(boxes, Projection(*mesh_, scene.toView, scene.toClip, scene.size));
}

DrawnLinks DrawnParts::links() const {
  return !parts_.links      ? DrawnLinks()
         : parts_.ofSurface ? surfaceLinks(surface(), *cuts_, parts_.nthLink)
                            : drawnLinks(*level_, *cuts_, clusters_, parts_.nthLink);
}

std::vector<ElementId> DrawnParts::faces() const {
  return !parts_.faces      ? std::vector<ElementId>()
         : parts_.ofSurface ? surfaceFaces(surface(), *cuts_)
                            : drawnFaces(*level_, *cuts_, clusters_);
}

std::vector<ElementId> DrawnParts::freshFaces() const {
  return parts_.ofSurface ? freshSurfaceFaces(surface()) : std::vector<ElementId>();
}

const Section* DrawnParts::section() const { return plane_ ? &levels_->section(mesh_, *cuts_, *plane_) : nullptr; }

std::vector<float> DrawnParts::valuesOf(const std::vector<std::uint32_t>& links, const ColourValues& values) const {
  std::vector<float> drawn;
  drawn.reserve(links.size());
  for (const std::uint32_t link : links) {
    if (step_ == 1) {
      drawn.push_back(values.values[link]);
      continue;
    }
    float largest = 0;
    for (const LinkId one : level_->paths[link]) {
      largest = std::max(largest, values.values[one], [](float a, float b) { return std::abs(a) < std::abs(b); });
    }
    drawn.push_back(largest);
  }
  return drawn;
}

std::vector<QVector3D> positionsOf(const Section& section, const Frame& frame) {
  std::vector<QVector3D> positions;
  positions.reserve(section.points().size());
  for (const SectionPoint& point : section.points()) {
    const float* from = frame.positions.data() + std::size_t{3} * point.from;
    const float* to = frame.positions.data() + std::size_t{3} * point.to;
    const auto at = [&](int k) { return from[k] + point.share * (to[k] - from[k]); };
    positions.emplace_back(at(0), at(1), at(2));
  }
  return positions;
}

}  // namespace chainmail
