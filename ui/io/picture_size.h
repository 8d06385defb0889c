#pragma once

#include <QDialog>
#include <QSize>
#include <algorithm>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSpinBox;

namespace chainmail {

/// The size of a picture that the user has chosen: a width in pixels or millimetres, and dots per inch for print.
struct PictureSize {
  static constexpr int usualDpi = 96;        // of a screen
  static constexpr int mostPixels = 12'000;  // a poster of A0 with 300 dpi has 9,933
  static constexpr double millimetresPerInch = 25.4;

  double width = 0;  // 0: as on the screen
  bool inMillimetres = false;
  int dpi = usualDpi;

  bool asOnScreen() const { return width == 0; }
  /// Width in pixels, at most mostPixels: a wide print gets fewer dots per inch.
  int pixels() const {
    return qRound(std::min<double>(inMillimetres ? width / millimetresPerInch * dpi : width, mostPixels));
  }
  /// Width in millimetres when it is printed.
  double millimetres() const { return inMillimetres ? width : width * millimetresPerInch / dpi; }
  /// What a file says, so that the picture has its width in millimetres when it is printed.
  double dotsPerMetre() const { return std::min(dpi * 1000 / millimetresPerInch, mostPixels * 1000 / millimetres()); }
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

}  // namespace chainmail
