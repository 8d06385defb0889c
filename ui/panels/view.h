#pragma once

#include <QElapsedTimer>
#include <QOpenGLWidget>
#include <QTimer>
#include <algorithm>
#include <deque>
#include <memory>
#include <optional>

#include "common/colours.h"
#include "document/document.h"
#include "drawing/camera.h"
#include "drawing/object_painter.h"
#include "drawing/picking.h"
#include "panels/colouring.h"
#include "panels/overlay.h"
#include "panels/panel_links.h"
#include "panels/tool.h"
#include "panels/view_search.h"

namespace chainmail {

/// Counts the frames that a view painted and that reached the screen. Qt reports a swap to every view when any part of
/// the window is repainted, so a swap only counts after the view's own paint.
class FrameMeter {
 public:
  FrameMeter() { clock_.start(); }

  void painted() { pending_ = true; }
  void swapped() {
    if (pending_) {
      pending_ = false;
      times_.push_back(clock_.elapsed());
    }
  }
  /// Returns the number of frames painted in the last second.
  int framesPerSecond() {
    while (!times_.empty() && times_.front() < clock_.elapsed() - 1000) {
      times_.pop_front();
    }
    return int(times_.size());
  }

 private:
  QElapsedTimer clock_;
  std::deque<qint64> times_;  // ms
  bool pending_ = false;
};

/// Another panel's object, drawn see-through over a panel's own object.
struct Ghost {
  std::optional<int> of;  // the other panel
  double blend = 0.5;     // 0: only the own object, 1: only the ghost

  double opacity() const { return blend; }
  double ownOpacity() const { return of ? std::min(1.0, 2 - 2 * blend) : 1; }
  bool operator==(const Ghost&) const = default;
};

/// Draws the object of one panel and passes the left mouse button to the active tool. It contains no rules of the
/// model.
///
/// A new frame, another highlight or another camera only schedules a paint. The paint passes the newest frame to the
/// painter once. Everything else (the search under the cursor, readouts, figures) reads the document's frame.
class View : public QOpenGLWidget {
  Q_OBJECT

 public:
  /// Panels share `camera` while their cameras are linked. They always share `levels`, the levels of detail of the
  /// mesh.
  View(Document& document, Colouring& colouring, PanelLinks& links, int panel, std::shared_ptr<Camera> camera,
       std::shared_ptr<MeshLevels> levels);
  ~View() override;

  int panel() const { return panel_; }
  void setTool(Tool* tool);
  /// Draws an overlay over the object, after the overlays that were added before. Call update() after each change of
  /// the overlay.
  void addOverlay(Overlay& overlay) { overlays_.push_back(&overlay); }
  /// The notes of the overlays on this panel.
  QStringList notes() const;
  /// True if an overlay shows the object in the middle of its last pass.
  bool isInMidPass() const;
  /// The legend of the first overlay that has one for this panel.
  std::optional<OverlayLegend> overlayLegend() const;
  /// Sets the parts of the object that are drawn.
  void setDrawOptions(const DrawOptions& options);
  void setGhost(const Ghost& ghost);
  /// Marks the cursor with a ring and draws links twice as wide, for an audience.
  void setLecture(bool on);
  const Ghost& ghost() const { return ghost_; }

  /// Looks through another camera and does not change that camera.
  void setCamera(std::shared_ptr<Camera> camera);
  const std::shared_ptr<Camera>& camera() const { return camera_; }
  /// True if no part of the object is outside the view.
  bool showsAll() const;
  /// Shows the whole rest shape from the initial side.
  void fitRest();
  /// Returns points that enclose what the view should show: the object now, or its rest shape (mesh units).
  std::vector<QVector3D> outline(bool atRest) const;
  /// Shows all these points from the current side.
  void frame(std::span<const QVector3D> points);
  /// Moves the camera as if the mouse had moved by this many logical pixels.
  void orbit(QPointF pixels);
  void pan(QPointF pixels);
  /// Zooms about the centre of the view, or about a position in it.
  void zoom(double factor);
  void zoom(double factor, QPointF about);
  /// See Camera.
  void lookFrom(double yaw, double pitch);
  void lookFromAxis(int axis, bool positive);
  /// Moves the camera so that an element is in the middle.
  void centreOn(ElementId element);
  void setParallel(bool parallel);

  // For tools and overlays. Positions in the view are in logical pixels from its top left corner.
  /// Finds elements, links and faces.
  const ViewSearch& search() const { return search_; }
  /// Prepares the search for the newest frame, and showsAll(), for some milliseconds. Returns true if they are ready:
  /// after a large move of a large object, this takes several calls.
  bool prepareSearch() const;
  /// Lets the tool hover at the cursor, when there is time: after a large move, the search may take some.
  void hoverSoon() { hover_.start(0); }
  /// Returns the position of an element in the newest frame (mesh units).
  Point position(ElementId element) const;
  /// Returns the space of the frames, in which the view draws.
  FrameSpace space() const;
  /// Returns the mesh units per logical pixel in the plane through the centre of the view.
  double unitsPerPixel() const;
  /// Returns the point in space under a position in the view (mesh units). It lies in the plane that contains `through`
  /// and is parallel to the view.
  Point pointAt(QPointF position, const Point& through) const;
  /// Returns the position in the view of an element or of a point (mesh units).
  QPointF viewPosition(ElementId element) const;
  QPointF viewPosition(const Point& point) const;

  /// Returns a picture with `pixelRatio` device pixels per logical pixel, painted again so that lines are sharp. A
  /// transparent picture has no background. The frame of the keyboard focus is not part of it. Throws Error if the
  /// picture is larger than the graphics card can draw.
  QImage picture(double pixelRatio, bool transparent);
  /// Draws the view as vector graphics, in logical pixels.
  void drawIn(QPainter& painter, const QColor& ground);

  FrameMeter& meter() { return meter_; }
  /// How coarsely the object is drawn, see ObjectPainter::step.
  unsigned drawnStep() const { return painter_.step(); }
  bool leavesLinksOut() const { return painter_.leavesLinksOut(); }

 signals:
  void cameraChanged();
  void resized();
  /// The view looks from another side, which the user has chosen by name.
  void sideChosen();
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
  /// The painters of one paint, and the scene that they draw.
  struct PaintTarget {
    ObjectDrawing& own;
    ObjectDrawing* ghost;  // null without a ghost
    ObjectDrawing::Scene scene;
  };

  void listen();
  void nameIt();
  void updateHover();
  void searchUnderCursor();
  void announceCamera();

  DetailBudget::Detail chooseDetail();
  void measurePaint();
  std::optional<QPointF> wayToObject() const;

  void moveCamera(QPointF travel, Qt::MouseButtons buttons);

  const Frame* ghostFrame() const;
  ObjectPainter& ghostPainter();
  void freeGhostPainter();
  ObjectDrawing::Scene scene(double pixelRatio, const QColor& ground, DetailBudget::Detail detail) const;
  void paint();
  void startOver();
  void paintOn(const QColor& ground, double pixelRatio, DetailBudget::Detail detail);
  void draw(const PaintTarget& on);
  void takeFrames(const PaintTarget& on);
  void drawObjects(const PaintTarget& on);
  ObjectDrawing::Paint objectPaint();
  ObjectDrawing::Paint colouredPaint();
  void drawMarks(const PaintTarget& on);
  void drawRibbon(const PaintTarget& on);
  void drawHighlight(const PaintTarget& on);
  void drawAnnotations(const PaintTarget& on);
  void drawWayBack(const PaintTarget& on);
  void drawFocus();
  void drawCube();
  void drawRing();

  Document& document_;
  Colouring& colouring_;
  PanelLinks& links_;
  int panel_;
  std::shared_ptr<Camera> camera_;
  Tool* tool_ = nullptr;
  std::vector<Overlay*> overlays_;
  std::shared_ptr<MeshLevels> levels_;
  DrawOptions drawOptions_;
  ViewSearch search_;
  ObjectPainter painter_;
  Ghost ghost_;
  std::unique_ptr<ObjectPainter> ghostPainter_;  // exists while there is a ghost
  FrameMeter meter_;
  /// All that moves in a view: object and camera.
  struct LastPicture {
    const Mesh* mesh = nullptr;
    std::uint64_t frame = 0, series = 0;
    QMatrix4x4 toView, toClip;
    bool operator==(const LastPicture&) const = default;
  };
  LastPicture lastPicture_;
  QTimer still_;  // ends some time after the last movement; then the object is drawn completely
  DetailBudget budget_;
  DetailBudget::Detail detail_ = DetailBudget::Detail::complete;
  QElapsedTimer paintClock_;
  std::size_t quickShapes_ = 0;  // in a quick picture that is not on the screen yet
  QTimer hover_;                 // limits the search for the element under the cursor to once per frame
  QPointF cursor_;
  bool lecture_ = false;  // see setLecture()
  bool fitPending_ = true;
  bool cubePressed_ = false;  // true if the left button was pressed on the orientation cube
  bool painterReady_ = false;
  bool focusFramed_ = false;       // true if the focus came from the keyboard
  bool selectionOutdated_ = true;  // true if the graphics card has an older selection
  bool selectedHere_ = true;       // true if the selection was made in this view, or in no view
};

}  // namespace chainmail
