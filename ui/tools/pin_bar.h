#pragma once

#include "common/ask_bar.h"
#include "document/document.h"
#include "document/pin_layers.h"

namespace chainmail {

/// Offers pins where a panel has no static answer, because nothing holds the object. It asks once the hand has let go,
/// and not again until another algorithm runs, another object is there, or pins came and went.
class PinBar : public AskBar {
  Q_OBJECT

 public:
  PinBar(Document& document, PinLayers& layers);

 signals:
  /// The user wants to pin by hand.
  void byHandChosen();

 private:
  void addChoices();
  void await(int panel);
  void offer();
  void follow();

  Document& document_;
  PinLayers& layers_;
  int panel_ = 0;        // the one that was found without an answer
  bool awaits_ = false;  // the hand to let go
  bool asked_ = false;
  QWidget* byHand_ = nullptr;
};

}  // namespace chainmail
