#pragma once

/// @file
/// Includes the whole public interface. Everything is in namespace chainmail::api; the usual short name is
/// `namespace cm = chainmail::api;`.

#include "chainmail/body.h"
#include "chainmail/calibrate.h"
#include "chainmail/compare.h"
#include "chainmail/deformer.h"
#include "chainmail/error.h"
#include "chainmail/files.h"
#include "chainmail/handle.h"
#include "chainmail/job.h"
#include "chainmail/measure.h"
#include "chainmail/mesh.h"
#include "chainmail/mesh_file.h"
#include "chainmail/method.h"
#include "chainmail/moves.h"
#include "chainmail/options.h"
#include "chainmail/own_method.h"
#include "chainmail/preset.h"
#include "chainmail/ramp.h"
#include "chainmail/repair.h"
#include "chainmail/session.h"
#include "chainmail/simulation.h"
#include "chainmail/state.h"
#include "chainmail/suite.h"
#include "chainmail/text.h"
#include "chainmail/types.h"
