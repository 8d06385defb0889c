#pragma once

#include <QMenu>
#include <QObject>
#include <vector>

#include "common/jobs.h"
#include "io/pictures.h"
#include "panels/panel_area.h"

class QActionGroup;

namespace chainmail {

/// The File menu's pictures: of what, at which scale, with or without its ground; copied, or saved as PNG, SVG or PDF.
/// What is chosen is remembered.
class PictureActions : public QObject {
  Q_OBJECT

 public:
  PictureActions(QWidget& window, Document& document, PanelArea& area, Jobs& jobs);

  void fill(QMenu& menu);
  /// PNG, SVG or PDF by the ending. The picture is of now, whatever becomes of the object until it is written.
  void savePath(const QString& path);
  void copy();

 signals:
  void failed(const QString& sentence);
  /// What was done, for a short while.
  void noted(const QString& sentence);
  void saved(const QString& path);

 private:
  enum class What { window, panels, panel, object };
  struct Subject {
    QAction* action;
    What what;
    int panel;  // of the last two
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
