#include "common/table_text.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QKeyEvent>
#include <QTableWidget>

namespace chainmail {
namespace {

/// Handles the copy keys of a table. A shortcut of the window would take the keys from text fields.
class CopyKeys : public QObject {
 public:
  explicit CopyKeys(QTableWidget& table) : QObject(&table), table_(table) { table.installEventFilter(this); }

  bool eventFilter(QObject* watched, QEvent* event) override {
    if ((event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride) &&
        dynamic_cast<QKeyEvent*>(event)->matches(QKeySequence::Copy)) {
      event->accept();
      if (event->type() == QEvent::KeyPress) {
        QGuiApplication::clipboard()->setText(textOf(table_));
      }
      return true;
    }
    return QObject::eventFilter(watched, event);
  }

 private:
  QTableWidget& table_;
};

}  // namespace

QString textOf(const QTableWidget& table) {
  QStringList lines, heads;
  for (int column = 0; column < table.columnCount(); ++column) {
    heads << table.horizontalHeaderItem(column)->text().replace(QLatin1Char('\n'), QLatin1Char(' '));
  }
  lines << heads.join(QLatin1Char('\t'));
  for (int row = 0; row < table.rowCount(); ++row) {
    QStringList cells;
    for (int column = 0; column < table.columnCount(); ++column) {
      const QTableWidgetItem* item = table.item(row, column);
      cells << (item == nullptr ? QString() : item->text().trimmed());
    }
    lines << cells.join(QLatin1Char('\t'));
  }
  return lines.join(QLatin1Char('\n')) + QLatin1Char('\n');
}

void copyByKeys(QTableWidget& table) { new CopyKeys(table); }

}  // namespace chainmail
