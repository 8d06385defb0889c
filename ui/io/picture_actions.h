#pragma once

#include <QDialog>
#include <QObject>
#include <QSize>
#include <algorithm>
#include <utility>
#include <vector>

#include "common/jobs.h"
#include "io/pictures.h"
#include "panels/panel_area.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSpinBox;

namespace chainmail {

class Actions;
struct ActionRow;

/// The size of a picture that the user has chosen: a width in pixels or millimetres, and dots per inch for print.
struct PictureSize {
  static constexpr int mostPixels = 12'000;  // a poster of A0 with 300 dpi has 9,933

  double width = 0;  // 0: as on the screen
  bool inMillimetres = false;
  int dpi = screenDpi;

  bool asOnScreen() const { return width == 0; }
  /// Width in pixels, at most mostPixels: a wide print gets fewer dots per inch.
  int pixels() const {
    return qRound(std::min<double>(inMillimetres ? width / millimetresPerInch * dpi : width, mostPixels));
  }
  /// Width in millimetres when it is printed.
  double millimetres() const { return inMillimetres ? width : width * millimetresPerInch / dpi; }
  /// What a file says, so that the picture has its width in millimetres when it is printed.
  double dotsPerMetre() const { return std::min(dpi * 1000 / millimetresPerInch, mostPixels * 1000 / millimetres()); }
  /// Shortest and longest width, in the unit.
  static std::pair<double, double> widths(bool inMillimetres) {
    return inMillimetres ? std::pair(10.0, 2'000.0) : std::pair(100.0, double(mostPixels));
  }
  /// Returns the size in words, such as '160 mm at 300 dpi' or 'as on the screen'.
  QString inWords() const;
  bool operator==(const PictureSize&) const = default;

  /// Read and store the size under a key of the settings.
  static PictureSize remembered(const QString& key);
  void remember(const QString& key) const;
};

/// Asks for the size of pictures, and shows how many pixels that is.
class PictureSizeDialog : public QDialog {
  Q_OBJECT

 public:
  /// `shape` is the size on the screen (pixels): the height follows the width.
  PictureSizeDialog(QWidget* parent, const QString& title, const PictureSize& size, QSize shape);
  PictureSize chosen() const;

 private:
  void makeFields(const PictureSize& size);
  void arrange();
  void takeUnit();
  void setUnit(bool inMillimetres);
  void describe();

  QSize shape_;
  QDoubleSpinBox* width_;
  QComboBox* unit_;
  QSpinBox* dpi_;
  QCheckBox* asOnScreen_;
  QLabel* pixels_;
};

/// The Picture submenu of the File menu: subject, size and background of pictures. Copies pictures, or saves them as
/// PNG, SVG or PDF. The choices are stored.
class PictureActions : public QObject {
  Q_OBJECT

 public:
  PictureActions(QWidget& window, Document& document, PanelArea& area, Jobs& jobs);

  void fill(Actions& actions);
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
    QString id;  // of its action
    What what;
    int panel = 0;  // for What::panel and What::object only
  };

  std::vector<ActionRow> subjectRows();
  std::vector<ActionRow> scaleRows();
  void choose(int scale);
  void askForSize();
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
  QString subject_;
  int scale_;  // times as on the screen; 0: own size
  PictureSize size_;
  bool transparent_;
};

}  // namespace chainmail
