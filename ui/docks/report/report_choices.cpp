#include "docks/report/report_choices.h"

#include <QFormLayout>
#include <QGuiApplication>
#include <QStandardItemModel>
#include <QVBoxLayout>
#include <algorithm>

#include "common/colours.h"
#include "common/describe.h"
#include "common/number_field.h"
#include "common/plot_pictures.h"
#include "common/text.h"
#include "mesh/error.h"
#include "report/run/drag_reference.h"

namespace chainmail {
namespace {

constexpr int exactRow = 0, physicsRow = 1;  // rows of the list of references
constexpr int sweepsPerMove = 10;
constexpr int withEquilibrium = 3;  // row of the list of sweeps
constexpr int listMarkSize = 13;    // logical pixels
constexpr int listHeight = 48;      // the least, in logical pixels
constexpr int ofMaterial = -1;      // stands for relaxation to the material where others have their algorithm

const report::Contestant toMaterial{.algorithm = Algorithm::natural_queue, .equilibrium = true, .open_regions = true};

Qt::ItemFlags enabledIf(bool is, Qt::ItemFlags flags) {
  return is ? flags | Qt::ItemIsEnabled : flags & ~Qt::ItemFlags(Qt::ItemIsEnabled);
}

bool isChosen(const QListWidgetItem& item) {
  return item.checkState() == Qt::Checked && (item.flags() & Qt::ItemIsEnabled) != 0;
}

void add(QListWidget* list, const QString& name, const QVariant& value, bool isChecked, const QString& help = {}) {
  auto* item = new QListWidgetItem(name, list);
  item->setData(Qt::UserRole, value);
  item->setToolTip(help);
  item->setCheckState(isChecked ? Qt::Checked : Qt::Unchecked);
}

/// Returns the values of the chosen items.
QVariantList chosenOf(const QListWidget* list) {
  QVariantList values;
  for (int row = 0; row < list->count(); ++row) {
    if (isChosen(*list->item(row))) {
      values << list->item(row)->data(Qt::UserRole);
    }
  }
  return values;
}

}  // namespace

ReportChoices::ReportChoices(Document& document)
    : document_(document),
      against_(new QComboBox),
      noPhysics_(new QLabel),
      contestants_(new QListWidget),
      drags_(new QListWidget),
      sweeps_(new QComboBox),
      precision_(new QComboBox),
      seconds_(new NumberField(QStringLiteral("Time"))) {
  describeAll();
  arrange();
  const auto fill = [this] {
    fillContestants();
    fillDrags();
    emit changed();
  };
  connect(against_, &QComboBox::currentIndexChanged, this, fill);
  connect(contestants_, &QListWidget::itemChanged, this, &ReportChoices::changed);
  connect(drags_, &QListWidget::itemChanged, this, &ReportChoices::changed);
  connect(&document, &Document::meshChanged, this, &ReportChoices::adaptToMesh);
  connect(&document, &Document::meshChanged, this, &ReportChoices::adaptToObject);
  connect(&document, &Document::pinsChanged, this, &ReportChoices::adaptToObject);
  connect(&document, &Document::cutsChanged, this, &ReportChoices::adaptToObject);
  connect(&document.moves(), &MovePlayer::lastDragChanged, this, &ReportChoices::adaptToLastDrag);
  fill();
  adaptToObject();
  followTheme(*this, [this] { drawMarks(); });
}

void ReportChoices::arrange() {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(3);
  const auto addForm = [column](std::initializer_list<std::pair<const char*, QWidget*>> rows) {
    auto* form = new QFormLayout;
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form->setVerticalSpacing(3);
    for (const auto& [label, field] : rows) {
      form->addRow(QLatin1String(label), field);
    }
    column->addLayout(form);
  };
  addForm({{"Against", against_}});
  column->addWidget(noPhysics_);
  column->addWidget(contestants_, 1);
  column->addWidget(drags_, 1);
  addForm({{"Relax", sweeps_}, {"Precision", precision_}, {"Run time", seconds_}});
  noPhysics_->setWordWrap(true);
  noPhysics_->setTextFormat(Qt::PlainText);
  noPhysics_->setEnabled(false);
  for (QListWidget* list : {contestants_, drags_}) {
    list->setUniformItemSizes(true);
    list->setMinimumHeight(listHeight);
  }
  contestants_->setIconSize({listMarkSize, listMarkSize});
}

void ReportChoices::describeAll() {
  describe(against_, "reportAgainst", QStringLiteral("Reference of the comparison"),
           QStringLiteral("Exact ChainMail: errors are violations, and distances to Exact ChainMail.\n"
                          "physics: errors are distances to finite elements, the neo-Hookean solution or that of the "
                          "law in the Physics dock. The object must be pinned"));
  against_->addItems({QStringLiteral("Exact ChainMail"), QStringLiteral("physics")});
  describe(noPhysics_, "reportNoPhysics", QStringLiteral("Why there is no comparison with physics"), {});
  describe(contestants_, "reportAlgorithms", QStringLiteral("Contestants to compare"),
           QStringLiteral("Contestants to compare, with their marks in the plot"));
  describe(drags_, "reportDrags", QStringLiteral("Drags to compare on"),
           QStringLiteral("Drags to compare on, from rest"));
  describe(sweeps_, "reportSweeps", QStringLiteral("Relaxation after each move"),
           QStringLiteral(
               "Each algorithm without relaxation, with %1 sweeps after each move, or both.\n"
               "Scheme and step are those of the Relaxation dock; the scheme is mean if it is the equilibrium there.\n"
               "With equilibrium, Natural Queue and Exact also relax to the equilibrium after each move.")
               .arg(sweepsPerMove));
  sweeps_->addItems({QStringLiteral("off"), QStringLiteral("%1 sweeps").arg(sweepsPerMove),
                     QStringLiteral("off and %1 sweeps").arg(sweepsPerMove),
                     QStringLiteral("off, %1 sweeps and equilibrium").arg(sweepsPerMove)});
  sweeps_->setCurrentIndex(2);
  describe(precision_, "reportPrecision", QStringLiteral("Precision of the contestants"),
           QStringLiteral("Number type that the algorithms use (float or double). References always use double"));
  precision_->addItems({QStringLiteral("float"), QStringLiteral("double")});
  describe(seconds_, "reportSeconds", QStringLiteral("Time in seconds"),
           QStringLiteral("Time for the repetitions of one drag by all contestants, at least three repetitions.\n"
                          "More time gives steadier results; the errors stay the same."));
  seconds_->setRange(0.1, 60);
  seconds_->setDecimals(1);
  seconds_->setValue(2);
  seconds_->setSuffix(QStringLiteral(" s per drag"));
  seconds_->setKeyboardTracking(false);
  connect(seconds_, &QDoubleSpinBox::editingFinished, seconds_, &QWidget::clearFocus);  // shortcuts work again
}

/// Against physics, only those are chosen at first that show the most; the others take long.
void ReportChoices::fillContestants() {
  const QSignalBlocker block(contestants_);
  contestants_->clear();
  std::vector<Algorithm> chosen{Algorithm::linear_fem, Algorithm::quasi_newton};
  for (int panel = 0; panel < document_.panels(); ++panel) {
    chosen.push_back(document_.algorithm(panel));
  }
  if (againstPhysics()) {
    add(contestants_, text(report::label(toMaterial)), ofMaterial, true);
  }
  for (const AlgorithmInfo& one : againstPhysics() ? every_algorithm() : algorithms()) {
    add(contestants_, text(one.label), int(one.algorithm),
        !againstPhysics() || std::ranges::count(chosen, one.algorithm) > 0);
  }
  adaptToMesh();
  drawMarks();
}

/// The names are those of core's drags.
void ReportChoices::fillDrags() {
  const QSignalBlocker block(drags_);
  drags_->clear();
  add(drags_, QStringLiteral("my last drag"), {}, true, QStringLiteral("Repeats your last drag in a panel, from rest"));
  const auto addAll = [this](std::initializer_list<std::pair<const char*, const char*>> drags) {
    for (const auto& [name, help] : drags) {
      add(drags_, QLatin1String(name), QLatin1String(name), true, QLatin1String(help));
    }
  };
  if (againstPhysics()) {
    addAll({{"nudge", "5 % of the object's size, obliquely"},
            {"pull", "20 % of the object's size away from the pins"},
            {"bend", "20 % of the object's size across"},
            {"far bend", "50 % of the object's size across"},
            {"cut, then move", "Half of the pull, a cut into the object, and one more move"}});
  } else {
    addAll({{"local", "Until about an eighth of the object follows"},
            {"whole body", "At the edge, until all elements follow, and as far again"},
            {"back and forth", "In the middle, until all elements follow, and back"}});
  }
  adaptToLastDrag();
}

void ReportChoices::drawMarks() {
  const QSignalBlocker block(contestants_);  // the user has changed nothing
  for (int row = 0; row < contestants_->count(); ++row) {
    const int value = contestants_->item(row)->data(Qt::UserRole).toInt();
    const bool isMaterial = value == ofMaterial;
    contestants_->item(row)->setIcon(QIcon(plotMark(isMaterial ? *toMaterial.algorithm : Algorithm(value), isMaterial,
                                                    listMarkSize, devicePixelRatioF(), QGuiApplication::palette())));
  }
}

/// Offers physics where it has a solution, and else says what is missing.
void ReportChoices::adaptToObject() {
  QString reason;
  try {
    report::check_reference("object", *document_.mesh(), !document_.pins().empty(), document_.cuts().count() > 0);
  } catch (const Error& error) {
    reason = text(error.problem() + "; " + error.remedy());
  }
  auto* item = qobject_cast<QStandardItemModel*>(against_->model())->item(physicsRow);
  item->setEnabled(reason.isEmpty());
  item->setToolTip(reason);
  noPhysics_->setText(QStringLiteral("Not against physics: ") + reason);
  noPhysics_->setVisible(!reason.isEmpty());
  if (!reason.isEmpty()) {
    against_->setCurrentIndex(exactRow);
  }
}

/// Disables the algorithms that do not work on the mesh. Their tooltips give the reason.
void ReportChoices::adaptToMesh() {
  for (int row = 0; row < contestants_->count(); ++row) {
    QListWidgetItem* item = contestants_->item(row);
    const int value = item->data(Qt::UserRole).toInt();
    const Algorithm algorithm = value == ofMaterial ? *toMaterial.algorithm : Algorithm(value);
    QString reason;
    try {
      check(algorithm, *document_.mesh());
    } catch (const Error& error) {
      reason = QString::fromStdString(error.what());
    }
    item->setFlags(enabledIf(reason.isEmpty(), item->flags()));
    item->setToolTip(!reason.isEmpty() ? reason
                     : value == ofMaterial
                         ? QStringLiteral("Relaxes to the material of the Physics dock after each move")
                         : text(info(algorithm).source));
  }
}

void ReportChoices::adaptToLastDrag() {
  QListWidgetItem* item = drags_->item(0);
  item->setFlags(enabledIf(!document_.moves().lastDrag().empty(), item->flags()));
}

bool ReportChoices::complete() const { return !chosenOf(contestants_).empty() && !chosenOf(drags_).empty(); }

ReportThread::Order ReportChoices::order() const {
  ReportThread::Order order{.object = {.name = document_.name().toStdString(),
                                       .description = "the object of the window, from rest",
                                       .mesh = document_.mesh(),
                                       .cuts = document_.cuts().links(),
                                       .pins = document_.pins(),
                                       .softness = *document_.wholeSoftness(),
                                       .drags = {},
                                       .elastic = document_.elastic(),
                                       .law = document_.elastic().law},
                            .againstPhysics = againstPhysics()};
  for (const QVariant& drag : chosenOf(drags_)) {
    if (drag.isValid()) {
      order.drags.push_back(drag.toString().toStdString());
    } else {
      order.object.drags.push_back({"my last drag", "the last drag in the window", document_.moves().lastDrag()});
    }
  }
  report::PhysicsOptions& options = order.options;
  options.sweeps = sweeps_->currentIndex() == 0   ? std::vector{0}
                   : sweeps_->currentIndex() == 1 ? std::vector{sweepsPerMove}
                                                  : std::vector{0, sweepsPerMove};
  options.equilibrium = sweeps_->currentIndex() == withEquilibrium;
  if (const RelaxationScheme scheme = document_.relaxation().scheme; info(scheme).sweeps) {
    options.scheme = scheme;
  }
  options.relax_step = document_.relaxation().step;
  options.precision = precision_->currentIndex() == 0 ? Precision::single_precision : Precision::double_precision;
  options.seconds = seconds_->value();
  addContestants(options);
  return order;
}

void ReportChoices::addContestants(report::PhysicsOptions& options) const {
  std::vector<Algorithm> chosen;
  QVariantList values = chosenOf(contestants_);
  const bool hasMaterial = values.removeOne(QVariant(ofMaterial));
  std::ranges::transform(values, std::back_inserter(chosen),
                         [](const QVariant& one) { return Algorithm(one.toInt()); });
  if (!againstPhysics()) {
    options.algorithms = chosen;
    options.own_limit = 0;
    return;
  }
  options.growth_seconds = 0;
  options.turned = false;
  options.contestants = report::contestants_of(chosen, options.sweeps, options.equilibrium, {});
  // It is a choice of its own, once.
  std::erase_if(options.contestants, [](const report::Contestant& one) { return one.open_regions; });
  if (hasMaterial) {
    options.contestants.push_back(toMaterial);
  }
}

}  // namespace chainmail
