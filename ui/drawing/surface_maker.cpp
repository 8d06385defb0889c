#include "drawing/surface_maker.h"

namespace chainmail {
namespace {

constexpr std::size_t mostCellsAtOnce = 100'000;  // about 30 ms

std::unique_ptr<Surface> makeSurface(const MeshPointer& mesh, const Progress& progress = {}) {
  return std::make_unique<Surface>(std::make_shared<CellTable>(mesh, progress));
}

}  // namespace

bool SurfaceMaker::has(const MeshPointer& mesh) {
  if (mesh != mesh_) {
    begin(mesh);
  }
  return !result_.valid() || result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::unique_ptr<Surface> SurfaceMaker::take(const MeshPointer& mesh) {
  if (mesh != mesh_) {
    begin(mesh);
  }
  if (result_.valid()) {
    surface_ = result_.get();
    table_ = surface_->table_pointer();
  }
  return surface_ != nullptr ? std::move(surface_) : std::make_unique<Surface>(table_);
}

void SurfaceMaker::begin(const MeshPointer& mesh) {
  giveUp();
  mesh_ = mesh;
  surface_.reset();
  if (mesh->tetrahedra.size() + mesh->hexahedra.size() <= mostCellsAtOnce) {
    surface_ = makeSurface(mesh);
    table_ = surface_->table_pointer();
    return;
  }
  job_ = std::make_unique<JobState>();
  std::promise<std::unique_ptr<Surface>> promise;
  result_ = promise.get_future();
  thread_ = std::thread([this, mesh, promise = std::move(promise)]() mutable {
    try {
      promise.set_value(makeSurface(mesh, Progress(*job_)));
      emit made();
    } catch (...) {  // cancelled, or out of memory: take() throws the exception
      promise.set_exception(std::current_exception());
    }
  });
}

void SurfaceMaker::giveUp() {
  if (thread_.joinable()) {
    job_->cancelled = true;
    thread_.join();
  }
  result_ = {};
}

}  // namespace chainmail
