#pragma once

#include <string_view>
#include <utility>

#include "python/object.h"

namespace chainmail::python {

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

}  // namespace chainmail::python
