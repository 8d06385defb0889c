#pragma once

#include <array>
#include <vector>

#include "drawing/mesh_level.h"
#include "drawing/mesh_levels.h"
#include "drawing/object_drawing.h"
#include "drawing/projection.h"
#include "mesh/surface.h"

namespace chainmail {

// The links and faces to draw, as ids of elements for the graphics card.

/// The links to draw: their numbers, and the two ends of each.
struct DrawnLinks {
  std::vector<std::uint32_t> numbers;
  std::vector<ElementId> ends;
};

/// Returns every `nth` of the uncut links of these clusters.
DrawnLinks drawnLinks(const MeshLevel& level, const Cuts& cuts, const std::vector<std::uint32_t>& clusters,
                      std::size_t nth = 1);

/// Returns the corners of the faces of these clusters, three per face. Leaves out faces with a cut side.
std::vector<ElementId> drawnFaces(const MeshLevel& level, const Cuts& cuts, const std::vector<std::uint32_t>& clusters);

/// Returns all elements if there are at most `atMost`; otherwise about that many, evenly distributed.
std::vector<ElementId> thinned(const std::vector<ElementId>& elements, std::size_t atMost);

/// Chooses how finely an object is drawn, and selects the links and faces that the view can show.
class DrawnParts {
 public:
  /// `levels` may be shared with other painters of the same mesh.
  explicit DrawnParts(std::shared_ptr<MeshLevels> levels) : levels_(std::move(levels)) {}

  /// Frame and cuts must stay valid until the next call. Call cutsChanged() after each change of the cuts.
  void setFrame(const Frame& frame, const Cuts& cuts);
  void cutsChanged() { outdated_ = sectionOutdated_ = true; }
  void forget() {
    level_.reset();
    outdated_ = sectionOutdated_ = true;
  }

  /// Returns true if links() or faces() changed since the last call. The time depends on the number of drawn shapes,
  /// not on the size of the mesh.
  bool choose(const ObjectDrawing::Scene& scene, const ObjectDrawing::Paint& paint, double pixelsPerUnit);

  /// Returns 1 if every link is drawn, k if about k links in a row are drawn as one.
  unsigned step() const { return step_; }
  /// True if the links on a surface are left out because they would hide it.
  bool leavesLinksOut() const { return parts_.tooFine; }
  DrawnLinks links() const;
  /// Returns three corners per face, without freshFaces().
  std::vector<ElementId> faces() const;
  /// Returns the faces inside a volume that cuts have made visible, three corners each.
  std::vector<ElementId> freshFaces() const;
  /// Returns the section that closes a volume; null if there is none.
  const Section* section() const;
  /// Returns true if the face of the section changed since the last call.
  bool takeSectionChange() { return std::exchange(sectionOutdated_, false); }
  bool sectionChanged() const { return sectionOutdated_; }
  const Surface& surface() const { return levels_->surface(mesh_, *cuts_); }
  MeshLevels& levels() { return *levels_; }
  /// Returns one value per link. A coarse link gets the value with the largest magnitude among the links that it
  /// replaces.
  std::vector<float> valuesOf(const std::vector<std::uint32_t>& links, const ColourValues& values) const;

 private:
  /// The parts of the object that are drawn. If `ofSurface`, they are the surface of a volume. A surface is always
  /// drawn completely, because it is far smaller than the volume; of its links, every `nthLink` is drawn.
  struct Parts {
    bool faces = true, links = true, ofSurface = false, solid = false, tooFine = false;
    std::size_t nthLink = 1;
    bool operator==(const Parts&) const = default;
  };
  void chooseParts(const ObjectDrawing::Scene& scene, const ObjectDrawing::Paint& paint, double pixelsPerUnit);

  Parts partsOf(const ObjectDrawing::Scene& scene, const ObjectDrawing::Paint& paint, double pixelsPerUnit) const;
  std::array<std::size_t, 2> countSurface(bool ofSurface) const;
  void chooseStep(const ObjectDrawing::Scene& scene, double pixelsPerUnit);
  double shareInView(const ObjectDrawing::Scene& scene);
  /// Returns the clusters of a level that may be visible.
  std::vector<std::uint32_t> visibleClusters(const ObjectDrawing::Scene& scene, const MeshLevelPointer& level,
                                             ClusterBoxes& boxes) const;

  std::shared_ptr<MeshLevels> levels_;
  MeshPointer mesh_;
  const Cuts* cuts_ = nullptr;
  const Frame* frame_ = nullptr;
  Parts parts_;
  unsigned step_ = 1;
  MeshLevelPointer level_;
  ClusterBoxes boxes_;       // of level_
  ClusterBoxes wholeBoxes_;  // of the level with every element
  std::vector<std::uint32_t> clusters_;
  std::optional<SectionPlane> plane_;  // of the section
  bool outdated_ = true, sectionOutdated_ = true;
};

/// Returns the positions of the points of a section in a frame.
std::vector<QVector3D> positionsOf(const Section& section, const Frame& frame);

}  // namespace chainmail
