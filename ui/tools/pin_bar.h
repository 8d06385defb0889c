#pragma once

#include "common/ask_bar.h"
#include "document/document.h"
#include "tools/pin_layers.h"

namespace chainmail {

/// Offers to pin the object if a panel has no solution because no element is pinned. It asks when the drag has ended.
/// It asks again only after a change of an algorithm, the object or the pins.
class PinBar : public AskBar {
  Q_OBJECT

 public:
  PinBar(Document& document, PinLayers& layers);

 signals:
  /// The user wants to pin with the pin tool.
  void byHandChosen();

 private:
  void addChoices();
  void await(int panel);
  void offer();
  void follow();

  Document& document_;
  PinLayers& layers_;
  int panel_ = 0;        // the panel without a solution
  bool awaits_ = false;  // waits for the end of the drag
  bool asked_ = false;
  QWidget* byHand_ = nullptr;
};

}  // namespace chainmail
