#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "body/handle.h"
#include "body/softness.h"
#include "mesh/error.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solver/deformer.h"

namespace chainmail::python {

// What Python holds: a few objects of core together, with the marks that keep threads apart.

/// True while a thread uses the owner.
class Busy {
 public:
  Busy() = default;
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  ~Busy() = default;

  bool is_used() const { return is_used_; }

 private:
  friend class Use;
  std::atomic<bool> is_used_ = false;
};

/// Marks an object as used while it exists. One thread at a time may use an object; Python lets another thread run
/// while a pass has released its lock.
class Use {
 public:
  /// Throws Error if the object is in use. `what` is its name in the error.
  Use(Busy& busy, const char* what) : busy_(busy) {
    if (busy.is_used_.exchange(true)) {
      throw Error(what, "another thread uses it", "wait until that thread is done, or give each thread a copy");
    }
  }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  ~Use() { busy_.is_used_ = false; }

 private:
  Busy& busy_;
};

/// A mesh, with what its file says beside it.
struct MeshObject {
  MeshPointer mesh;
  OwnSoftness softness = {};  // of links that bodies of the mesh have from the beginning
  std::string remark = {};
};
using MeshObjectPointer = std::shared_ptr<MeshObject>;

/// A body: alone, or moved by the one deformer that is attached to it. chainmail.Body and chainmail.Deformer share one,
/// so a change through either of them is a change of the same object.
class Object {
 public:
  /// Makes an object at rest. Throws Error if the mesh is out of the range of the precision.
  Object(MeshObjectPointer mesh, Precision precision);
  /// Copies the state. The copy has no deformer attached.
  Object(const Object& other);
  Object& operator=(const Object&) = delete;
  ~Object() = default;

  Busy& busy() { return busy_; }
  const MeshObjectPointer& mesh_object() const { return mesh_; }
  const Mesh& mesh() const { return *mesh_->mesh; }
  Body& body() { return deformer_.body(); }
  Deformer& deformer() { return deformer_; }

  /// Attaches a deformer. Throws Error if there is one, if there is no such method, and if the method does not work on
  /// the mesh.
  void attach(std::string_view method);
  void detach() { is_attached_ = false; }
  void set_method(std::string_view method);
  std::string_view method() const { return info(deformer_.algorithm()).offered_name(); }
  /// True if a move may take long, as with the methods of elasticity, which prepare.
  bool is_slow() const { return info(deformer_.algorithm()).family() == Family::elastic; }

  const Progress& job() const { return job_; }
  void set_job(const Progress& job);
  /// Returns what receives the candidates of the next move, which is emptied; null if moves are not traced.
  Trace* new_trace();
  void set_tracing(bool on) { is_tracing_ = on; }
  const Trace& trace() const { return trace_; }

  // While there are views of the stored positions, nothing may change how they are stored.
  void add_view() { ++views_; }
  void remove_view() { --views_; }
  /// Throws Error if a view exists.
  void check_no_views(std::string_view before) const;

 private:
  void check_views(Algorithm algorithm);

  Busy busy_;
  MeshObjectPointer mesh_;
  Deformer deformer_;
  bool is_attached_ = false;
  Progress job_ = Progress::watched();
  bool is_tracing_ = false;
  Trace trace_;
  int views_ = 0;  // guarded by the lock of Python
};
using ObjectPointer = std::shared_ptr<Object>;

/// Marks a body as used.
class UseObject : public Use {
 public:
  explicit UseObject(Object& object) : Use(object.busy(), "body") {}
};

/// The Python class Deformer: the right to move an object.
class Mover {
 public:
  Mover(ObjectPointer object, std::string_view method) : object_(std::move(object)) {
    const UseObject use(*object_);
    object_->attach(method);
  }
  Mover(const Mover&) = delete;
  Mover& operator=(const Mover&) = delete;
  ~Mover() { object_->detach(); }

  const ObjectPointer& object() const { return object_; }

 private:
  ObjectPointer object_;
};

/// A handle, with the mesh that its elements belong to.
struct HeldHandle {
  HeldHandle(Object& object, std::vector<ElementId> elements)
      : handle(object.body(), std::move(elements)), mesh(object.mesh_object()->mesh) {}

  Handle handle;
  MeshPointer mesh;
  Busy busy;
};

/// A pose as a user gives it: its rotation is an axis and an angle.
struct UserPose {
  Point pivot = Point::Zero();  // mesh units
  Rotation rotation = {};

  static UserPose of(const Pose& pose) { return {pose.pivot, Rotation::of(pose.rotation)}; }
  Pose pose() const { return {pivot, rotation.vector()}; }
  bool operator==(const UserPose&) const = default;
};

}  // namespace chainmail::python
