#include "python/object.h"

#include <string>
#include <utility>

#include "chainmail/error.h"
#include "chainmail/method.h"

namespace chainmail::python {

using api::Error;

Use::Use(Busy& busy, const char* what) : busy_(busy) {
  if (busy.is_used_.exchange(true)) {
    throw Error(what, "another thread uses it", "wait until that thread is done, or give each thread a copy");
  }
}

Use::~Use() { busy_.is_used_ = false; }

void Object::check_no_views(std::string_view before) const {
  if (views_ > 0) {
    throw Error("body", "a view of its positions is in use",
                "delete the view or replace it by positions(), then " + std::string(before));
  }
}

/// Some methods store displacements or turned coordinates, which a view would show instead of positions.
void Object::check_views(std::string_view method) {
  if (!body().keeps_stored_positions(method)) {
    check_no_views("change the method");
  }
}

void Object::note_method(std::string_view method) {
  is_slow_ = api::method_info(method).family == api::MethodFamily::elastic;
}

void Object::attach(std::string_view method) {
  if (is_attached_) {
    throw Error("body", "it has a deformer already", "use that one and its set_method(), or a copy of the body");
  }
  // A deformer that refuses a body takes it along, so everything is checked before.
  api::check_method(method, body().mesh());
  check_views(method);
  api::Body taken = std::move(body());
  deformer_.emplace(std::move(taken), method);
  deformer_->set_job(job());
  is_attached_ = true;
  note_method(method);
}

void Object::set_method(std::string_view method) {
  check_views(method);
  deformer_->set_method(method);
  note_method(method);
}

void Object::set_job(const api::Job& job) {
  jobs_.push_back(job);
  if (deformer_) {
    deformer_->set_job(job);
  }
}

}  // namespace chainmail::python
