#pragma once

#include "common/plot_pictures.h"  // the Report dock includes this header by its earlier name
