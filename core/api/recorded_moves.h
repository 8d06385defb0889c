#pragma once

#include "api/access.h"
#include "report/run/cases.h"

namespace chainmail::api {

struct RecordedMoves::Impl {
  report::RecordedMoves moves;
  Mesh last_mesh;
};

}  // namespace chainmail::api
