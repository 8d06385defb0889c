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

/// What one thread at a time may use. Python lets another thread run while a pass has released its lock.
class Busy {
 public:
  explicit Busy(const char* name) : name_(name) {}
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  ~Busy() = default;

  bool is_used() const { return is_used_; }

 private:
  template <class Owner>
  friend class Used;

  const char* name_;  // in errors
  std::atomic<bool> is_used_ = false;
};

/// Marks what an object of Python refers to as used while this exists. A function that takes one as its argument marks
/// the argument during the call.
template <class Owner>
class Used {
 public:
  /// Throws Error if another thread uses it.
  explicit Used(Owner& owner) : one_(owner.used()) {
    if (one_.is_used_.exchange(true)) {
      throw Error(one_.name_, "another thread uses it", "wait until that thread is done, or give each thread a copy");
    }
  }
  Used(const Used&) = delete;
  Used& operator=(const Used&) = delete;
  ~Used() { one_.is_used_ = false; }

  auto& operator*() const { return one_; }
  auto* operator->() const { return &one_; }

 private:
  decltype(std::declval<Owner&>().used()) one_;
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
class Object : public Busy {
 public:
  /// Makes an object at rest. Throws Error if the mesh is out of the range of the precision.
  Object(MeshObjectPointer mesh, Precision precision);
  /// Copies the state. The copy has no deformer attached.
  Object(const Object& other);
  Object& operator=(const Object&) = delete;
  ~Object() = default;

  Object& used() { return *this; }
  const MeshObjectPointer& mesh_object() const { return mesh_; }
  const Mesh& mesh() const { return *mesh_->mesh; }
  Body& body() { return deformer_.body(); }
  Deformer& deformer() { return deformer_; }

  /// Attaches a deformer. Throws Error if there is one, and if the method does not work on the mesh.
  void attach(Algorithm method);
  void detach() { is_attached_ = false; }
  void set_method(Algorithm method);
  /// Splits this object, whose mesh is another one then. Call it with the lock of Python. Throws Error if the method
  /// does not work on that mesh, and if a view exists.
  void split(const SplitPointer& split);
  Algorithm method() const { return deformer_.algorithm(); }

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
  void check_no_views(const char* before) const;

 private:
  MeshObjectPointer mesh_;
  Deformer deformer_;
  bool is_attached_ = false;
  Progress job_ = Progress::watched();
  bool is_tracing_ = false;
  Trace trace_;
  int views_ = 0;  // guarded by the lock of Python
};
using ObjectPointer = std::shared_ptr<Object>;

/// The Python class Deformer: the right to move an object.
class Mover {
 public:
  Mover(ObjectPointer object, Algorithm method) : object_(std::move(object)) { Used<Object>(*object_)->attach(method); }
  Mover(const Mover&) = delete;
  Mover& operator=(const Mover&) = delete;
  ~Mover() { object_->detach(); }

  Object& used() const { return *object_; }
  const ObjectPointer& object() const { return object_; }

 private:
  ObjectPointer object_;
};

/// A handle, with the mesh that its elements belong to.
struct HeldHandle : Busy {
  HeldHandle(Object& object, std::vector<ElementId> elements)
      : Busy("handle"), handle(object.body(), std::move(elements)), mesh(object.mesh_object()->mesh) {}
  HeldHandle& used() { return *this; }

  Handle handle;
  MeshPointer mesh;
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
