#include "io/picture_size.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QSettings>
#include <QSpinBox>
#include <algorithm>

#include "common/number_field.h"

namespace chainmail {
namespace {

constexpr int leastPixels = 100;
constexpr int leastMillimetres = 10, mostMillimetres = 2'000;
constexpr int leastDpi = 36, mostDpi = 1'200;

}  // namespace

QString PictureSize::inWords() const {
  if (asOnScreen()) {
    return QStringLiteral("as on the screen");
  }
  return QStringLiteral("%1 %2 at %3 dpi")
      .arg(QLocale().toString(width, 'f', inMillimetres && width != qRound(width) ? 1 : 0),
           inMillimetres ? QStringLiteral("mm") : QStringLiteral("pixels"))
      .arg(dpi);
}

PictureSize PictureSize::remembered(const QString& key) {
  const QSettings settings;
  PictureSize size;
  size.inMillimetres = settings.value(key + QStringLiteral("/millimetres"), size.inMillimetres).toBool();
  const double width = settings.value(key + QStringLiteral("/width"), size.width).toDouble();
  size.width = width == 0           ? 0
               : size.inMillimetres ? std::clamp<double>(width, leastMillimetres, mostMillimetres)
                                    : std::clamp<double>(width, leastPixels, PictureSize::mostPixels);
  size.dpi = std::clamp(settings.value(key + QStringLiteral("/dpi"), size.dpi).toInt(), leastDpi, mostDpi);
  return size;
}

void PictureSize::remember(const QString& key) const {
  QSettings settings;
  settings.setValue(key + QStringLiteral("/millimetres"), inMillimetres);
  settings.setValue(key + QStringLiteral("/width"), width);
  settings.setValue(key + QStringLiteral("/dpi"), dpi);
}

PictureSizeDialog::PictureSizeDialog(QWidget* parent, const QString& title, const PictureSize& size, QSize shape)
    : QDialog(parent),
      shape_(shape),
      width_(new NumberField(QStringLiteral("Width"))),
      unit_(new QComboBox),
      dpi_(new QSpinBox),
      asOnScreen_(new QCheckBox(QStringLiteral("&As on the screen"))),
      pixels_(new QLabel) {
  setObjectName(QStringLiteral("pictureSizeDialog"));
  setWindowTitle(title);
  makeFields(size);
  arrange();
  connect(asOnScreen_, &QCheckBox::toggled, this, &PictureSizeDialog::describe);
  connect(unit_, &QComboBox::currentIndexChanged, this, &PictureSizeDialog::takeUnit);
  connect(width_, &QDoubleSpinBox::valueChanged, this, &PictureSizeDialog::describe);
  connect(dpi_, &QSpinBox::valueChanged, this, &PictureSizeDialog::describe);
  describe();
}

void PictureSizeDialog::makeFields(const PictureSize& size) {
  asOnScreen_->setObjectName(QStringLiteral("pictureAsOnScreen"));
  asOnScreen_->setToolTip(QStringLiteral("As many pixels as on the screen"));
  asOnScreen_->setChecked(size.asOnScreen());
  unit_->setObjectName(QStringLiteral("pictureUnit"));
  unit_->setAccessibleName(QStringLiteral("Unit of the width"));
  unit_->setToolTip(QStringLiteral("Unit of the width"));
  unit_->addItems({QStringLiteral("pixels"), QStringLiteral("mm")});
  unit_->setCurrentIndex(size.inMillimetres ? 1 : 0);
  width_->setObjectName(QStringLiteral("pictureWidth"));
  width_->setToolTip(QStringLiteral("Width of the picture; the height follows"));
  setUnit(size.inMillimetres);
  width_->setValue(size.asOnScreen() ? shape_.width() : size.width);
  dpi_->setObjectName(QStringLiteral("pictureDpi"));
  dpi_->setToolTip(QStringLiteral("Dots per inch in print: 300 is usual for a page, 96 for a screen"));
  dpi_->setRange(leastDpi, mostDpi);
  dpi_->setValue(size.dpi);
  pixels_->setObjectName(QStringLiteral("picturePixels"));
}

void PictureSizeDialog::arrange() {
  auto* row = new QHBoxLayout;
  row->addWidget(width_, 1);
  row->addWidget(unit_);
  auto* form = new QFormLayout(this);
  form->addRow(asOnScreen_);
  auto* width = new QLabel(QStringLiteral("&Width"));  // the form makes no buddy of a layout
  width->setBuddy(width_);
  form->addRow(width, row);
  form->addRow(QStringLiteral("&Dots per inch"), dpi_);
  form->addRow(QStringLiteral("Picture"), pixels_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

PictureSize PictureSizeDialog::chosen() const {
  const bool own = !asOnScreen_->isChecked();
  return {own ? width_->value() : 0, own && unit_->currentIndex() == 1, dpi_->value()};
}

/// Keeps the size and shows it in the chosen unit.
void PictureSizeDialog::takeUnit() {
  const bool inMillimetres = unit_->currentIndex() == 1;
  const PictureSize before{width_->value(), !inMillimetres, dpi_->value()};
  const double width = inMillimetres ? before.millimetres() : before.pixels();
  setUnit(inMillimetres);
  width_->setValue(width);
}

void PictureSizeDialog::setUnit(bool inMillimetres) {
  width_->setDecimals(inMillimetres ? 1 : 0);
  width_->setRange(inMillimetres ? leastMillimetres : leastPixels,
                   inMillimetres ? mostMillimetres : PictureSize::mostPixels);
}

void PictureSizeDialog::describe() {
  const bool own = !asOnScreen_->isChecked();
  for (QWidget* field : std::initializer_list<QWidget*>{width_, unit_, dpi_}) {
    field->setEnabled(own);
  }
  PictureSize size = chosen();
  if (!own) {
    size = {double(shape_.width()), false, size.dpi};
  }
  const int height = qRound(double(size.pixels()) * shape_.height() / std::max(1, shape_.width()));
  pixels_->setText(QStringLiteral("%L1 × %L2 pixels, %3 mm wide in print")
                       .arg(size.pixels())
                       .arg(height)
                       .arg(QLocale().toString(size.millimetres(), 'f', 1)));
}

}  // namespace chainmail
