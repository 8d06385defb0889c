// The camera of a view: fitted, turned, shifted, brought nearer.

#include "panels/view.h"

namespace chainmail {

void View::setCamera(std::shared_ptr<Camera> camera) {
  camera_ = std::move(camera);
  fitPending_ = false;
  update();
}

void View::fit() {
  const Mesh& mesh = *document_.mesh();
  camera_->fit(bounds(mesh), std::span(mesh.axes).first(std::size_t(mesh.space_dimension)), size());
  fitPending_ = false;
  announceCamera();
}

void View::fitAgain() {
  if (camera_->framed()) {
    camera_->frame(bounds(*document_.mesh()), size());
    announceCamera();
  }
}

void View::announceCamera() {
  emit cameraChanged();
  update();
}

void View::lookFrom(double yaw, double pitch) {
  camera_->lookFrom(yaw, pitch);
  announceCamera();
}

void View::setParallel(bool parallel) {
  camera_->setParallel(parallel);
  announceCamera();
}

void View::orbit(QPointF pixels) {
  camera_->orbit(pixels);
  announceCamera();
}

void View::pan(QPointF pixels) {
  camera_->pan(pixels, size());
  announceCamera();
}

void View::zoom(double factor) { zoom(factor, QRectF(rect()).center()); }

void View::zoom(double factor, QPointF about) {
  camera_->zoom(factor, about, size());
  announceCamera();
}

}  // namespace chainmail
