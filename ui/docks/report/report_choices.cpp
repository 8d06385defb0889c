#include "docks/report/report_choices.h"

#include <QFormLayout>
#include <QGuiApplication>
#include <QStandardItemModel>
#include <QVBoxLayout>

#include "common/colours.h"
#include "common/number_field.h"
#include "common/plot_painting.h"
#include "common/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int generatedDrags = 0, lastDrag = 1;  // rows of the list of drags
constexpr int sweepsPerMove = 10;
constexpr int withEquilibrium = 3;  // row of the list of sweeps
constexpr int listMarkSize = 13;    // logical pixels

void name(QWidget* widget, const char* object, const QString& accessible, const QString& help) {
  widget->setObjectName(QLatin1String(object));
  widget->setAccessibleName(accessible);
  widget->setToolTip(help);
}

void enable(QComboBox* box, int row, bool enabled) {
  qobject_cast<QStandardItemModel*>(box->model())->item(row)->setEnabled(enabled);
}

}  // namespace

ReportChoices::ReportChoices(Document& document)
    : document_(document),
      drags_(new QComboBox),
      algorithms_(new QListWidget),
      sweeps_(new QComboBox),
      precision_(new QComboBox),
      seconds_(new NumberField(QStringLiteral("Time"))) {
  fillDrags();
  fillAlgorithms();
  fillRest();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  form->setVerticalSpacing(3);
  form->addRow(QStringLiteral("Drags"), drags_);
  form->addRow(QStringLiteral("Relax"), sweeps_);
  form->addRow(QStringLiteral("Precision"), precision_);
  form->addRow(QStringLiteral("Run time"), seconds_);
  column->addWidget(algorithms_, 1);
  column->addLayout(form);
  connect(algorithms_, &QListWidget::itemChanged, this, &ReportChoices::changed);
  connect(&document, &Document::meshChanged, this, &ReportChoices::adaptToMesh);
  connect(&document.moves(), &MovePlayer::lastDragChanged, this, &ReportChoices::adaptToLastDrag);
  adaptToMesh();
  adaptToLastDrag();
}

void ReportChoices::fillDrags() {
  name(drags_, "reportDrags", QStringLiteral("Drags to compare on"),
       QStringLiteral("Three generated drags: local, of the whole body, back and forth.\n"
                      "My last drag: repeats your last drag in a panel, from rest."));
  drags_->addItems({QStringLiteral("three generated"), QStringLiteral("my last drag")});
}

void ReportChoices::fillAlgorithms() {
  name(algorithms_, "reportAlgorithms", QStringLiteral("Algorithms to compare"),
       QStringLiteral("Algorithms to compare, with their marks in the plot"));
  algorithms_->setIconSize({listMarkSize, listMarkSize});
  algorithms_->setUniformItemSizes(true);
  algorithms_->setMinimumHeight(48);
  for (const AlgorithmInfo& one : algorithms()) {
    auto* item = new QListWidgetItem(text(one.label), algorithms_);
    item->setData(Qt::UserRole, int(one.algorithm));
    item->setCheckState(Qt::Checked);
  }
  followTheme(*this, [this] {
    const QSignalBlocker block(algorithms_);  // the user has changed nothing
    for (int row = 0; row < algorithms_->count(); ++row) {
      const auto algorithm = Algorithm(algorithms_->item(row)->data(Qt::UserRole).toInt());
      algorithms_->item(row)->setIcon(
          QIcon(plotMark(algorithm, false, listMarkSize, devicePixelRatioF(), QGuiApplication::palette())));
    }
  });
}

void ReportChoices::fillRest() {
  name(sweeps_, "reportSweeps", QStringLiteral("Relaxation after each move"),
       QStringLiteral("Each algorithm without relaxation, with 10 sweeps after each move, or both.\n"
                      "Scheme and step are those of the Relaxation dock; the scheme is mean if it is the equilibrium "
                      "there.\n"
                      "With equilibrium, Natural Queue and Exact also relax to the equilibrium after each move."));
  sweeps_->addItems({QStringLiteral("off"), QStringLiteral("%1 sweeps").arg(sweepsPerMove),
                     QStringLiteral("off and %1 sweeps").arg(sweepsPerMove),
                     QStringLiteral("off, %1 sweeps and equilibrium").arg(sweepsPerMove)});
  sweeps_->setCurrentIndex(2);
  name(precision_, "reportPrecision", QStringLiteral("Precision of the contestants"),
       QStringLiteral("Number type that the algorithms use (float or double). Reference solutions always use double"));
  precision_->addItems({QStringLiteral("float"), QStringLiteral("double")});
  name(seconds_, "reportSeconds", QStringLiteral("Time in seconds"),
       QStringLiteral("Time for the repetitions of one drag by all algorithms, at least five repetitions.\n"
                      "More time gives steadier results; the errors stay the same."));
  seconds_->setRange(0.1, 60);
  seconds_->setDecimals(1);
  seconds_->setValue(2);
  seconds_->setSuffix(QStringLiteral(" s per drag"));
  seconds_->setKeyboardTracking(false);
  connect(seconds_, &QDoubleSpinBox::editingFinished, seconds_, &QWidget::clearFocus);  // shortcuts work again
}

/// Disables the algorithms that do not work on the mesh. Their tool tips give the reason.
void ReportChoices::adaptToMesh() {
  for (int row = 0; row < algorithms_->count(); ++row) {
    QListWidgetItem* item = algorithms_->item(row);
    const auto algorithm = Algorithm(item->data(Qt::UserRole).toInt());
    QString help = text(info(algorithm).source);
    try {
      check(algorithm, *document_.mesh());
      item->setFlags(item->flags() | Qt::ItemIsEnabled);
    } catch (const Error& error) {
      item->setFlags(item->flags() & ~Qt::ItemIsEnabled);
      help = QString::fromStdString(error.what());
    }
    item->setToolTip(help);
  }
}

void ReportChoices::adaptToLastDrag() {
  const bool there = !document_.moves().lastDrag().empty();
  enable(drags_, lastDrag, there);
  if (!there) {
    drags_->setCurrentIndex(generatedDrags);
  }
}

std::vector<Algorithm> ReportChoices::chosen() const {
  std::vector<Algorithm> algorithms;
  for (int row = 0; row < algorithms_->count(); ++row) {
    const QListWidgetItem* item = algorithms_->item(row);
    if (item->checkState() == Qt::Checked && (item->flags() & Qt::ItemIsEnabled) != 0) {
      algorithms.push_back(Algorithm(item->data(Qt::UserRole).toInt()));
    }
  }
  return algorithms;
}

ReportThread::Order ReportChoices::order() const {
  ReportThread::Order order;
  order.object = {document_.name().toStdString(),
                  "the object of the window, from rest",
                  document_.mesh(),
                  document_.cuts().links(),
                  document_.pins(),
                  *document_.wholeSoftness(),
                  {}};
  order.generateDrags = drags_->currentIndex() == generatedDrags;
  if (!order.generateDrags) {
    order.object.drags.push_back({"my last drag", "the last drag in the window", document_.moves().lastDrag()});
  }
  order.options.algorithms = chosen();
  order.options.sweeps = sweeps_->currentIndex() == 0   ? std::vector{0}
                         : sweeps_->currentIndex() == 1 ? std::vector{sweepsPerMove}
                                                        : std::vector{0, sweepsPerMove};
  order.options.equilibrium = sweeps_->currentIndex() == withEquilibrium;
  if (const RelaxationScheme scheme = document_.relaxation().scheme; info(scheme).sweeps) {
    order.options.scheme = scheme;
  }
  order.options.relax_step = document_.relaxation().step;
  order.options.precision = precision_->currentIndex() == 0 ? Precision::single_precision : Precision::double_precision;
  order.options.seconds = seconds_->value();
  return order;
}

}  // namespace chainmail
