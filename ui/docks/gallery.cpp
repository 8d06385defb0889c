#include "docks/gallery.h"

#include <QDir>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLocale>
#include <QScrollBar>
#include <QTimer>
#include <QToolButton>

#include "common/colours.h"
#include "io/samples.h"

namespace chainmail {
namespace {

constexpr int galleryColumns = 3;
constexpr QSize thumbnail{52, 39};  // logical pixels: all fit on a screen of 900 pixels
constexpr int pixelRatio = 2;       // of the thumbnail files
constexpr int smallestHeight = 76;  // one row

QIcon iconOf(const Sample& sample) {
  QPixmap picture(QStringLiteral(":/") + thumbnailOf(sample, colours::ground()));
  picture.setDevicePixelRatio(pixelRatio);
  return picture;
}

}  // namespace

Gallery::Gallery(const QString& folder) : folder_(folder), grid_(new QGridLayout) {
  setObjectName(QStringLiteral("gallery"));
  setAccessibleName(QStringLiteral("Samples"));
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setFocusPolicy(Qt::NoFocus);  // the buttons take the focus
  setMinimumHeight(smallestHeight);
  auto* content = new QWidget;
  content->setLayout(grid_);
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setSpacing(0);
  grid_->setAlignment(Qt::AlignTop);
  setWidget(content);
}

/// Loads the thumbnails after the window is painted for the first time.
void Gallery::showEvent(QShowEvent* event) {
  QScrollArea::showEvent(event);
  if (!std::exchange(filled_, true)) {
    QTimer::singleShot(0, this, &Gallery::fill);
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
    button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    button->setToolTip(
        QStringLiteral("%1: %2 elements (%3)\nClick: replaces the object with this sample")
            .arg(QString::fromUtf8(sample.what), QLocale().toString(sample.elements), QFileInfo(path).fileName()));
    connect(button, &QToolButton::clicked, this, [this, path] { emit chosen(path); });
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
