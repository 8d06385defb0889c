#include "docks/element_dock.h"

#include <QAction>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QVBoxLayout>
#include <algorithm>
#include <limits>
#include <span>

#include "common/dock_scroll.h"
#include "common/text.h"
#include "document/edits.h"
#include "document/element_facts.h"

namespace chainmail {
namespace {

constexpr int elementRefreshMilliseconds = 100;
// The hub of a star may have as many neighbours as there are elements.
constexpr int maxRows = 200;
constexpr int shownRows = 6;
constexpr int idButtons = 32, widestId = 150;  // pixels

void put(QTableWidget& table, int row, int column, const QString& words) {
  auto* item = table.item(row, column);
  if (item == nullptr) {
    item = new QTableWidgetItem;
    item->setTextAlignment(column == 0 ? Qt::AlignLeft | Qt::AlignVCenter : Qt::AlignRight | Qt::AlignVCenter);
    table.setItem(row, column, item);
  }
  item->setText(words);
}

}  // namespace

/// A spin box that gives access to its line edit.
class ElementDock::IdBox : public QSpinBox {
 public:
  explicit IdBox(const QAction& toggle) : toggle_(toggle) {}
  QLineEdit& field() const { return *lineEdit(); }

 protected:
  /// Leaves the shortcut of the dock to the window. On X11, a line edit takes Ctrl+E as 'end of line'.
  bool event(QEvent* event) override {
    return !(event->type() == QEvent::ShortcutOverride &&
             QKeySequence(static_cast<QKeyEvent*>(event)->keyCombination()) == toggle_.shortcut()) &&
           QSpinBox::event(event);
  }

 private:
  const QAction& toggle_;
};

ElementDock::ElementDock(Document& document)
    : document_(document),
      id_(new IdBox(*toggleViewAction())),
      state_(new QLabel),
      positions_(table("elementPositions", QStringLiteral("Positions of the element (mesh units)"), {})),
      neighbours_(table("elementNeighbours", QStringLiteral("Neighbours and links of the element"),
                        {QStringLiteral("To"), QStringLiteral("Compr."), QStringLiteral("Stretch"),
                         QStringLiteral("Shear"), QStringLiteral("Violation")})),
      pin_(new QPushButton),
      cut_(new QPushButton(QStringLiteral("&Cut link"))),
      move_(new ElementMove(document)),
      refresh_(this) {
  id_->setObjectName(QStringLiteral("elementId"));
  id_->setKeyboardTracking(false);
  id_->setToolTip(QStringLiteral("Index of the element in the file, from 0. Selects this element"));
  state_->setObjectName(QStringLiteral("elementState"));
  state_->setWordWrap(true);
  pin_->setObjectName(QStringLiteral("pinElement"));
  cut_->setObjectName(QStringLiteral("cutLink"));
  neighbours_->setToolTip(
      QStringLiteral("Softness relative to the rest vector; largest violation of all panels in rest lengths.\n"
                     "Double-click or Enter: go to this neighbour"));
  refresh_.setSingleShot(true);
  refresh_.setInterval(elementRefreshMilliseconds);
  arrange();
  listen();
  adaptToMesh();
}

QTableWidget* ElementDock::table(const char* name, const QString& accessible, const QStringList& columns) {
  auto* table = new QTableWidget(0, int(columns.size()));
  table->setObjectName(QLatin1String(name));
  table->setAccessibleName(accessible);
  table->setHorizontalHeaderLabels(columns);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setSelectionMode(QAbstractItemView::SingleSelection);
  table->setTabKeyNavigation(false);
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(table->fontMetrics().height() + 4);
  table->horizontalHeader()->setMinimumSectionSize(10);
  table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  return table;
}

void ElementDock::arrange() {
  auto* label = new QLabel(QStringLiteral("&Element"));
  label->setBuddy(id_);
  auto* head = new QHBoxLayout;
  head->addWidget(label);
  head->addWidget(id_, 1);
  head->addWidget(pin_);
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(9, 4, 9, 4);
  column->addLayout(head);
  column->addWidget(state_);
  column->addWidget(positions_);
  column->addWidget(move_);
  column->addWidget(neighbours_);
  column->addWidget(cut_);
  column->addStretch();
  neighbours_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  neighbours_->horizontalHeader()->setStretchLastSection(true);
  const int row = neighbours_->verticalHeader()->defaultSectionSize();
  neighbours_->setFixedHeight((shownRows + 1) * row + 10);
  setWidget(new DockScroll(content));
}

void ElementDock::listen() {
  connect(id_, &QSpinBox::valueChanged, this, &ElementDock::pick);
  connect(&id_->field(), &QLineEdit::returnPressed, this, &ElementDock::pick);  // also if the id is unchanged
  connect(&id_->field(), &QLineEdit::textEdited, this, [this] { missing_.reset(); });
  connect(toggleViewAction(), &QAction::triggered, this, [this](bool shown) {
    if (shown) {
      id_->setFocus(Qt::ShortcutFocusReason);
    }
  });
  connect(pin_, &QPushButton::clicked, this,
          [this] { edits::setPinned(document_, {*element_}, !isPinned(document_, *element_)); });
  connect(cut_, &QPushButton::clicked, this, [this] { edits::cut(document_, {*chosenLink()}); });
  connect(neighbours_, &QTableWidget::itemSelectionChanged, this, &ElementDock::adaptButtons);
  connect(neighbours_, &QTableWidget::cellActivated, this,
          [this](int row) { id_->setValue(neighbours_->item(row, 0)->data(Qt::UserRole).toInt()); });
  connect(&refresh_, &QTimer::timeout, this, &ElementDock::showElement);
  const auto later = [this] {
    if (!refresh_.isActive() && isVisible()) {
      refresh_.start();
    }
  };
  connect(this, &QDockWidget::visibilityChanged, this, later);
  for (const auto signal : {&Document::softnessChanged, &Document::pinsChanged}) {
    connect(&document_, signal, this, later);
  }
  connect(&document_, &Document::cutsChanged, this, later);
  connect(&document_.solvers(), &PanelSolvers::frameReady, this, later);
  connect(&document_, &Document::meshChanged, this, &ElementDock::adaptToMesh);
  connect(&document_.selection(), &Selection::changed, this, &ElementDock::followSelection);
}

void ElementDock::adaptToMesh() {
  const Mesh& mesh = *document_.mesh();
  {
    const QSignalBlocker quiet(id_);
    id_->setRange(0, std::numeric_limits<int>::max());  // for ids beyond the last one, the dock shows a message
    id_->setSuffix(QStringLiteral(" (0 to %1)").arg(mesh.element_count() - 1));
    // Qt would make room for the highest number of the range.
    const QString longest = QString::number(mesh.element_count() - 1) + id_->suffix();
    id_->setMinimumWidth(std::min(id_->fontMetrics().horizontalAdvance(longest) + idButtons, widestId));
  }
  QStringList columns{QString()};
  for (int k = 0; k < mesh.space_dimension; ++k) {
    columns << QString(QLatin1Char("xyz"[mesh.axes[std::size_t(k)]]));
  }
  positions_->setColumnCount(int(columns.size()));
  positions_->setHorizontalHeaderLabels(columns);
  followSelection();
}

void ElementDock::followSelection() {
  const auto& selected = document_.selection().elements();
  element_.reset();
  missing_.reset();
  if (selected.size() == 1) {
    element_ = selected.front();
    const QSignalBlocker quiet(id_);
    id_->setValue(int(*element_));
  }
  showElement();
}

void ElementDock::pick() {
  const auto count = document_.mesh()->element_count();
  if (std::size_t(id_->value()) < count) {
    if (element_ != ElementId(id_->value())) {
      document_.selection().set({ElementId(id_->value())});
    }
    return;
  }
  const int asked = id_->value();
  if (element_) {
    const QSignalBlocker quiet(id_);
    id_->setValue(int(*element_));
  }
  missing_ = asked;
  state_->setText(stateText());
}

QString ElementDock::stateText() const {
  if (missing_) {
    return QStringLiteral("There is no element %1: use an id from 0 to %2.")
        .arg(*missing_)
        .arg(document_.mesh()->element_count() - 1);
  }
  if (element_) {
    return counted(document_.mesh()->neighbours_of(*element_).size(), QStringLiteral("neighbour")) +
           (isPinned(document_, *element_) ? QStringLiteral(" · pinned") : QString());
  }
  const auto& elements = document_.selection().elements();
  const std::size_t selected = elements.size();
  const auto pinned = std::ranges::count_if(elements, [this](ElementId one) { return isPinned(document_, one); });
  return selected == 0 ? QStringLiteral("Type an id and press Enter, or select one element in a view.")
                       : QStringLiteral("%L1 elements selected%2: move them below, or type an id to select one.")
                             .arg(selected)
                             .arg(pinned == 0 ? QString() : QStringLiteral(", %L1 of them pinned").arg(pinned));
}

void ElementDock::showElement() {
  state_->setText(stateText());
  move_->setElements(document_.selection().elements());
  showPositions();
  showNeighbours();
  adaptButtons();
}

void ElementDock::showPositions() {
  const Mesh& mesh = *document_.mesh();
  const auto show = [&](int row, const QString& name, const Point& at) {
    put(*positions_, row, 0, name);
    for (int k = 0; k < mesh.space_dimension; ++k) {
      put(*positions_, row, k + 1, figure(at[mesh.axes[std::size_t(k)]]));
    }
  };
  positions_->setRowCount(element_ ? document_.panels() + 1 : 0);
  if (element_) {
    show(0, QStringLiteral("rest"), mesh.rest_position(*element_));
    for (int panel = 0; panel < document_.panels(); ++panel) {
      show(panel + 1, panelName(panel), positionIn(document_, panel, *element_));
    }
  }
  positions_->setFixedHeight((positions_->rowCount() + 1) * positions_->verticalHeader()->defaultSectionSize() + 10);
}

void ElementDock::showNeighbours() {
  const Mesh& mesh = *document_.mesh();
  const EntryId first = element_ ? mesh.first_entry[*element_] : 0;
  const int count = element_ ? int(mesh.first_entry[*element_ + 1] - first) : 0;
  neighbours_->setRowCount(std::min(count, maxRows));
  for (int row = 0; row < neighbours_->rowCount(); ++row) {
    showNeighbour(row, first + EntryId(row));
  }
  if (count > maxRows) {
    state_->setText(QStringLiteral("%1, of which the list shows the first %2").arg(state_->text()).arg(maxRows));
  }
}

void ElementDock::showNeighbour(int row, EntryId entry) {
  const LinkId link = document_.mesh()->entry_link[entry];
  const ElementId to = document_.mesh()->neighbours[entry];
  const bool isCut = document_.cuts().is_cut(link);
  double violation = 0;
  for (int panel = 0; panel < document_.panels(); ++panel) {
    violation = std::max(violation, violationOfLink(document_, panel, link));
  }
  const LinkSoftness& softness = document_.wholeSoftness()->of(link);
  put(*neighbours_, row, 0, QString::number(to));
  neighbours_->item(row, 0)->setData(Qt::UserRole, to);
  QStringList energy;
  for (const auto& [parameter, value] : std::span(softness_numbers).subspan(region_numbers)) {
    const QString label = text(parameter->label);
    energy << QStringLiteral("%1 %2").arg(energy.isEmpty() ? label : label.toLower(), figure(softness.*value));
  }
  for (int column = 1; column <= int(region_numbers); ++column) {
    put(*neighbours_, row, column, figure(softness.*softness_numbers[std::size_t(column) - 1].value));
    neighbours_->item(row, column)->setToolTip(energy.join(QStringLiteral(", ")));
  }
  put(*neighbours_, row, 4, isCut ? QStringLiteral("cut") : shownNumber(violation, 'g', 3));
}

std::optional<LinkId> ElementDock::chosenLink() const {
  const auto rows = neighbours_->selectionModel()->selectedRows();
  if (!element_ || rows.isEmpty()) {
    return {};
  }
  return document_.mesh()->entry_link[document_.mesh()->first_entry[*element_] + EntryId(rows.first().row())];
}

void ElementDock::adaptButtons() {
  const bool pinned = element_ && isPinned(document_, *element_);
  pin_->setText(pinned ? QStringLiteral("Un&pin") : QStringLiteral("&Pin"));
  pin_->setEnabled(element_.has_value());
  pin_->setToolTip(!element_ ? QStringLiteral("Select a single element first")
                   : pinned  ? QStringLiteral("Lets the element move again")
                             : QStringLiteral("Keeps the element at its position"));
  const auto link = chosenLink();
  const bool isCut = link && document_.cuts().is_cut(*link);
  cut_->setEnabled(link && !isCut);
  cut_->setToolTip(!link   ? QStringLiteral("Select a neighbour in the table first")
                   : isCut ? QStringLiteral("This link is cut; Undo restores it")
                           : QStringLiteral("Cuts the link to the selected neighbour"));
}

}  // namespace chainmail
