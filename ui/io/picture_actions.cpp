#include "io/picture_actions.h"

#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QSettings>
#include <QSpinBox>

#include "common/actions.h"
#include "common/number_field.h"
#include "common/text.h"
#include "io/questions.h"
#include "mesh/error.h"
#include "panels/panel.h"

namespace chainmail {
namespace {

constexpr int leastDpi = 36, mostDpi = 1'200;

constexpr std::array scales{1, 2, 4};
constexpr PictureSize pageWidth{160, true, 300};  // of the text of a page
constexpr int ownSize = 0;                        // in place of a scale

QString subjectKey() { return QStringLiteral("picture/of"); }
QString scaleKey() { return QStringLiteral("picture/scale"); }
QString sizeKey() { return QStringLiteral("picture/size"); }
QString transparentKey() { return QStringLiteral("picture/transparent"); }

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
  const auto [least, most] = widths(size.inMillimetres);
  size.width = width == 0 ? 0 : std::clamp(width, least, most);
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
  const auto [least, most] = PictureSize::widths(inMillimetres);
  width_->setRange(least, most);
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

PictureActions::PictureActions(QWidget& window, Document& document, PanelArea& area, Jobs& jobs)
    : QObject(&window),
      window_(window),
      document_(document),
      area_(area),
      jobs_(jobs),
      subject_(QSettings().value(subjectKey()).toString()),
      scale_(QSettings().value(scaleKey(), scales.front()).toInt()),
      size_(PictureSize::remembered(sizeKey())),
      transparent_(QSettings().value(transparentKey()).toBool()) {
  if (scale_ != ownSize && std::ranges::find(scales, scale_) == scales.end()) {
    scale_ = scales.front();
  }
  if (size_.asOnScreen()) {
    size_ = pageWidth;
  }
}

void PictureActions::fill(Actions& actions) {
  actions.add("File", {{"picture", "&Picture", "screenshot"}});
  actions.add("picture", subjectRows());
  actions.add("picture", {{}});
  actions.add("picture", scaleRows());
  actions.add("picture", {{"pictureTransparent", "&Transparent background", "", "",
                           "Pictures without a background, for use over other pictures",
                           [this](bool on) { QSettings().setValue(transparentKey(), transparent_ = on); },
                           IsOn([this] { return transparent_; })},
                          {},
                          {"copyPicture", "&Copy picture", "copy", "Ctrl+Shift+C",
                           "Copies the picture to the clipboard with these settings", [this] { copy(); }},
                          {"savePicture", "&Save picture…", "screenshot", "F12",
                           "Saves the picture with these settings as PNG, or the panels as SVG or PDF for print",
                           [this] { save(); }}});
}

std::vector<ActionRow> PictureActions::subjectRows() {
  std::vector<ActionRow> rows;
  const auto add = [&](const Subject& one, const QString& text, const char* tip) {
    subjects_.push_back(one);
    rows.emplace_back(
        one.id, text, "", "", tip, [this, one] { QSettings().setValue(subjectKey(), subject_ = one.id); },
        IsOn([this, one] { return subject().id == one.id; }),
        Appears([this, one] { return Appearance{.visible = one.panel < document_.panels()}; }));
  };
  add({"pictureOfWindow", What::window}, "Of the &window", "The whole window with its docks");
  add({"pictureOfPanels", What::panels}, "Of &all panels", "All visible panels, side by side");
  for (int panel = 0; panel < Document::maxPanels; ++panel) {
    const QString name = panelName(panel);
    add({"pictureOfPanel" + name, What::panel, panel}, "Of panel " + name,
        "The view with algorithm, legend and figures");
  }
  for (int panel = 0; panel < Document::maxPanels; ++panel) {
    const QString name = panelName(panel);
    add({"pictureOfObject" + name, What::object, panel}, "Of the object in " + name, "Only the view");
  }
  return rows;
}

std::vector<ActionRow> PictureActions::scaleRows() {
  std::vector<ActionRow> rows;
  rows.reserve(std::size(scales) + 1);
  for (const int times : scales) {
    rows.emplace_back(
        QStringLiteral("pictureScale%1").arg(times), QStringLiteral("&%1 ×").arg(times), "", "",
        times == 1 ? QStringLiteral("As many pixels as on the screen")
                   : QStringLiteral("%1 times as many pixels per side as on the screen, drawn sharp").arg(times),
        [this, times] { choose(times); }, IsOn([this, times] { return scale_ == times; }));
  }
  rows.emplace_back(
      "pictureOwnSize", "&Own size", "", "", "Asks for the width of pictures, in pixels or mm, and for dots per inch",
      [this] {
        choose(ownSize);
        askForSize();
      },
      IsOn([this] { return scale_ == ownSize; }),
      Appears([this] { return Appearance{.text = QStringLiteral("&Own size: %1…").arg(size_.inWords())}; }));
  return rows;
}

void PictureActions::choose(int scale) {
  scale_ = scale;
  QSettings().setValue(scaleKey(), scale);
}

void PictureActions::askForSize() {
  PictureSizeDialog dialog(&window_, QStringLiteral("Size of pictures"), size_, shownSubject().size());
  if (dialog.exec() == QDialog::Accepted) {
    size_ = dialog.chosen();
    size_.remember(sizeKey());
  }
}

/// Returns what is chosen, or the window if its panel does not exist.
const PictureActions::Subject& PictureActions::subject() const {
  const auto chosen = std::ranges::find(subjects_, subject_, &Subject::id);
  return chosen != subjects_.end() && chosen->panel < document_.panels() ? *chosen : subjects_.front();
}

/// Returns the panel of the picture. Throws Error if it is hidden.
Panel& PictureActions::shownPanel() const {
  const int number = subject().panel;
  Panel& panel = *area_.panels()[std::size_t(number)];
  if (!panel.isVisible()) {
    throw Error("picture", "panel " + panelName(number).toStdString() + " is hidden",
                "show it, or choose another one in File > Picture");
  }
  return panel;
}

QWidget& PictureActions::shownSubject() const {
  switch (subject().what) {
    case What::window:
      return window_;
    case What::panels:
      return area_;
    case What::panel:
      return shownPanel();
    default:
      return shownPanel().view();
  }
}

/// Returns how many times as many pixels per side as on the screen a picture has.
double PictureActions::scaleFor(const QWidget& drawn) const {
  return scale_ != ownSize    ? scale_
         : size_.asOnScreen() ? 1
                              : size_.pixels() / (drawn.width() * drawn.devicePixelRatioF());
}

/// Returns the picture of the subject: the window and the object as on the screen, panels as figures.
QImage PictureActions::picture() const {
  QWidget& drawn = shownSubject();
  const double scale = scaleFor(drawn);
  QImage picture = subject().what == What::panels  ? figureOf(area_, scale, transparent_)
                   : subject().what == What::panel ? figureOf(shownPanel(), scale, transparent_)
                                                   : pictureOf(drawn, scale, transparent_);
  if (scale_ == ownSize) {
    picture.setDotsPerMeterX(qRound(size_.dotsPerMetre()));
    picture.setDotsPerMeterY(picture.dotsPerMeterX());
  }
  return picture;
}

/// Returns the drawing of the subject. A drawing of the window shows the panels only, as docks have no vector drawing.
Drawing PictureActions::drawing() const {
  const What what = subject().what;
  Drawing drawing = what == What::panel    ? drawingOf(shownPanel(), transparent_)
                    : what == What::object ? drawingOf(shownPanel().view(), transparent_)
                                           : drawingOf(area_, transparent_);
  drawing.millimetres = scale_ == ownSize ? size_.millimetres() : 0;
  return drawing;
}

void PictureActions::copy() {
  try {
    QGuiApplication::clipboard()->setImage(picture());
    emit noted(QStringLiteral("Copied the picture to the clipboard"));
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

void PictureActions::save() {
  const QString path = askWhere(window_, QStringLiteral("Save picture"),
                                {QStringLiteral("PNG picture (*.png)"), QStringLiteral("Panels as SVG drawing (*.svg)"),
                                 QStringLiteral("Panels as PDF drawing (*.pdf)")},
                                asFileName(document_.name()));
  if (!path.isEmpty()) {
    savePath(path);
  }
}

void PictureActions::savePath(const QString& path) {
  std::function<void()> write;
  try {
    if (isDrawing(path)) {
      write = [path, what = drawing()] { writeDrawing(path, what); };
    } else {
      write = [path, what = picture()] { writePicture(path, what); };
    }
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
    return;
  }
  jobs_.start(Jobs::Kind::save, QStringLiteral("Saving %1").arg(QFileInfo(path).fileName()),
              [this, path, write](const Progress&) -> Jobs::Finish {
                write();
                return [this, path] { emit saved(path); };
              });
}

}  // namespace chainmail
