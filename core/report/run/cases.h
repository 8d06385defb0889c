#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "simulate/command.h"

namespace chainmail::report {

/// What a hand did, as commands from rest. The last `Release` is left out where the hand shall still hold
/// when the errors are measured.
struct RecordedMoves {
  std::string name;
  std::string description;
  std::vector<Command> commands;
};

/// An object at rest, and the drags that are tried on it.
struct Case {
  std::string name;
  std::string description;
  MeshPointer mesh;
  std::vector<LinkId> cuts;
  std::vector<ElementId> pins;
  Softness softness;
  std::vector<RecordedMoves> drags;
  ElasticOptions elastic = {};
};

/// The objects on which the algorithms are compared where nobody says otherwise, each with its three drags.
/// `softness` is that of every link but those of the stiff inclusion.
std::vector<Case> default_cases(const LinkSoftness& softness);

/// Three drags for an object: local (the element nearest the middle goes as far as makes about an eighth of
/// the object follow), whole body (an element of the boundary is pulled outward until all follow, and as far
/// again) and back and forth (the middle goes until all follow, and back to where it was). Distances are
/// found with Exact ChainMail, so they do not depend on who is compared.
/// Where `stop` is requested they are cut short.
std::vector<RecordedMoves> three_drags(const Case& object, const std::stop_token& stop = {});

}  // namespace chainmail::report
