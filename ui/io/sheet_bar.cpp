#include "io/sheet_bar.h"

#include <QLocale>
#include <algorithm>

#include "mesh/sheet.h"

namespace chainmail {
namespace {

constexpr int maxAcross = 2000;  // 4 million elements for a square picture

std::array<std::uint32_t, 2> pixelsOf(QSize picture) {
  return {std::uint32_t(picture.width()), std::uint32_t(picture.height())};
}

}  // namespace

SheetBar::SheetBar()
    : AskBar(QStringLiteral("sheet"), QStringLiteral("Open s&heet"),
             QStringLiteral("Replaces the object with the picture as a sheet, as one undo step")),
      across_(new QSpinBox) {
  across_->setObjectName(QStringLiteral("sheetAcross"));
  across_->setAccessibleName(QStringLiteral("Elements across the picture"));
  across_->setToolTip(QStringLiteral("Number of elements along the width of the sheet; the height follows"));
  connect(across_, &QSpinBox::valueChanged, this, &SheetBar::describe);
  addField(QStringLiteral("Elements &across"), across_);
}

void SheetBar::ask(const QString& name, QSize picture) {
  picture_ = picture;
  across_->setRange(2, std::clamp(picture.width() + 1, 2, maxAcross));
  across_->setValue(standardAcross);
  describe();
  AskBar::ask(QStringLiteral("%1 as a sheet: %L2 × %L3 pixels").arg(name).arg(picture.width()).arg(picture.height()),
              across_);
  across_->selectAll();
}

void SheetBar::describe() {
  const auto [width, height] = sheet_size(pixelsOf(picture_), std::uint32_t(across_->value()));
  const double pixels = double(picture_.width()) / (width - 1);
  showResult(QStringLiteral("%L1 × %L2 elements, one every %3 pixels")
                 .arg(width)
                 .arg(height)
                 .arg(QLocale().toString(pixels, 'g', 4)));
}

}  // namespace chainmail
