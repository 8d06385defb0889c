#pragma once

#include <QOpenGLWidget>
#include <memory>
#include <optional>

#include "common/colours.h"
#include "drawing/camera.h"
#include "drawing/frame_meter.h"
#include "drawing/object_painter.h"

namespace chainmail {

/// Draws the grid of the size test, with space around it for the handle.
class SizeTestView : public QOpenGLWidget {
  Q_OBJECT

 public:
  SizeTestView(std::shared_ptr<MeshLevels> levels, colours::Colour colour);
  ~SizeTestView() override;

  /// Shows a frame and the handle. The frame must not change until the next call.
  void show(const Frame& frame, std::optional<ElementId> handle);
  FrameMeter& meter() { return meter_; }

 signals:
  void failed(const QString& sentence);

 protected:
  void initializeGL() override;
  void paintGL() override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fit();
  void paint();
  ObjectPainter::Scene scene() const;

  colours::Colour colour_;
  Camera camera_;
  ObjectPainter painter_;
  FrameMeter meter_;
  Cuts uncut_;
  const Frame* frame_ = nullptr;
  MeshPointer fitted_;  // the mesh that the camera is fitted to
  std::optional<ElementId> handle_;
  bool ready_ = false;
};

}  // namespace chainmail
