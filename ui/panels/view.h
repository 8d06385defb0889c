#pragma once

#include <QOpenGLWidget>
#include <QTimer>
#include <memory>

#include "common/colours.h"
#include "document/document.h"
#include "drawing/camera.h"
#include "drawing/frame_meter.h"
#include "drawing/ghost.h"
#include "drawing/object_painter.h"
#include "drawing/picking.h"
#include "panels/colouring.h"
#include "panels/overlay.h"
#include "panels/panel_links.h"
#include "panels/tool.h"

namespace chainmail {

/// Draws one panel's object and hands the mouse to the active tool. It knows no rule of the model.
class View : public QOpenGLWidget {
  Q_OBJECT

 public:
  /// The panels share the camera, unless they are unlinked, and the mesh's levels of detail.
  View(Document& document, Colouring& colouring, PanelLinks& links, int panel, std::shared_ptr<Camera> camera,
       std::shared_ptr<MeshLevels> levels);
  ~View() override;

  void setTool(Tool* tool);
  /// Draws it over the object, after those added before. Whoever changes it updates the view.
  void addOverlay(Overlay& overlay) { overlays_.push_back(&overlay); }
  /// What the overlays say of this panel.
  QStringList notes() const;
  std::optional<OverlayLegend> overlayLegend() const;
  /// Looks through another camera, as it stands.
  void setCamera(std::shared_ptr<Camera> camera);
  const std::shared_ptr<Camera>& camera() const { return camera_; }
  /// Shows the whole rest shape.
  void fit();
  /// The same after a change of its size, from where it looks, as long as nobody has moved the camera.
  void fitAgain();
  /// What it shows of its object and its ghost.
  void setLook(const Look& look) {
    look_ = look;
    update();
  }
  void setGhost(const Ghost& ghost);
  const Ghost& ghost() const { return ghost_; }
  /// Moves the camera, as travels of the mouse in logical pixels do; a zoom is about the view's centre or a place in
  /// it.
  void orbit(QPointF pixels);
  void pan(QPointF pixels);
  void zoom(double factor);
  void zoom(double factor, QPointF about);
  /// As Camera has them.
  void lookFrom(double yaw, double pitch);
  void setParallel(bool parallel);
  int panel() const { return panel_; }

  /// For tools: what is under a place of this view, and where an element is.
  std::optional<ElementId> elementAt(QPointF place) const;
  std::vector<LinkId> linksCrossing(QLineF stroke) const;
  /// Of them those of the front layer, where the scene has depth.
  std::vector<LinkId> frontLinksCrossing(QLineF stroke) const;
  /// `inside` is asked of places in `bounds`.
  std::vector<ElementId> elementsWhere(QRectF bounds, const std::function<bool(QPointF)>& inside) const;
  Point position(ElementId element) const;
  QVector3D pointAt(QPointF place, const Point& through) const;

  /// A picture of it with `pixelRatio` device pixels to a logical one, drawn anew so that lines are sharp; transparent,
  /// without its ground. The frame of the keyboard's focus is not in it. Throws Error where it is larger than the
  /// graphics card can draw.
  QImage picture(double pixelRatio, bool transparent);
  /// The same in lines and areas, in logical pixels.
  void drawIn(QPainter& painter, const QColor& ground);

  /// Where an element appears (logical pixels).
  QPointF placeOf(ElementId element) const;
  QPointF placeOf(const Point& point) const;

  FrameMeter& meter() { return meter_; }
  /// How coarsely the object is drawn, as ObjectPainter::step.
  unsigned drawnStep() const { return painter_.step(); }
  bool leavesLinksOut() const { return painter_.leavesLinksOut(); }

 signals:
  void cameraChanged();
  void resized();
  void failed(const QString& sentence);
  void drawnStepChanged();
  void ghostChanged();

 protected:
  void initializeGL() override;
  void paintGL() override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  /// What the view is drawn with.
  struct Easel {
    ObjectDrawing& own;
    std::function<ObjectDrawing&()> ghost;  // asked where there is one
    ObjectDrawing::Scene scene;
  };

  void draw(const Easel& on, const Frame& frame);
  void paint(double pixelRatio, const QColor& ground);
  /// With `pixelRatio` device pixels to a logical one.
  ObjectDrawing::Scene scene(double pixelRatio) const;
  Projection projection() const;
  /// Whether a section leaves an element; none where there is no section.
  std::function<bool(ElementId)> shown() const;
  const CellBoxes& boxes(const Frame& frame) const;
  void listen();
  double pixelsPerLink() const;
  ObjectDrawing::Paint paint();
  ObjectDrawing::Paint colouredPaint();
  void drawObjects(const Easel& on, const Frame& frame);
  ObjectPainter& ghostPainter();
  void forgetGhost();
  void drawMarks(const Easel& on);
  void drawHighlight(const Easel& on);
  void drawFocus();
  std::vector<Annotation> annotations() const;
  void drawAnnotations(const Easel& on);
  void announceCamera();
  void moveCamera(QPointF travel, Qt::MouseButtons buttons);

  Document& document_;
  Colouring& colouring_;
  PanelLinks& links_;
  int panel_;
  std::shared_ptr<Camera> camera_;
  colours::Colour colour_;
  Tool* tool_ = nullptr;
  std::vector<Overlay*> overlays_;
  std::shared_ptr<MeshLevels> levels_;
  mutable CellBoxes boxes_;  // for the search under the cursor, as of the last one
  ObjectPainter painter_;
  Look look_;
  Ghost ghost_;
  std::unique_ptr<ObjectPainter> ghostPainter_;  // as long as there is a ghost
  FrameMeter meter_;
  QTimer hover_;  // the search for the element under the cursor runs once a frame, not once an event
  QPointF cursor_;
  bool fitPending_ = true;
  bool painterReady_ = false;
  bool framed_ = false;            // the keyboard came here by the keyboard
  bool selectionOutdated_ = true;  // on the graphics card
  bool selectedHere_ = true;       // in this view, or in no other
};

}  // namespace chainmail
