#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "chainmail/body.h"
#include "chainmail/job.h"
#include "chainmail/measure.h"
#include "chainmail/types.h"

namespace chainmail::api {

/// Effort of a calibration. The same options give the same result on every machine.
struct CalibrateOptions {
  std::string method = "natural-queue";  ///< A method of the ChainMail family.
  std::uint64_t seed = 1;                ///< Random seed of the drags.
  int drags = 4;                         ///< Number of drags that the search uses, at least 1.
  int held_out = 4;                      ///< Number of drags that only test the result, at least 1.
  int evaluations = 200;                 ///< Largest number of evaluations, at least 1; each runs all drags.
  int most_sweeps = 100;                 ///< Largest number of sweeps that is tried, of 0, 1, 3, 10, 30 and 100.
  RelaxationScheme scheme = RelaxationScheme::equilibrium;  ///< Relaxation scheme; `equilibrium` needs no sweeps.
};

/// Errors against the reference solution, means over drags; the maxima are the largest.
struct CalibrationErrors {
  PhysicalError nothing = {};  ///< If only the handle moves.
  PhysicalError before = {};   ///< With the default softness, without sweeps or at equilibrium.
  PhysicalError after = {};    ///< With the result.
};

/// The softness that comes closest to an elastic material.
struct Calibration {
  LinkSoftness softness = {};       ///< Softness of all links, for the energy that was calibrated.
  int sweeps = 0;                   ///< Sweeps of relaxation after each move; 0 with the scheme `equilibrium`.
  int evaluations = 0;              ///< Number of evaluations that were made.
  CalibrationErrors fitted = {};    ///< On the drags that the search used.
  CalibrationErrors held_out = {};  ///< On drags that the search did not use.
  std::string json = {};            ///< All figures, drag by drag, as `chainmail calibrate --json` writes them.
};

/// Finds the softness of all links that has the lowest mean relative error against neo-Hookean finite elements on the
/// same cells. With the scheme `equilibrium`, it varies regions, lateral stiffness and exponent, by Sbplx (Rowan 1990)
/// from several starts; with sweeps, the regions and the number of sweeps, by DIRECT-L (Gablonsky and Kelley 2001),
/// then Sbplx. Each drag moves a random element by 5 to 20 % of the object's size. The object gives its mesh, cuts,
/// pins, elasticity and kind of energy (that of the material stands for corotated links); it does not change.
///
/// Throws Error if nothing is pinned, if the method is unknown or not of the ChainMail family, if an option is out of
/// its range, if the object has no static solution, and if no reference solution converges; and Cancelled.
Calibration calibrate(const Body& body, const CalibrateOptions& options = {}, const Job& job = {});

/// Writes one named softness into a file (JSON), which the workbench and `chainmail compare --preset` open. The name is
/// one line of UTF-8, of at most 60 bytes. Throws Error about a name that is not valid, a softness that is out of its
/// range, a file that cannot be written, and if the library was built without nlohmann/json.
void write_preset(const std::filesystem::path& path, const std::string& name, const LinkSoftness& softness);

}  // namespace chainmail::api
