#pragma once

#include <QMenu>
#include <QObject>
#include <map>

#include "document/document.h"
#include "drawing/look.h"

namespace chainmail {

/// The View menu's choice of what all panels show of the object: links, surface, or both. It is remembered, apart for
/// sheets that carry a picture, which links would cover.
class ShowMenu : public QObject {
  Q_OBJECT

 public:
  ShowMenu(const Document& document, QObject* parent);
  void fill(QMenu& menu);

  Look look() const;
  /// What is chosen for this kind of object, as the session keeps it; what has another name is no choice.
  QString chosen() const;
  void choose(const QString& name);

 signals:
  void changed();

 private:
  void adapt();

  const Document& document_;
  std::map<QString, QAction*> actions_;  // by name
};

}  // namespace chainmail
