#pragma once

#include <QMenu>
#include <QObject>
#include <vector>

#include "common/jobs.h"
#include "io/picture_size.h"
#include "io/pictures.h"
#include "panels/panel_area.h"

class QActionGroup;

namespace chainmail {

/// The Picture submenu of the File menu: subject, size and background of pictures. Copies pictures, or saves them as
/// PNG, SVG or PDF. The choices are stored.
class PictureActions : public QObject {
  Q_OBJECT

 public:
  PictureActions(QWidget& window, Document& document, PanelArea& area, Jobs& jobs);

  void fill(QMenu& menu);
  /// Saves PNG, SVG or PDF, by the extension. The picture shows the current state, even if the object changes before
  /// the file is written.
  void savePath(const QString& path);
  void copy();

 signals:
  void failed(const QString& sentence);
  /// Emitted with a note for the status bar.
  void noted(const QString& sentence);
  void saved(const QString& path);

 private:
  enum class What { window, panels, panel, object };
  struct Subject {
    QAction* action;
    What what;
    int panel;  // for What::panel and What::object only
  };

  void fillSubjects(QMenu& menu);
  void addSubject(QMenu& menu, What what, int panel, const QString& text, const QString& tip);
  void fillScales(QMenu& menu);
  void fillTransparent(QMenu& menu);
  void fillOwnSize(QMenu& menu);
  void askForSize();
  void showOwnSize();
  void followPanels();
  void save();
  const Subject& subject() const;
  QWidget& shownSubject() const;
  double scaleFor(const QWidget& drawn) const;
  Panel& shownPanel() const;
  QImage picture() const;
  Drawing drawing() const;

  QWidget& window_;
  Document& document_;
  PanelArea& area_;
  Jobs& jobs_;
  std::vector<Subject> subjects_;
  QActionGroup* scales_;
  QAction* ownSize_ = nullptr;
  PictureSize size_;
  QAction* transparent_ = nullptr;
};

}  // namespace chainmail
