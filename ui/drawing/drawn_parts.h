#pragma once

#include "drawing/cell_boxes.h"
#include "drawing/drawn_indices.h"
#include "drawing/mesh_levels.h"
#include "drawing/object_drawing.h"

namespace chainmail {

/// How finely an object is drawn, and which parts of it: what its view can show of a frame.
class DrawnParts {
 public:
  /// `levels` of the mesh may be shared.
  explicit DrawnParts(std::shared_ptr<MeshLevels> levels) : levels_(std::move(levels)) {}

  /// Both must stay as they are until the next one, the cuts but for cutsChanged.
  void setFrame(const Frame& frame, const Cuts& cuts);
  void cutsChanged() { outdated_ = sectionOutdated_ = true; }
  void forget() {
    level_.reset();
    outdated_ = sectionOutdated_ = true;
  }

  /// True where other links or faces are to be drawn than the last time. Costs what is drawn, not what there is.
  bool choose(const ObjectDrawing::Scene& scene, const ObjectDrawing::Paint& paint, double pixelsPerUnit);

  /// 1 where every link is drawn; k where about k links in a row are drawn as one.
  unsigned step() const { return step_; }
  /// Whether links on a surface are left out, as they would hide it.
  bool leavesLinksOut() const { return parts_.tooFine; }
  DrawnLinks links() const;
  /// Three corners each.
  std::vector<ElementId> faces() const;
  /// The section, where one closes a volume.
  const Section* section() const;
  /// Whether it has another face than the last time this was asked.
  bool takeSectionChange() { return std::exchange(sectionOutdated_, false); }
  const Surface& surface() const { return levels_->surface(mesh_, *cuts_); }
  MeshLevels& levels() { return *levels_; }
  /// A value for each of the links with these numbers: the largest of those that it stands for.
  std::vector<float> valuesOf(const std::vector<std::uint32_t>& links, const ColourValues& values) const;

 private:
  /// Which of the object's parts are drawn, and whether they are those of a volume's surface: it is drawn in full, as
  /// it is far less than the volume.
  struct Parts {
    bool faces = true, links = true, ofSurface = false, tooFine = false;
    bool operator==(const Parts&) const = default;
  };
  void chooseParts(const ObjectDrawing::Paint& paint, double pixelsPerUnit);

  Parts partsOf(const ObjectDrawing::Paint& paint, double pixelsPerUnit) const;
  bool hidesSurface(std::size_t links, double pixelsPerUnit) const;
  void chooseStep(const ObjectDrawing::Scene& scene, double pixelsPerUnit);
  double shareInView(const ObjectDrawing::Scene& scene);
  /// The cells of a level that may be seen.
  std::vector<std::uint32_t> visibleCells(const ObjectDrawing::Scene& scene, const MeshLevelPointer& level,
                                          CellBoxes& boxes) const;

  std::shared_ptr<MeshLevels> levels_;
  MeshPointer mesh_;
  const Cuts* cuts_ = nullptr;
  const Frame* frame_ = nullptr;
  Parts parts_;
  unsigned step_ = 1;
  MeshLevelPointer level_;
  CellBoxes boxes_;       // of that level
  CellBoxes wholeBoxes_;  // of every element
  std::vector<std::uint32_t> cells_;
  std::optional<SectionPlane> plane_;  // of the section that closes a volume
  bool outdated_ = true, sectionOutdated_ = true;
};

/// Where the points of a section are in a frame.
std::vector<QVector3D> placesOf(const Section& section, const Frame& frame);

}  // namespace chainmail
