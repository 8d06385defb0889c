#pragma once

#include <QMenu>
#include <QObject>
#include <vector>

#include "common/jobs.h"
#include "io/pictures.h"
#include "panels/panel_area.h"

class QActionGroup;

namespace chainmail {

/// The File menu's Picture submenu: subject, scale and background of pictures; copies them, or saves them as PNG, SVG
/// or PDF. The choices are stored.
class PictureActions : public QObject {
  Q_OBJECT

 public:
  PictureActions(QWidget& window, Document& document, PanelArea& area, Jobs& jobs);

  void fill(QMenu& menu);
  /// Saves PNG, SVG or PDF by the ending. The picture shows the present state, even if the object changes before it is
  /// written.
  void savePath(const QString& path);
  void copy();

 signals:
  void failed(const QString& sentence);
  /// A note for the status bar.
  void noted(const QString& sentence);
  void saved(const QString& path);

 private:
  enum class What { window, panels, panel, object };
  struct Subject {
    QAction* action;
    What what;
    int panel;  // for panel and object
  };

  void fillSubjects(QMenu& menu);
  void addSubject(QMenu& menu, What what, int panel, const QString& text, const QString& tip);
  void fillScales(QMenu& menu);
  void fillTransparent(QMenu& menu);
  void followPanels();
  void save();
  const Subject& subject() const;
  Panel& shownPanel() const;
  QImage picture() const;
  Drawing drawing() const;

  QWidget& window_;
  Document& document_;
  PanelArea& area_;
  Jobs& jobs_;
  std::vector<Subject> subjects_;
  QActionGroup* scales_;
  QAction* transparent_ = nullptr;
};

}  // namespace chainmail
