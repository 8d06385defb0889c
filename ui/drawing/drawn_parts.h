#pragma once

#include "drawing/cluster_boxes.h"
#include "drawing/drawn_indices.h"
#include "drawing/mesh_levels.h"
#include "drawing/object_drawing.h"

namespace chainmail {

/// Chooses how finely an object is drawn, and which of its links and faces: those that the view can show.
class DrawnParts {
 public:
  /// `levels` of the mesh may be shared.
  explicit DrawnParts(std::shared_ptr<MeshLevels> levels) : levels_(std::move(levels)) {}

  /// Frame and cuts must stay valid until the next call; cutsChanged must follow a change of the cuts.
  void setFrame(const Frame& frame, const Cuts& cuts);
  void cutsChanged() { outdated_ = sectionOutdated_ = true; }
  void forget() {
    level_.reset();
    outdated_ = sectionOutdated_ = true;
  }

  /// Returns true if links() or faces() changed since the last call. The cost depends on what is drawn, not on the size
  /// of the mesh.
  bool choose(const ObjectDrawing::Scene& scene, const ObjectDrawing::Paint& paint, double pixelsPerUnit);

  /// Returns 1 if every link is drawn, k if about k links in a row are drawn as one.
  unsigned step() const { return step_; }
  /// True if the links on a surface are left out because they would hide it.
  bool leavesLinksOut() const { return parts_.tooFine; }
  DrawnLinks links() const;
  /// Returns three corners per face.
  std::vector<ElementId> faces() const;
  /// Returns the section that closes a volume, or null.
  const Section* section() const;
  /// Returns true if the face of the section changed since the last call.
  bool takeSectionChange() { return std::exchange(sectionOutdated_, false); }
  const Surface& surface() const { return levels_->surface(mesh_, *cuts_); }
  MeshLevels& levels() { return *levels_; }
  /// Returns a value per link; for a coarse link, the value of largest magnitude of the links that it replaces.
  std::vector<float> valuesOf(const std::vector<std::uint32_t>& links, const ColourValues& values) const;

 private:
  /// Which parts of the object are drawn, and whether they are those of a volume's surface. A surface is always drawn
  /// in full, because it is far smaller than the volume.
  struct Parts {
    bool faces = true, links = true, ofSurface = false, tooFine = false;
    bool operator==(const Parts&) const = default;
  };
  void chooseParts(const ObjectDrawing::Paint& paint, double pixelsPerUnit);

  Parts partsOf(const ObjectDrawing::Paint& paint, double pixelsPerUnit) const;
  bool hidesSurface(std::size_t links, double pixelsPerUnit) const;
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
