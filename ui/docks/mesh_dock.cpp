#include "docks/mesh_dock.h"

#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLocale>
#include <QScreen>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "common/colours.h"
#include "common/dock_scroll.h"
#include "common/icons.h"
#include "common/text.h"
#include "document/edits.h"
#include "drawing/mesh_levels.h"
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

/// Largest size along an axis, for kinds with one, two and three sizes.
constexpr std::array largestSize{1'000'000, 1024, 100};
constexpr std::array axisNames{"W", "H", "D"};

QString capitalised(QString name) {
  name[0] = name[0].toUpper();
  return name;
}

const MeshKindInfo& infoOf(MeshKind kind) {
  return *std::find_if(mesh_kinds().begin(), mesh_kinds().end(), [kind](auto& info) { return info.kind == kind; });
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

QString recipeName(const MeshRecipe& recipe) {
  const MeshKindInfo& info = infoOf(recipe.kind);
  QStringList size;
  for (int k = 0; k < info.sizes; ++k) {
    size << QString::number(recipe.size[k]);
  }
  return QStringLiteral("%1 %2").arg(text(info.name), size.join(QStringLiteral("×")));
}

MeshDock::MeshDock(Document& document, Jobs& jobs)
    : document_(document),
      jobs_(jobs),
      kind_(new QComboBox),
      spacing_(new ParameterRow(parameters::spacing)),
      space_(new QComboBox),
      build_(new QPushButton(QStringLiteral("Build"))),
      description_(new QLabel) {
  kind_->setObjectName(QStringLiteral("meshKind"));
  for (const auto& info : mesh_kinds()) {
    kind_->addItem(capitalised(text(info.name)));
    kind_->setItemData(kind_->count() - 1, text(info.help), Qt::ToolTipRole);
  }
  kind_->setCurrentText(capitalised(text(infoOf(sampleRecipe().kind).name)));
  space_->setObjectName(QStringLiteral("spaceDimension"));
  space_->setToolTip(QStringLiteral("Number of coordinates: a 2D scene has no z"));
  kind_->setToolTip(QStringLiteral("Kind of the mesh: chain, surface or volume, with or without diagonal links"));
  build_->setToolTip(QStringLiteral("Replaces the object with this mesh, as one undo step"));
  build_->setObjectName(QStringLiteral("buildMesh"));
  description_->setTextFormat(Qt::RichText);
  description_->setObjectName(QStringLiteral("meshDescription"));
  description_->setWordWrap(true);
  arrange();

  connect(kind_, &QComboBox::currentIndexChanged, this, &MeshDock::adaptToKind);
  connect(build_, &QPushButton::clicked, this, &MeshDock::build);
  connect(&document, &Document::meshChanged, this, &MeshDock::describe);
  connect(&document, &Document::cutsChanged, this, &MeshDock::describe);
  describe();
}

QLayout* MeshDock::makeSizes() {
  auto* row = new QHBoxLayout;
  for (int k = 0; k < 3; ++k) {
    sizes_[k] = new QSpinBox;
    sizes_[k]->setObjectName(QStringLiteral("size%1").arg(QLatin1String(axisNames[k])));
    sizes_[k]->setAccessibleName(QStringLiteral("Elements along %1").arg(QLatin1Char("xyz"[k])));
    sizes_[k]->setToolTip(sizes_[k]->accessibleName());
    sizes_[k]->setKeyboardTracking(false);
    connect(sizes_[k], &QSpinBox::editingFinished, sizes_[k], &QWidget::clearFocus);  // shortcuts work again
    sizes_[k]->setRange(2, largestSize[0]);
    sizes_[k]->setValue(k == 2 ? 16 : int(sampleRecipe().size[k]));
    row->addWidget(sizes_[k]);
  }
  return row;
}

void MeshDock::arrange() {
  auto* open = new QPushButton(QStringLiteral("Open…"));
  auto* save = new QPushButton(QStringLiteral("Save…"));
  open->setIcon(icon("open"));
  open->setToolTip(QStringLiteral("Opens a session, mesh, volume or picture and replaces the object"));
  save->setIcon(icon("save"));
  save->setToolTip(QStringLiteral("Saves the object at rest, without cut links"));
  build_->setIcon(icon("mesh"));
  connect(open, &QPushButton::clicked, this, &MeshDock::openRequested);
  connect(save, &QPushButton::clicked, this, &MeshDock::saveRequested);
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  auto* form = new QFormLayout;
  form->addRow(QStringLiteral("Kind"), kind_);
  form->addRow(QStringLiteral("Size"), makeSizes());
  form->addRow(QStringLiteral("Space"), space_);
  column->addWidget(description_);
  auto* files = new QHBoxLayout;
  files->addWidget(open);
  files->addWidget(save);
  column->addLayout(files);
  column->addWidget(new QLabel(QStringLiteral("New mesh")));
  column->addLayout(form);
  column->addWidget(spacing_);
  column->addWidget(build_);
  column->addWidget(makeSamples());
  column->addStretch();
  adaptToKind();
  setWidget(new DockScroll(content));  // does not fit on a screen of 768 pixels
}

QWidget* MeshDock::makeSamples() {
  auto* button = new QPushButton(QStringLiteral("Samples…"));
  button->setObjectName(QStringLiteral("openSamples"));
  button->setIcon(icon("mesh"));
  button->setToolTip(QStringLiteral("Shows objects to try: a click on one replaces the object with it"));
  auto* gallery = new Gallery(samplesFolder(), this);
  connect(gallery, &Gallery::chosen, this, &MeshDock::sampleRequested);
  connect(button, &QPushButton::clicked, gallery, [gallery, button] { gallery->openBelow(*button); });
  return button;
}

void MeshDock::adaptToKind() {
  const int count = kind().sizes;
  for (int k = 0; k < 3; ++k) {
    sizes_[k]->setVisible(k < count);
    sizes_[k]->setRange(2, largestSize[count - 1]);
  }
  space_->clear();
  for (int dimension = count; dimension <= 3; ++dimension) {
    space_->addItem(QStringLiteral("%1D").arg(dimension), dimension);
  }
}

MeshRecipe MeshDock::recipe() const {
  MeshRecipe recipe;
  recipe.kind = kind().kind;
  for (int k = 0; k < 3; ++k) {
    recipe.size[k] = k < kind().sizes ? std::uint32_t(sizes_[k]->value()) : 1;
  }
  recipe.spacing = spacing_->value();
  recipe.space_dimension = space_->currentData().toInt();
  return recipe;
}

void MeshDock::build() {
  const QString name = recipeName(recipe());
  jobs_.start(Jobs::Kind::load, QStringLiteral("Building %1").arg(name),
              [this, name, recipe = recipe()](const Progress& progress) -> Jobs::Finish {
                const MeshPointer mesh = generate(recipe, progress.part(0, 0.8));
                prepareLevels(mesh, progress.part(0.8, 1));
                return [this, name, mesh] {
                  edits::replaceMesh(document_, mesh, name, QStringLiteral("build %1").arg(name));
                };
              });
}

void MeshDock::describe() {
  const Mesh& mesh = *document_.mesh();
  const QLocale locale;
  QString what = QStringLiteral("<b>%1</b><br>%2, %3")
                     .arg(document_.name().toHtmlEscaped(), counted(mesh.element_count(), QStringLiteral("element")),
                          counted(mesh.link_count(), QStringLiteral("link")));
  if (document_.cuts().count() != 0) {
    what += QStringLiteral(", %1 cut").arg(locale.toString(document_.cuts().count()));
  }
  if (document_.parts() > 1) {
    what += QStringLiteral(", %1 parts").arg(locale.toString(document_.parts()));
  }
  // A mesh of links only, without faces and lattice, may be of any dimension.
  const bool linksAlone = mesh.object_dimension == 1 && !mesh.lattice;
  const QStringList kinds{linksAlone ? QStringLiteral("links") : QStringLiteral("a chain"), QStringLiteral("a surface"),
                          QStringLiteral("a volume")};
  what += QStringLiteral("<br>%1 in %2D space").arg(kinds[mesh.object_dimension - 1]).arg(mesh.space_dimension);
  description_->setText(what);
}

}  // namespace chainmail
