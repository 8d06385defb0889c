#include "tools/element_menu.h"

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QLocale>
#include <QMouseEvent>
#include <algorithm>
#include <utility>

#include "document/edits.h"
#include "document/element_facts.h"
#include "panels/view.h"

namespace chainmail {

std::vector<ElementId> partWith(const Mesh& mesh, const Cuts& cuts, ElementId element) {
  std::vector<bool> isFound(mesh.element_count(), false);
  std::vector<ElementId> part{element};
  isFound[element] = true;
  for (std::size_t i = 0; i < part.size(); ++i) {
    for_each_neighbour(mesh, cuts, part[i], [&](ElementId other, EntryId /*entry*/) {
      if (!isFound[other]) {
        isFound[other] = true;
        part.push_back(other);
      }
    });
  }
  std::sort(part.begin(), part.end());
  return part;
}

ElementMenu::ElementMenu(Document& document, QWidget* window) : QObject(window), document_(document), menu_(window) {
  menu_.setObjectName(QStringLiteral("elementMenu"));
  title_ = menu_.addAction(QString());
  title_->setEnabled(false);
  menu_.addSeparator();
  pin_ = add("elementMenuPin", {}, &ElementMenu::pin);
  add("elementMenuPart", QStringLiteral("&Select its part"), &ElementMenu::selectPart);
  add("elementMenuCentre", QStringLiteral("&Centre here"), &ElementMenu::centre);
  add("elementMenuCopy", QStringLiteral("Copy &id"), &ElementMenu::copyId);
  // Another object may not have the element, and a panel that leaves takes its view with it.
  connect(&document, &Document::meshChanged, this, &ElementMenu::close);
  connect(&document, &Document::panelLeaves, this, &ElementMenu::close);
}

QAction* ElementMenu::add(const char* name, const QString& text, void (ElementMenu::*act)()) {
  QAction* action = menu_.addAction(text, this, [this, act] {
    if (view_ != nullptr) {
      (this->*act)();
    }
  });
  action->setObjectName(QLatin1String(name));
  return action;
}

void ElementMenu::follow(View& view) { view.installEventFilter(this); }

bool ElementMenu::eventFilter(QObject* watched, QEvent* event) {
  auto& view = static_cast<View&>(*watched);
  if (event->type() == QEvent::ContextMenu) {
    // The one of the mouse comes when the button is pressed, before it is known whether it drags.
    auto* wanted = static_cast<QContextMenuEvent*>(event);
    const auto element = highlighted();
    if (wanted->reason() == QContextMenuEvent::Keyboard && element) {
      open(view, *element, view.mapToGlobal(view.viewPosition(*element).toPoint()));
    }
    return true;
  }
  if (isClick(*event)) {
    const auto* release = static_cast<QMouseEvent*>(event);
    if (const auto element = view.search().elementAt(release->position())) {
      open(view, *element, release->globalPosition().toPoint());
    }
  }
  return false;
}

/// True if the event releases the right button where it was pressed, alone.
bool ElementMenu::isClick(QEvent& event) {
  if (event.type() != QEvent::MouseButtonPress && event.type() != QEvent::MouseMove &&
      event.type() != QEvent::MouseButtonRelease) {
    return false;
  }
  const auto& mouse = static_cast<QMouseEvent&>(event);
  if (event.type() == QEvent::MouseButtonPress) {
    pressed_ = mouse.buttons() == Qt::RightButton ? std::optional(mouse.position()) : std::nullopt;
  } else if (pressed_ && (mouse.position() - *pressed_).manhattanLength() >= qreal(QApplication::startDragDistance())) {
    pressed_.reset();
  }
  return event.type() == QEvent::MouseButtonRelease && mouse.button() == Qt::RightButton &&
         std::exchange(pressed_, std::nullopt).has_value();
}

/// Returns the element under the cursor, or the only one that is selected.
std::optional<ElementId> ElementMenu::highlighted() const {
  if (const auto& marked = document_.highlight().marks().element) {
    return marked;
  }
  const auto& selected = document_.selection().elements();
  return selected.size() == 1 ? std::optional(selected.front()) : std::nullopt;
}

void ElementMenu::open(View& view, ElementId element, QPoint at) {
  view_ = &view;
  element_ = element;
  title_->setText(QStringLiteral("Element %L1").arg(element));
  pin_->setText(isPinned(document_, element) ? QStringLiteral("Un&pin") : QStringLiteral("&Pin"));
  menu_.popup(at);
}

void ElementMenu::close() {
  menu_.close();
  view_ = nullptr;
}

void ElementMenu::pin() { edits::setPinned(document_, {element_}, !isPinned(document_, element_)); }

void ElementMenu::selectPart() { document_.selection().set(partWith(*document_.mesh(), document_.cuts(), element_)); }

void ElementMenu::centre() { view_->centreOn(element_); }

void ElementMenu::copyId() { QGuiApplication::clipboard()->setText(QString::number(element_)); }

}  // namespace chainmail
