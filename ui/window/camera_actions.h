#pragma once

#include <QMenu>
#include <QObject>
#include <vector>

#include "panels/view.h"

namespace chainmail {

/// The cameras by keyboard: turn, shift, zoom. The keys count in the view that has the keyboard, as those of a list
/// count in the list; the menu's items in the view that had it last.
class CameraActions : public QObject {
  Q_OBJECT

 public:
  explicit CameraActions(QObject* parent);
  void fill(QMenu& menu) const;
  void attach(View& view);

 private:
  void add(const char* name, const QString& text, const char* icon, const QList<QKeySequence>& keys, const QString& tip,
           const std::function<void(View&)>& act);
  View* view() const;

  std::vector<QAction*> actions_;
  std::vector<View*> views_;
};

}  // namespace chainmail
