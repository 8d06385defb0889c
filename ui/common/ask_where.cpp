#include "common/ask_where.h"

#include <QFileDialog>

namespace chainmail {

QString askWhere(QWidget& window, const QString& title, const QStringList& filters, const QString& folder) {
  QFileDialog dialog(&window, title, folder);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setNameFilters(filters);
  const auto takeSuffix = [&dialog](const QString& filter) {
    dialog.setDefaultSuffix(filter.section(QStringLiteral("*."), 1).chopped(1));
  };
  takeSuffix(filters.first());
  QObject::connect(&dialog, &QFileDialog::filterSelected, &dialog, takeSuffix);
  return dialog.exec() == QDialog::Accepted ? dialog.selectedFiles().value(0) : QString();
}

}  // namespace chainmail
