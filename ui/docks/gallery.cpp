#include "docks/gallery.h"

#include <QDir>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLocale>
#include <QScreen>
#include <QToolButton>
#include <algorithm>

#include "common/colours.h"
#include "io/samples.h"

namespace chainmail {
namespace {

constexpr int galleryColumns = 4;
constexpr QSize thumbnail{52, 39};  // logical pixels
constexpr int pixelRatio = 2;       // of the thumbnail files

QIcon iconOf(const Sample& sample) {
  QPixmap picture(QStringLiteral(":/") + thumbnailOf(sample, colours::ground()));
  picture.setDevicePixelRatio(pixelRatio);
  return picture;
}

}  // namespace

Gallery::Gallery(const QString& folder, QWidget* parent)
    : QFrame(parent, Qt::Popup), folder_(folder), grid_(new QGridLayout(this)) {
  setObjectName(QStringLiteral("gallery"));
  setAccessibleName(QStringLiteral("Samples"));
  setFrameShape(QFrame::StyledPanel);
  grid_->setContentsMargins(6, 6, 6, 6);
  grid_->setSpacing(2);
}

void Gallery::openBelow(const QWidget& button) {
  if (grid_->isEmpty()) {
    fill();
  }
  adjustSize();
  const QRect screen = button.screen()->availableGeometry();
  const QPoint below = button.mapToGlobal(QPoint(0, button.height()));
  move(std::clamp(below.x(), screen.left(), std::max(screen.left(), screen.right() - width())),
       std::clamp(below.y(), screen.top(), std::max(screen.top(), screen.bottom() - height())));
  show();
}

/// The keyboard begins at the first sample.
void Gallery::showEvent(QShowEvent* event) {
  QFrame::showEvent(event);
  if (auto* first = grid_->isEmpty() ? nullptr : grid_->itemAt(0)->widget()) {
    first->setFocus(Qt::PopupFocusReason);
  }
}

void Gallery::fill() {
  int index = 0;
  for (const Sample& sample : samples()) {
    const QString path = QDir(folder_).filePath(QString::fromUtf8(sample.file));
    if (folder_.isEmpty() || !QFileInfo::exists(path)) {
      continue;
    }
    auto* button = new QToolButton;
    const QString title = QString::fromUtf8(sample.title);
    button->setObjectName(QStringLiteral("sample ") + QFileInfo(path).fileName());
    button->setText(title);
    button->setAccessibleName(QStringLiteral("Open the sample %1").arg(title));
    followTheme(*button, [button, &sample] { button->setIcon(iconOf(sample)); });
    button->setIconSize(thumbnail);
    button->setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
    button->setAutoRaise(true);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    button->setToolTip(
        QStringLiteral("%1: %2 elements (%3)\nClick: replaces the object with this sample")
            .arg(QString::fromUtf8(sample.what), QLocale().toString(sample.elements), QFileInfo(path).fileName()));
    connect(button, &QToolButton::clicked, this, [this, path] {
      hide();
      emit chosen(path);
    });
    grid_->addWidget(button, index / galleryColumns, index % galleryColumns);
    ++index;
  }
  if (index == 0) {
    auto* none = new QLabel(QStringLiteral("Sample files not found. Install the folder meshes with the program."));
    none->setObjectName(QStringLiteral("noSamples"));
    none->setWordWrap(true);
    grid_->addWidget(none, 0, 0);
  }
}

}  // namespace chainmail
