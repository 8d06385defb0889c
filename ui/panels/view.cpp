// The order of this file: construction, tools and overlays, mouse, keyboard. The camera is in view_camera.cpp, painting
// in view_painting.cpp.

#include "panels/view.h"

#include <QFocusEvent>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QWheelEvent>
#include <chrono>
#include <cmath>

#include "common/text.h"
#include "panels/orientation_cube.h"

namespace chainmail {
namespace {

constexpr int hoverMilliseconds = 16;
constexpr std::chrono::milliseconds boxMilliseconds(4);
constexpr int stillMilliseconds = 50;
constexpr double zoomPerNotch = 1.2;

}  // namespace

View::View(Document& document, Colouring& colouring, PanelLinks& links, int panel, std::shared_ptr<Camera> camera,
           std::shared_ptr<MeshLevels> levels)
    : document_(document),
      colouring_(colouring),
      links_(links),
      panel_(panel),
      camera_(std::move(camera)),
      levels_(std::move(levels)),
      search_(*this, document_, panel, camera_, levels_, drawOptions_),
      painter_(levels_),
      still_(this),
      hover_(this) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);  // a click takes the keyboard focus from an input field
  setMinimumSize(160, 90);
  still_.setSingleShot(true);
  still_.setInterval(stillMilliseconds);
  connect(&still_, &QTimer::timeout, this, qOverload<>(&View::update));
  hover_.setSingleShot(true);
  connect(&hover_, &QTimer::timeout, this, &View::searchUnderCursor);
  listen();
}

void View::listen() {
  connect(&document_.solvers(), &PanelSolvers::frameReady, this, [this](int ready) {
    if (ready == panel_ || ready == ghost_.of) {
      update();  // the paint passes the newest frame to the painters
    }
  });
  connect(&document_.highlight(), &Highlight::changed, this, qOverload<>(&View::update));
  connect(&document_.highlight(), &Highlight::strokeChanged, this, qOverload<>(&View::update));
  connect(&document_, &Document::pinsChanged, this, qOverload<>(&View::update));
  connect(&document_, &Document::algorithmChanged, this, qOverload<>(&View::update));  // changes colours of panels
  connect(&document_, &Document::algorithmChanged, this, &View::nameIt);
  nameIt();
  connect(&document_.selection(), &Selection::changed, this, [this] {
    selectionOutdated_ = true;
    selectedHere_ = links_.pointed() == panel_;
    update();
  });
  connect(&document_, &Document::cutsChanged, this, [this] {
    painter_.cutsChanged();
    if (ghostPainter_ != nullptr) {
      ghostPainter_->cutsChanged();
    }
    update();
  });
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, &View::updateHover, Qt::QueuedConnection);
  connect(&links_, &PanelLinks::marksLinked, this, qOverload<>(&View::update));
  connect(&colouring_, &Colouring::changed, this, qOverload<>(&View::update));
  connect(this, &QOpenGLWidget::frameSwapped, this, [this] {
    meter_.swapped();
    measurePaint();
  });
}

/// Names the view for screen readers.
void View::nameIt() {
  setAccessibleName(
      QStringLiteral("Object of panel %1, %2").arg(panelName(panel_), text(info(document_.algorithm(panel_)).label)));
}

/// Highlights the element under the cursor again after an edit has cleared the highlight.
void View::updateHover() {
  if (underMouse() && tool_ != nullptr && !tool_->busy()) {
    hoverSoon();
  }
}

View::~View() {
  if (context() == nullptr) {
    return;  // it was never shown
  }
  disconnect(context(), nullptr, this, nullptr);  // aboutToBeDestroyed must not reach a destroyed view
  makeCurrent();
  painter_.destroy();
  freeGhostPainter();
  doneCurrent();
}

// Tools and overlays

void View::setTool(Tool* tool) {
  tool_ = tool;
  setCursor(tool->cursor());
}

QStringList View::notes() const {
  QStringList notes;
  for (const Overlay* overlay : overlays_) {
    if (const QString note = overlay->note(panel_); !note.isEmpty()) {
      notes << note;
    }
  }
  return notes;
}

bool View::isInMidPass() const {
  return std::ranges::any_of(overlays_, [this](const Overlay* overlay) { return overlay->isInMidPass(panel_); });
}

std::optional<OverlayLegend> View::overlayLegend() const {
  for (const Overlay* overlay : overlays_) {
    if (auto legend = overlay->legend(panel_)) {
      return legend;
    }
  }
  return std::nullopt;
}

void View::setDrawOptions(const DrawOptions& options) {
  drawOptions_ = options;
  update();
}

void View::setGhost(const Ghost& ghost) {
  if (ghost == ghost_) {
    return;
  }
  ghost_ = ghost;
  if (!ghost_.of) {
    makeCurrent();
    freeGhostPainter();
    doneCurrent();
  }
  emit ghostChanged();
  update();
}

void View::setLecture(bool on) {
  lecture_ = on;
  update();
}

// Mouse: the left button belongs to the tool, the others move the camera

void View::mousePressEvent(QMouseEvent* event) {
  links_.point(panel_);
  cursor_ = event->position();
  if (const auto face = OrientationCube(*camera_, size()).faceAt(cursor_);
      face && event->button() == Qt::LeftButton && event->buttons() == Qt::LeftButton) {
    cubePressed_ = true;
    lookFromAxis(face->axis, face->positive);
    return;
  }
  if (event->button() == Qt::LeftButton && tool_ != nullptr) {
    hover_.stop();
    tool_->press(*this, cursor_, event->modifiers());
  }
}

void View::mouseMoveEvent(QMouseEvent* event) {
  links_.point(panel_);
  const QPointF travel = event->position() - cursor_;
  cursor_ = event->position();
  if (lecture_) {
    update();
  }
  if (event->buttons() == Qt::NoButton) {
    if (!hover_.isActive()) {
      hover_.start(hoverMilliseconds);
    }
  } else if ((event->buttons() & Qt::LeftButton) != 0) {
    if (tool_ != nullptr && !cubePressed_) {
      tool_->move(*this, cursor_, event->modifiers());
    }
  } else {
    moveCamera(travel, event->buttons());
  }
}

void View::moveCamera(QPointF travel, Qt::MouseButtons buttons) {
  if ((buttons & Qt::RightButton) != 0 && camera_->spatial()) {
    orbit(travel);
  } else {
    pan(travel);
  }
}

/// The second press of a double click moves the element under the cursor to the centre of the view. It does not grab an
/// element.
void View::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || (tool_ != nullptr && tool_->clicks())) {
    mousePressEvent(event);
    return;
  }
  cursor_ = event->position();
  if (const auto element = search_.elementAt(cursor_)) {
    centreOn(*element);
  }
}

void View::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && std::exchange(cubePressed_, false)) {
    return;
  }
  cursor_ = event->position();
  if (event->button() == Qt::LeftButton && tool_ != nullptr) {
    tool_->release(*this, event->position());
  }
}

void View::leaveEvent(QEvent* event) {
  QOpenGLWidget::leaveEvent(event);
  hover_.stop();
  if (lecture_) {
    update();
  }
  if (tool_ != nullptr) {
    tool_->leave(*this);
  }
  if (!document_.highlight().marks().grabbed && document_.highlight().marks().links.empty()) {
    document_.highlight().set({});
  }
}

void View::wheelEvent(QWheelEvent* event) {
  const double notches = event->angleDelta().y() / 120.0;
  if (tool_ == nullptr || !tool_->wheel(*this, event->position(), notches)) {
    zoom(std::pow(zoomPerNotch, notches), event->position());
  }
}

bool View::prepareSearch() const {
  const Frame* frame = document_.solvers().frame(panel_);
  return frame == nullptr || search_.prepare(*frame, boxMilliseconds);
}

/// Shows what is under the cursor, once the search is ready.
void View::searchUnderCursor() {
  if (!prepareSearch()) {
    hover_.start(0);
  } else if (tool_ != nullptr) {
    tool_->hover(*this, cursor_);
  }
}

// Keyboard: a frame shows the focus, except after a click

void View::focusInEvent(QFocusEvent* event) {
  QOpenGLWidget::focusInEvent(event);
  focusFramed_ = event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason ||
                 event->reason() == Qt::ShortcutFocusReason;
  update();
}

void View::focusOutEvent(QFocusEvent* event) {
  QOpenGLWidget::focusOutEvent(event);
  focusFramed_ = false;
  update();
}

}  // namespace chainmail
