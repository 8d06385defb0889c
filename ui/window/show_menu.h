#pragma once

#include <QObject>
#include <map>

#include "document/document.h"
#include "drawing/object_drawing.h"

namespace chainmail {

class Actions;

/// The View menu's choice of what all panels show of the object: links, surface, or both, and how surfaces in space are
/// shaded. The choices are stored. Sheets
/// with a picture have a separate stored choice, because links would cover the picture.
class ShowMenu : public QObject {
  Q_OBJECT

 public:
  ShowMenu(const Document& document, QObject* parent);
  void fill(Actions& actions);

  /// Returns the names of all choices.
  static QStringList names();
  DrawOptions drawOptions() const;
  /// Returns the name of the choice for this kind of object, as sessions store it.
  QString chosen() const;
  /// Chooses by name, as the user does. Ignores unknown names.
  void choose(const QString& name);
  /// Shows a choice without storing it, for a session or a lesson, until the user chooses.
  void show(const QString& name);
  /// Returns to the stored choices.
  void forgetShown();

 signals:
  void changed();

 private:
  const Document& document_;
  std::map<QString, QString> shown_;  // not stored; by the key of the stored choice
};

}  // namespace chainmail
