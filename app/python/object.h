#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "chainmail/body.h"
#include "chainmail/deformer.h"
#include "chainmail/job.h"

namespace chainmail::python {

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
  Use(Busy& busy, const char* what);
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  ~Use();

 private:
  Busy& busy_;
};

/// A body as Python holds it: alone, or owned by the deformer that moves it. chainmail.Body and chainmail.Deformer
/// share one, so a change through either of them is a change of the same object.
class Object {
 public:
  explicit Object(api::Body body) : alone_(std::move(body)) {}

  Busy& busy() { return busy_; }

  api::Body& body() { return deformer_ ? deformer_->body() : *alone_; }
  /// The deformer. Call this only while there is one.
  api::Deformer& deformer() { return *deformer_; }

  /// Gives the body to a new deformer. Throws Error if it has one, if there is no such method, and if the method does
  /// not work on the mesh.
  void attach(std::string_view method);
  /// The deformer is no longer used: another one may take the body.
  void detach() { is_attached_ = false; }
  void set_method(std::string_view method);
  /// True if a move may take long, as with the methods of elasticity, which prepare.
  bool is_slow() const { return is_slow_; }

  const api::Job& job() const { return jobs_.back(); }
  void set_job(const api::Job& job);

  // While there are views of the stored positions, nothing may change how they are stored.
  void add_view() { ++views_; }
  void remove_view() { --views_; }
  /// Throws Error if a view exists.
  void check_no_views(std::string_view before) const;

 private:
  void check_views(std::string_view method);
  void note_method(std::string_view method);

  Busy busy_;
  std::optional<api::Body> alone_;  // moved from when there is a deformer
  std::optional<api::Deformer> deformer_;
  bool is_attached_ = false;
  bool is_slow_ = false;
  std::vector<api::Job> jobs_{api::Job()};  // the last one is in use; the solver may still know the others
  int views_ = 0;                           // guarded by the lock of Python
};

using ObjectPointer = std::shared_ptr<Object>;

/// Marks a body as used.
class UseObject : public Use {
 public:
  explicit UseObject(Object& object) : Use(object.busy(), "body") {}
};

}  // namespace chainmail::python
