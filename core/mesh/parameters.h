#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace chainmail {

/// A number that a user may set. Docks, command line, help texts and checks all read the one entry of the table below.
struct Parameter {
  std::string_view name;   // on the command line and in errors
  std::string_view label;  // in the window
  std::string_view unit;
  double default_value;
  double lowest, highest;  // limits of accepted values
  double slider_highest;   // right end of the slider, which starts at `lowest`
  double step;             // one click
  int decimals;            // in the window
  std::string_view help;

  bool operator==(const Parameter&) const = default;
};

/// The table. To add a parameter, add an entry here; use it as the default of the value, and in the description of the
/// value's struct (described.h). A value without one has it in its check, its option and its ParameterRow.
namespace parameters {

/// No upper limit: any finite number from the lowest on.
inline constexpr double no_highest = std::numeric_limits<double>::max();
/// Lower limit of numbers that must be above 0.
inline constexpr double above_zero = std::numeric_limits<double>::min();
/// Upper limit of counts that have no other.
inline constexpr double highest_count = 1e9;
/// Upper limit of numbers that must be below 0.5: the largest double below it.
inline constexpr double below_half = 0.5 - std::numeric_limits<double>::epsilon() / 4;

inline constexpr Parameter compression{.name = "compression",
                                       .label = "Compression",
                                       .unit = "of rest length",
                                       .default_value = 0.8,
                                       .lowest = 0,
                                       .highest = 1,
                                       .slider_highest = 1,
                                       .step = 0.01,
                                       .decimals = 3,
                                       .help = "shortest length of a link along each axis: 1 rigid, 0 no limit"};
inline constexpr Parameter stretch{
    .name = "stretch",
    .label = "Stretch",
    .unit = "of rest length",
    .default_value = 1.2,
    .lowest = 1,
    .highest = no_highest,
    .slider_highest = 3,
    .step = 0.01,
    .decimals = 3,
    .help = "greatest length of a link along each axis: 1 rigid, 2 twice its rest length"};
inline constexpr Parameter shear{.name = "shear",
                                 .label = "Shear",
                                 .unit = "of length along the other axes",
                                 .default_value = 0.1,
                                 .lowest = 0,
                                 .highest = no_highest,
                                 .slider_highest = 1,
                                 .step = 0.01,
                                 .decimals = 3,
                                 .help = "how far a link may lean, per length along the other axes: 0 not at all"};
inline constexpr Parameter lateral{
    .name = "lateral",
    .label = "Lateral stiffness",
    .unit = "of stiffness along the link",
    .default_value = 1,
    .lowest = 0,
    .highest = 1e6,
    .slider_highest = 2,
    .step = 0.01,
    .decimals = 3,
    .help = "stiffness of a link against sideways motion, per its stiffness along it: 0 turns freely"};
inline constexpr Parameter stiffness{.name = "stiffness",
                                     .label = "Link stiffness",
                                     .unit = "relative to other links",
                                     .default_value = 1,
                                     .lowest = 1e-12,
                                     .highest = 1e12,
                                     .slider_highest = 10,
                                     .step = 0.1,
                                     .decimals = 3,
                                     .help = "how strongly a link returns to its rest vector, relative to other links"};
inline constexpr Parameter exponent{
    .name = "exponent",
    .label = "Length exponent",
    .unit = "power of rest length",
    .default_value = -1,
    .lowest = -4,
    .highest = 4,
    .slider_highest = 4,
    .step = 0.25,
    .decimals = 2,
    .help = "power of its rest length by which the stiffness of a link is multiplied: -1 a bar, 0 no effect"};
inline constexpr Parameter relax_step{
    .name = "relax-step",
    .label = "Step",
    .unit = "of the way",
    .default_value = 1,
    .lowest = above_zero,
    .highest = 1,
    .slider_highest = 1,
    .step = 0.05,
    .decimals = 2,
    .help = "share of the way to its relaxed position that an element moves in one sweep"};
inline constexpr std::string_view fine_where_needed =
    "with the scheme equilibrium and open regions, in large objects: fine only near the handle and cuts while it moves";
inline constexpr Parameter relax_until{
    .name = "relax-until",
    .label = "Residual",
    .unit = "relative",
    .default_value = 1e-3,
    .lowest = 0,
    .highest = 1,
    .slider_highest = 0.1,
    .step = 1e-3,
    .decimals = 4,
    .help = "residual at which relaxation to the equilibrium ends: 0 runs all iterations"};
inline constexpr Parameter relax_sweeps{.name = "sweeps",
                                        .label = "Sweeps",
                                        .unit = "at most",
                                        .default_value = 1,
                                        .lowest = 0,
                                        .highest = 1e6,
                                        .slider_highest = 100,
                                        .step = 1,
                                        .decimals = 0,
                                        .help = "sweeps of relaxation, or iterations to the equilibrium"};
inline constexpr Parameter spacing{.name = "spacing",
                                   .label = "Spacing",
                                   .unit = "mesh units",
                                   .default_value = 1,
                                   .lowest = above_zero,
                                   .highest = no_highest,
                                   .slider_highest = 10,
                                   .step = 0.1,
                                   .decimals = 4,
                                   .help = "distance between neighbouring elements"};
inline constexpr Parameter young{.name = "young",
                                 .label = "Young's modulus",
                                 .unit = "force per area",
                                 .default_value = 1,
                                 .lowest = above_zero,
                                 .highest = no_highest,
                                 .slider_highest = 10,
                                 .step = 0.1,
                                 .decimals = 3,
                                 .help = "stiffness of the elastic material: scales forces, does not change the shape"};
inline constexpr Parameter poisson{
    .name = "poisson",
    .label = "Poisson's ratio",
    .unit = "sideways per lengthwise strain",
    .default_value = 0.3,
    .lowest = 0,
    .highest = below_half,
    .slider_highest = 0.499,
    .step = 0.01,
    .decimals = 3,
    .help = "how much the elastic material narrows when stretched: 0 not at all, near 0.5 keeps its volume"};
inline constexpr Parameter gent_limit{
    .name = "gent-limit",
    .label = "Limit of strain",
    .unit = "of I1 - 3",
    .default_value = 2,
    .lowest = above_zero,
    .highest = 1e6,
    .slider_highest = 100,
    .step = 0.1,
    .decimals = 3,
    .help = "bound of I1 - 3, the sum of the squared principal stretches less 3, in the material 'gent'"};
inline constexpr Parameter fung_exponent{
    .name = "fung-exponent",
    .label = "Exponent",
    .unit = "per I1 - 3",
    .default_value = 0.5,
    .lowest = above_zero,
    .highest = 1e3,
    .slider_highest = 10,
    .step = 0.1,
    .decimals = 3,
    .help = "factor of I1 - 3 in the exponential of the material 'fung': more stiffens earlier"};
inline constexpr Parameter thickness{
    .name = "thickness",
    .label = "Thickness",
    .unit = "of the longest side",
    .default_value = 0.01,
    .lowest = 1e-4,
    .highest = 1,
    .slider_highest = 0.1,
    .step = 1e-3,
    .decimals = 4,
    .help = "thickness of a surface in space, per longest side of its bounds: a thinner one bends more easily"};
inline constexpr Parameter lattice{.name = "lattice",
                                   .label = "Control points",
                                   .unit = "along each axis",
                                   .default_value = 4,
                                   .lowest = 2,
                                   .highest = 8,
                                   .slider_highest = 8,
                                   .step = 1,
                                   .decimals = 0,
                                   .help = "control points of free-form deformation along each axis"};
inline constexpr Parameter iterations{
    .name = "iterations",
    .label = "Iterations",
    .unit = "per move, at most",
    .default_value = 2000,
    .lowest = 1,
    .highest = 100'000,
    .slider_highest = 10'000,
    .step = 100,
    .decimals = 0,
    .help = "most iterations of a method that iterates, for one move: they stop earlier if they converge"};

}  // namespace parameters

/// Returns the accepted range in words, like "0 to 1", "1 or more" or "a number above 0".
std::string range_of(const Parameter& parameter);
/// Throws Error, with the parameter's name and range, if the value is out of range. NaN is out of range.
void check(const Parameter& parameter, double value);

}  // namespace chainmail
