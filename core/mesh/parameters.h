#pragma once

#include <limits>
#include <string_view>

#include "elastic/material.h"

namespace chainmail {

/// A number that a user may set. This one table feeds the docks, the command line, the checks and the
/// help texts.
struct Parameter {
  std::string_view name;   // on the command line
  std::string_view label;  // in the window
  std::string_view unit;
  double standard;         // the default
  double lowest, highest;  // what is accepted
  double slider_highest;   // what a slider spans, from lowest
  double step;             // one click
  int decimals;
  std::string_view help;
};

namespace parameters {

/// Any finite number from the lowest on.
inline constexpr double no_highest = std::numeric_limits<double>::max();
/// Any number that is not 0 or less.
inline constexpr double above_zero = std::numeric_limits<double>::min();

inline constexpr Parameter compression{"compression",
                                       "Compression",
                                       "of rest length",
                                       0.8,
                                       0,
                                       1,
                                       1,
                                       0.01,
                                       3,
                                       "how far a link may shorten, along each axis: 1 not at all, 0 to nothing"};
inline constexpr Parameter stretch{
    "stretch",
    "Stretch",
    "of rest length",
    1.2,
    1,
    no_highest,
    3,
    0.01,
    3,
    "how far a link may lengthen, along each axis: 1 not at all, 2 to twice its rest length"};
inline constexpr Parameter shear{"shear",
                                 "Shear",
                                 "of rest length",
                                 0.1,
                                 0,
                                 no_highest,
                                 1,
                                 0.01,
                                 3,
                                 "how far a link may lean, per length along the other axes: 0 not at all"};
inline constexpr Parameter relax_step{
    "relax-step",
    "Step",
    "of the way",
    1,
    0.01,
    1,
    1,
    0.05,
    2,
    "how far one relaxation step moves an element toward where its neighbours would have it"};
inline constexpr Parameter spacing{"spacing",  "Spacing", "mesh units", 1, above_zero,
                                   no_highest, 10,        0.1,          4, "distance between neighbouring elements"};

inline constexpr Parameter young{
    "young",
    "Young's modulus",
    "force per area",
    1,
    above_zero,
    no_highest,
    10,
    0.1,
    3,
    "how stiff the material is that ChainMail is compared with: forces scale with it, the shape "
    "under a given hand does not"};
inline constexpr Parameter poisson{"poisson",
                                   "Poisson's ratio",
                                   "of the stretch",
                                   0.3,
                                   0,
                                   0.499,
                                   0.499,
                                   0.01,
                                   3,
                                   "how much it narrows when it is pulled: 0 not at all, near 0.5 it keeps its volume"};
inline constexpr Parameter lattice{
    "lattice",
    "Control points",
    "along each axis",
    4,
    fewest_control_points,
    most_control_points,
    most_control_points,
    1,
    0,
    "control points of free-form deformation: more of them follow the hand more closely"};

}  // namespace parameters
}  // namespace chainmail
