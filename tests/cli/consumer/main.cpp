#include <iostream>

#include "mesh/generate.h"
#include "simulate/simulation.h"

// A program that uses the installed library. It pulls the corner of a 3x3 grid two mesh units to the left.
int main() {
  using namespace chainmail;
  Simulation simulation(generate({MeshKind::grid, {3, 3, 1}}), Algorithm::natural_queue, Precision::double_precision);
  for (const Command& command :
       {Command(commands::Grab{0}), Command(commands::Drag{Point(-2, 0, 0)}), Command(commands::Release{})}) {
    simulation.apply(command);
  }
  simulation.refresh_statistics(true);
  std::cout << simulation.statistics().last_pass.moved << " moved\n";
  return simulation.statistics().violation.max < 1e-12 ? 0 : 1;
}
