#pragma once

#include "chainmail/handle.h"
#include "python/object.h"

namespace chainmail::python {

/// A handle as Python holds it.
struct HeldHandle {
  explicit HeldHandle(api::Handle grabbed) : handle(std::move(grabbed)) {}
  api::Handle handle;
  Busy busy;
};

}  // namespace chainmail::python
