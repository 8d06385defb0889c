#pragma once

#include <QMenu>
#include <QToolButton>

#include "document/document.h"

namespace chainmail {

class View;

/// Chooses the panel whose object is drawn as a ghost over a panel's own object, and how the two are blended.
class GhostButton : public QToolButton {
  Q_OBJECT

 public:
  GhostButton(Document& document, View& view, int panel);

 private:
  void fill();
  void addChoice(const QString& text, std::optional<int> of);
  void addBlend();

  Document& document_;
  View& view_;
  int panel_;
  QMenu* menu_;
};

}  // namespace chainmail
