#pragma once

#include <ostream>
#include <vector>

#include "body/method.h"

namespace chainmail {

/// Writes CSV `pass,order,element,sponsor,moved`: every candidate of every pass, in order. Passes and orders count
/// from 0. `moved` is 1 or 0. `sponsor` is -1 if there is none.
void write_trace_csv(std::ostream& out, const std::vector<Trace>& passes);

}  // namespace chainmail
