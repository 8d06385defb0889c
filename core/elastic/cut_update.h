#pragma once

#include "elastic/elastic.h"

namespace chainmail {

/// A solver that can go on after links were cut or restored, with less work than a new one needs.
class CutUpdate {
 public:
  virtual ~CutUpdate() = default;

  /// Goes on with these cuts of the same mesh, at rest or at the answer to the pins, without a handle. Later answers
  /// are those of a new solver, bit for bit. Returns false if it cannot: a new solver is needed then. Throws Error as
  /// making one does, and Cancelled; the solver is of no use after that.
  virtual bool recut(const Cuts& cuts, const Progress& progress) = 0;
};

}  // namespace chainmail
