#pragma once

#include <QString>
#include <array>
#include <vector>

#include "document/change.h"

namespace chainmail {

/// Carries out the changes of a document: sends commands to its solvers, sets its contents, and emits its signals. For
/// the undo steps, the handle and the recorded moves of the document; everything else changes it by Document and
/// edits.h.
class ChangeExecutor {
 public:
  ChangeExecutor(Document& document, Contents& contents) : document_(document), contents_(contents) {}

  const Contents& contents() const { return contents_; }
  commands::StateId newState() { return nextState_++; }

  /// Sends a command to all solvers, and records it. The contents do not follow.
  void post(const Command& command);
  /// Sends the commands of a change.
  void carryOut(const Change& change, const Contents& before);
  /// The object of the solvers when settings are posted: undo and redo post them before they restore another one.
  enum class SolversHave { thisObject, anotherObject };
  void postSettings(const Contents& from, const Contents& to, SolversHave have);
  /// Lets the contents follow a change that the solvers have carried out.
  void show(Change& change, const Contents& from, const Contents& to, bool done);
  /// Sets the step of the lesson that the object is at the end of.
  void noteLessonStep(std::size_t step) { contents_.lesson.step = step; }

  /// Emits each refusal of a panel's solver only once, because every move of a drag is refused for the same reason.
  void reportRefusal(int panel, const QString& sentence);
  /// Begins a drag or an edit, whose refusals are emitted again.
  void forgetRefusals() { lastRefusal_ = {}; }

 private:
  void showParts(const Change& change, bool done);
  void showCuts(const std::vector<LinkId>& links, bool cut);
  void showPins(const std::vector<ElementId>& elements, bool pinned);
  void showMoves();
  std::vector<int> panelsToSwitch(const Contents& from, const Contents& to) const;
  void postAlgorithm(int panel, Algorithm algorithm);
  void replaceUnfitAlgorithms();

  Document& document_;
  Contents& contents_;
  commands::StateId nextState_ = 1;
  std::array<QString, Contents::maxPanels> lastRefusal_;  // one per panel, during the current drag or edit
};

}  // namespace chainmail
