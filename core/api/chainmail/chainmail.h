#pragma once

/// @file
/// Includes the whole public interface. Everything is in namespace chainmail::api; the usual short name is
/// `namespace cm = chainmail::api;`.

#include "chainmail/body.h"
#include "chainmail/calibrate.h"
#include "chainmail/compare.h"
#include "chainmail/deformer.h"
#include "chainmail/error.h"
#include "chainmail/handle.h"
#include "chainmail/job.h"
#include "chainmail/measure.h"
#include "chainmail/mesh.h"
#include "chainmail/mesh_file.h"
#include "chainmail/method.h"
#include "chainmail/own_method.h"
#include "chainmail/ramp.h"
#include "chainmail/state.h"
#include "chainmail/types.h"
