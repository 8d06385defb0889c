#pragma once

#include <QMenu>
#include <QSpinBox>

#include "common/ask_bar.h"
#include "common/jobs.h"
#include "document/document.h"

namespace chainmail {

/// Gives a surface fewer elements: asks how many, and works in the background.
class Simplifying : public AskBar {
  Q_OBJECT

 public:
  Simplifying(Document& document, Jobs& jobs);

  void fill(QMenu& menu);
  /// Asks, offers a number of elements that suits filling, and emits readyToFill() when it is done.
  void askBeforeFilling(int elements);

 signals:
  void readyToFill();

 private:
  void makeFields();
  void adapt();
  void ask(int offered);
  void describe();
  void start();

  Document& document_;
  Jobs& jobs_;
  QSpinBox* elements_;
  QAction* action_ = nullptr;
  bool fillsNext_ = false;
};

}  // namespace chainmail
