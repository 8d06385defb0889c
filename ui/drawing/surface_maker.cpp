#include "drawing/surface_maker.h"

#include <chrono>
#include <system_error>
#include <utility>

#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::size_t maxCellsAtOnce = 100'000;  // about 30 ms

std::unique_ptr<Surface> makeSurface(const MeshPointer& mesh, const Progress& progress = {}) {
  return std::make_unique<Surface>(std::make_shared<CellTable>(mesh, progress));
}

}  // namespace

bool SurfaceMaker::has(const MeshPointer& mesh) {
  if (mesh != mesh_) {
    begin(mesh);
  }
  if (result_.valid() && result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    receive();
  }
  return !result_.valid() && !failure_;
}

bool SurfaceMaker::succeeds(const MeshPointer& mesh) {
  if (mesh != mesh_) {
    begin(mesh);
  }
  if (result_.valid()) {
    receive();
  }
  return !failure_;
}

std::unique_ptr<Surface> SurfaceMaker::take(const MeshPointer& mesh) {
  if (!succeeds(mesh)) {
    std::rethrow_exception(failure_);
  }
  return surface_ != nullptr ? std::move(surface_) : std::make_unique<Surface>(table_);
}

void SurfaceMaker::begin(const MeshPointer& mesh) {
  giveUp();
  mesh_.reset();  // until there is a result to wait for, or a failure
  surface_.reset();
  table_.reset();
  failure_ = nullptr;
  if (mesh->tetrahedra.size() + mesh->hexahedra.size() <= maxCellsAtOnce || !beginInBackground(mesh)) {
    std::promise<std::unique_ptr<Surface>> promise;
    result_ = promise.get_future();
    try {
      promise.set_value(makeSurface(mesh));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
    mesh_ = mesh;
    receive();
  }
}

/// Returns false if the system starts no thread.
bool SurfaceMaker::beginInBackground(const MeshPointer& mesh) {
  job_ = Progress::watched();
  const auto promise = std::make_shared<std::promise<std::unique_ptr<Surface>>>();
  try {
    thread_.add([this, mesh, job = job_, promise] {
      try {
        promise->set_value(makeSurface(mesh, job));
      } catch (...) {  // cancelled, or out of memory: take() throws the exception
        promise->set_exception(std::current_exception());
      }
      emit made();
    });
  } catch (const std::system_error&) {
    return false;
  }
  result_ = promise->get_future();
  mesh_ = mesh;
  return true;
}

/// Takes over the result, and waits for it.
void SurfaceMaker::receive() {
  try {
    surface_ = std::exchange(result_, {}).get();
    table_ = surface_->table_pointer();
  } catch (...) {
    failure_ = std::current_exception();
    emit failed(QString::fromStdString(failure_sentence("faces")));
  }
}

void SurfaceMaker::giveUp() {
  job_.cancel();
  thread_.finish();
  result_ = {};
}

}  // namespace chainmail
