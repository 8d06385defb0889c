#pragma once

/// @file
/// Includes what a first program needs: meshes, their files, a deformer, and measures. Everything is in namespace
/// chainmail. Installed headers have the paths of the source: `chainmail/ROOM/NAME.h`.

#include "body/body.h"
#include "body/handle.h"
#include "files/mesh/mesh_arrays.h"
#include "files/mesh/mesh_file.h"
#include "files/mesh/open_mesh.h"
#include "measure/violation.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solver/deformer.h"
