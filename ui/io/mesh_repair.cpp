#include "io/mesh_repair.h"

#include <QAccessible>
#include <QDoubleValidator>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <span>

#include "common/actions.h"
#include "common/colours.h"
#include "common/icons.h"
#include "common/text.h"
#include "document/edits.h"
#include "files/repair/defects.h"
#include "mesh/error.h"
#include "mesh/mesh.h"

namespace chainmail {
namespace {

/// Returns phrases in which a line does not break.
QStringList withoutBreaks(const std::vector<std::string>& phrases) {
  QStringList whole;
  for (const std::string& phrase : phrases) {
    whole << text(phrase).replace(QLatin1Char(' '), QChar::Nbsp);
  }
  return whole;
}

QLabel* makeText(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(QLatin1String(name));
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  return label;
}

/// Elements that Show selects together.
struct DefectGroup {
  QString name;
  std::vector<ElementId> elements;  // ascending
};

std::vector<ElementId> ascending(std::vector<ElementId> elements) {
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

/// Returns what Show selects, one after another: all duplicates, all loose points, each hole, all other edges, all
/// cells.
std::vector<DefectGroup> groupsOf(const Mesh& mesh, const Defects& defects) {
  std::vector<DefectGroup> all;
  const auto add = [&all](const QString& name, const std::vector<ElementId>& elements) {
    if (!elements.empty()) {
      all.push_back({name, ascending(elements)});
    }
  };
  add(QStringLiteral("duplicate vertices"), defects.duplicates);
  add(QStringLiteral("loose points"), defects.loose);
  for (std::size_t i = 0; i < defects.holes.size(); ++i) {
    add(QStringLiteral("hole %L1 of %L2, %L3 edges").arg(i + 1).arg(defects.holes.size()).arg(defects.holes[i].size()),
        defects.holes[i]);
  }
  std::vector<ElementId> ends;
  for (const auto& edge : defects.non_manifold) {
    ends.insert(ends.end(), edge.begin(), edge.end());
  }
  add(QStringLiteral("non-manifold edges"), ends);
  std::vector<ElementId> corners;
  for (const std::uint32_t cell : defects.inverted) {
    const bool isTetrahedron = cell < mesh.tetrahedra.size();
    const std::span<const ElementId> of =
        isTetrahedron ? std::span<const ElementId>(mesh.tetrahedra[cell])
                      : std::span<const ElementId>(mesh.hexahedra[cell - mesh.tetrahedra.size()]);
    corners.insert(corners.end(), of.begin(), of.end());
  }
  add(QStringLiteral("cells inside out"), corners);
  return all;
}

QString nothingToRepair(const QString& name, const Defects& defects) {
  return QStringLiteral("%1 has no defects to repair").arg(name) +
         (defects.outlines == 0
              ? QString()
              : QStringLiteral(". %1 not a hole but the outline of an open surface")
                    .arg(defects.outlines == 1 ? QStringLiteral("Its border is")
                                               : QStringLiteral("Each of its %L1 borders is").arg(defects.outlines)));
}

}  // namespace

RepairBar::RepairBar() : row_(new QHBoxLayout(this)), text_(makeText("repairText")), shown_(makeText("repairShown")) {
  setObjectName(QStringLiteral("repairBar"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  auto* words = new QVBoxLayout;
  words->setSpacing(0);
  words->addWidget(text_);
  words->addWidget(shown_);
  row_->setContentsMargins(10, 4, 6, 4);
  row_->addLayout(words, 1);
  show_ = addButton(QStringLiteral("&Show"), "repairShow",
                    QStringLiteral("Selects the elements of one defect. Each click selects the next one"),
                    &RepairBar::showRequested);
  weld_ = addButton(QStringLiteral("&Weld"), "repairWeld",
                    QStringLiteral("Joins vertices that are as close as the distance beside this button, as one undo "
                                   "step. The object is then at rest, without cuts and pins"),
                    &RepairBar::weldRequested);
  addWeldDistance();
  loose_ = addButton(QStringLiteral("Remove loose &points"), "repairLoose",
                     QStringLiteral("Removes elements without links, as one undo step. The object is then at rest, "
                                    "without cuts and pins"),
                     &RepairBar::removeLooseRequested);
  holes_ = addButton(QStringLiteral("C&lose holes"), "repairHoles",
                     QStringLiteral("Closes the holes with triangles, as one undo step; all ids stay. The object is "
                                    "then at rest, without cuts and pins"),
                     &RepairBar::closeHolesRequested);
  cells_ =
      addButton(QStringLiteral("&Turn cells"), "repairCells",
                QStringLiteral("Turns cells that are inside out, as one undo step; all ids stay. Methods for cells "
                               "need this. The object is then at rest, without cuts and pins"),
                &RepairBar::turnCellsRequested);
  addClose();
  hide();
  followTheme(*this, [this] {
    QPalette own;
    own.setColor(QPalette::Window, colours::warningGround);
    setPalette(own);
  });
}

QPushButton* RepairBar::addButton(const QString& text, const char* name, const QString& help,
                                  void (RepairBar::*request)()) {
  auto* button = new QPushButton(text);
  button->setObjectName(QLatin1String(name));
  button->setToolTip(help);
  connect(button, &QPushButton::clicked, this, request);
  row_->addWidget(button);
  return button;
}

void RepairBar::addWeldDistance() {
  distance_ = new QLineEdit(QStringLiteral("0"));
  distance_->setObjectName(QStringLiteral("repairDistance"));
  distance_->setAccessibleName(QStringLiteral("Distance of welding, in mesh units"));
  distance_->setToolTip(
      QStringLiteral("Vertices as close as this are welded, in mesh units. 0 welds those at the same "
                     "position"));
  auto* validator = new QDoubleValidator(0, coordinate_limit, -1, distance_);
  validator->setNotation(QDoubleValidator::ScientificNotation);
  distance_->setValidator(validator);
  distance_->setFixedWidth(distance_->fontMetrics().horizontalAdvance(QStringLiteral("0.000000000")));
  connect(distance_, &QLineEdit::textChanged, weld_, [this] { weld_->setEnabled(distance_->hasAcceptableInput()); });
  connect(distance_, &QLineEdit::returnPressed, weld_, &QPushButton::click);
  row_->addWidget(new QLabel(QStringLiteral("within")));
  row_->addWidget(distance_);
}

void RepairBar::addClose() {
  auto* close = new QToolButton;
  close->setObjectName(QStringLiteral("repairClose"));
  close->setIcon(icon("close"));
  close->setAutoRaise(true);
  close->setToolTip(QStringLiteral("Closes this bar; Object > Repair shows it again"));
  close->setAccessibleName(QStringLiteral("Close the bar of repairs"));
  connect(close, &QToolButton::clicked, this, &RepairBar::dismissed);
  row_->addWidget(close);
}

double RepairBar::weldDistance() const { return distance_->locale().toDouble(distance_->text()); }

void RepairBar::offer(const Defects& defects, const QString& ifNone) {
  const bool isSound = defects.empty();
  text_->setText(isSound ? ifNone : withoutBreaks(in_words(defects)).join(QStringLiteral(" · ")));
  setAccessibleName(isSound ? text_->text() : QStringLiteral("Defects: %1").arg(text_->text()));
  show_->setVisible(!isSound);
  loose_->setVisible(!defects.loose.empty());
  holes_->setVisible(!defects.holes.empty());
  cells_->setVisible(!defects.inverted.empty());
  showShown({});
  show();
  QAccessibleEvent alert(this, QAccessible::Alert);
  QAccessible::updateAccessibility(&alert);
}

void RepairBar::showShown(const QString& what) {
  shown_->setText(what);
  shown_->setVisible(!what.isEmpty());
}

MeshRepair::MeshRepair(Document& document, Jobs& jobs, QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs), bar_(new RepairBar) {
  connect(&document_, &Document::meshChanged, this, &MeshRepair::follow);
  connect(bar_, &RepairBar::showRequested, this, &MeshRepair::showNext);
  connect(bar_, &RepairBar::weldRequested, this, &MeshRepair::weld);
  connect(bar_, &RepairBar::removeLooseRequested, this, &MeshRepair::removeLoose);
  connect(bar_, &RepairBar::closeHolesRequested, this, &MeshRepair::closeHoles);
  connect(bar_, &RepairBar::turnCellsRequested, this, &MeshRepair::turnCells);
  connect(bar_, &RepairBar::dismissed, this, &MeshRepair::dismiss);
}

void MeshRepair::fill(Actions& actions) {
  actions.add("Object", {{"repairMesh", "&Repair…", "", "",
                          "Looks for duplicate vertices, loose points, holes, non-manifold edges and cells that are "
                          "inside out, and offers to repair them",
                          [this] { check(); }}});
}

void MeshRepair::remember(const MeshPointer& mesh, Defects defects) {
  std::erase_if(checked_, [&mesh](const Checked& one) { return one.mesh.expired() || one.mesh.lock() == mesh; });
  checked_.push_back({mesh, std::make_shared<const Defects>(std::move(defects))});
}

/// Returns what is known about the object, or null.
MeshRepair::Checked* MeshRepair::ofTheObject() {
  const auto found = std::find_if(checked_.begin(), checked_.end(),
                                  [this](const Checked& one) { return one.mesh.lock() == document_.mesh(); });
  return found == checked_.end() ? nullptr : &*found;
}

void MeshRepair::follow() {
  next_ = 0;
  const Checked* known = ofTheObject();
  if (known != nullptr && !known->dismissed && !known->defects->empty()) {
    bar_->offer(*known->defects);
  } else {
    bar_->hide();
  }
}

void MeshRepair::check() {
  jobs_.start(Jobs::Kind::load, QStringLiteral("Checking %1").arg(document_.name()),
              [this, name = document_.name(), mesh = document_.mesh()](const Progress& progress) -> Jobs::Finish {
                const Defects defects = find_defects(*mesh, progress);
                return [this, name, mesh, defects] {
                  remember(mesh, defects);
                  follow();
                  if (defects.empty()) {
                    bar_->offer(defects, nothingToRepair(name, defects));
                  }
                };
              });
}

void MeshRepair::dismiss() {
  if (Checked* known = ofTheObject()) {
    known->dismissed = true;
  }
  bar_->hide();
}

void MeshRepair::showNext() {
  if (const Checked* known = ofTheObject()) {
    const std::vector<DefectGroup> all = groupsOf(*document_.mesh(), *known->defects);
    const DefectGroup& one = all[next_++ % all.size()];
    document_.selection().set(one.elements);
    bar_->showShown(QStringLiteral("Selected: %1").arg(one.name));
  }
}

/// Replaces the object with the repaired one. The softness of single links stays.
void MeshRepair::start(const QString& doing, const Named& step, const Repair& repair) {
  const QString name = document_.name();
  jobs_.start(
      Jobs::Kind::compute, QStringLiteral("%1 of %2").arg(doing, name),
      [this, name, step, repair, mesh = document_.mesh(),
       softness = document_.wholeSoftness()](const Progress& progress) -> Jobs::Finish {
        try {
          const Repaired repaired = repair(*mesh, progress.part(0, 0.9));
          const Defects defects = find_defects(*repaired.mesh, progress.part(0.9, 1));
          const OwnSoftness own = softness_after(softness->links, *mesh, repaired);
          return [this, name, step, repaired, defects, own, mesh, softness] {
            if (document_.mesh() != mesh || document_.wholeSoftness() != softness) {
              emit document_.refused(
                  QStringLiteral("%1: the object was changed while it was repaired. Start the repair again").arg(name));
              return;
            }
            remember(repaired.mesh, defects);
            edits::reworkMesh(document_, repaired.mesh, name, step(repaired), own);
          };
        } catch (const Error& error) {
          throw error.at(name.toStdString());
        }
      });
}

void MeshRepair::weld() {
  const double distance = bar_->weldDistance();
  start(
      QStringLiteral("Welding vertices"),
      [count = document_.mesh()->element_count()](const Repaired& after) {
        const std::size_t welded = count - after.mesh->element_count();
        return QStringLiteral("weld %L1 duplicate %2").arg(welded).arg(welded == 1 ? "vertex" : "vertices");
      },
      [distance](const Mesh& mesh, const Progress& progress) {
        Repaired after = chainmail::weld(mesh, distance, progress);
        if (after.mesh->element_count() == mesh.element_count()) {
          throw Error("", "no two of its vertices are as close as " + QString::number(distance).toStdString(),
                      "choose a larger distance");
        }
        return after;
      });
}

void MeshRepair::removeLoose() {
  if (const Checked* known = ofTheObject()) {
    start(
        QStringLiteral("Removing loose points"),
        [count = known->defects->loose.size()](const Repaired&) {
          return counted(QStringLiteral("remove"), count, QStringLiteral("loose point"));
        },
        [](const Mesh& mesh, const Progress& progress) { return remove_loose(mesh, progress); });
  }
}

void MeshRepair::closeHoles() {
  if (const Checked* known = ofTheObject()) {
    start(
        QStringLiteral("Closing holes"),
        [count = known->defects->holes.size()](const Repaired&) {
          return counted(QStringLiteral("close"), count, QStringLiteral("hole"));
        },
        [defects = known->defects](const Mesh& mesh, const Progress& progress) {
          return close_holes(mesh, defects->holes, progress);
        });
  }
}

void MeshRepair::turnCells() {
  if (const Checked* known = ofTheObject()) {
    start(
        QStringLiteral("Turning cells"),
        [count = known->defects->inverted.size()](const Repaired&) {
          return counted(QStringLiteral("turn"), count, QStringLiteral("cell"));
        },
        [defects = known->defects](const Mesh& mesh, const Progress& progress) {
          return turn_cells(mesh, defects->inverted, progress);
        });
  }
}

}  // namespace chainmail
