#include "tools/cut_tool.h"

#include <QLineF>
#include <algorithm>
#include <new>

#include "document/edits.h"
#include "mesh/error.h"
#include "panels/view.h"
#include "solver/algorithms.h"

namespace chainmail {
namespace {

constexpr double shortestSegment = 2;  // pixels
constexpr double nearestDepth = 0.05;  // of a ribbon in perspective, in distances of the centre from the eye

}  // namespace

QString CutTool::hint() const {
  return QStringLiteral("Left: draw a stroke, release to cut along it in all panels  ·  Esc: cancel  ·  Ctrl+Z: undo");
}

void CutTool::hover(View& /*view*/, QPointF /*position*/) { document_.highlight().set({}); }

void CutTool::press(View& view, QPointF position, Qt::KeyboardModifiers /*modifiers*/) {
  cancel();
  at_ = &view;
  add(view, position);
}

void CutTool::move(View& view, QPointF position, Qt::KeyboardModifiers /*modifiers*/) {
  if (at_ != &view) {
    return;
  }
  const QLineF segment(stroke_.back(), position);
  if (segment.length() < shortestSegment) {
    return;
  }
  add(view, position);
  auto crossed = frontOnly_ ? view.search().frontLinksCrossing(segment) : view.search().linksCrossing(segment);
  std::erase_if(crossed, [this](LinkId link) { return !crossed_.insert(link).second; });
  document_.highlight().add(crossed);
}

void CutTool::release(View& view, QPointF position) {
  if (at_ != &view) {
    return;
  }
  move(view, position, {});
  const std::vector<LinkId> links(crossed_.begin(), crossed_.end());
  const auto stroke = stroke_;
  cancel();
  cut(view, links, stroke);
}

void CutTool::cut(const View& view, const std::vector<LinkId>& links, const std::vector<QPointF>& stroke) {
  if (!splits_ || !view.search().splits()) {
    edits::cut(document_, links);
    return;
  }
  try {
    const auto loose = links_without_faces(*document_.mesh(), links);
    if (const SplitPointer split = view.search().splitAlong(stroke, links)) {
      const MeshPointer after = split->after();
      for (int panel = 0; panel < document_.panels(); ++panel) {
        check(document_.algorithm(panel), *after);  // some need a lattice
      }
      edits::split(document_, split, loose);
    } else if (!loose.empty() || links.empty()) {
      edits::cut(document_, loose);
    } else {
      emit document_.noticed(
          QStringLiteral("The stroke is too short to open the object: draw it across a whole face or cell"));
    }
  } catch (const Error& error) {
    emit document_.refused(QString::fromStdString(error.what()));
  } catch (const std::bad_alloc&) {
    emit document_.refused(QStringLiteral("There is not enough memory to split this object: cut its links instead"));
  }
}

void CutTool::cancel() {
  at_ = nullptr;
  stroke_.clear();
  ribbon_.clear();
  crossed_.clear();
  document_.highlight().set({});
  emit document_.highlight().strokeChanged();
}

/// Adds a point to the stroke, and the two ends of its line of sight to the ribbon.
void CutTool::add(const View& view, QPointF position) {
  stroke_.push_back(position);
  const Camera& camera = *view.camera();
  if (camera.spatial()) {
    const auto [near, far] = camera.depthRange();
    const double centre = (near + far) / 2;
    // A close eye is inside the object.
    const double nearEnd = camera.parallel() ? near : std::max(near, nearestDepth * centre);
    const QVector3D away = camera.toView().inverted().mapVector({0, 0, -1});
    for (const double depth : {nearEnd, far}) {
      ribbon_.push_back(camera.pointAt(position, camera.centre() + float(depth - centre) * away, view.size()));
    }
  }
  emit document_.highlight().strokeChanged();
}

std::span<const QVector3D> CutTool::ribbon(const View& view) const {
  return at_ != nullptr && at_ != &view ? std::span<const QVector3D>(ribbon_) : std::span<const QVector3D>();
}

std::span<const QPointF> CutTool::stroke(const View& view) const {
  return at_ == &view ? std::span<const QPointF>(stroke_) : std::span<const QPointF>();
}

}  // namespace chainmail
