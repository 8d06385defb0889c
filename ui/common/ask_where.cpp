#include "common/ask_where.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QRegularExpression>
#include <QSettings>
#include <QStandardPaths>

namespace chainmail {
namespace {

QString saveFolderKey() { return QStringLiteral("saveFolder"); }

/// Returns the folder of the last save; before the first save that of the last opened file, if it can be written to.
QString saveFolder() {
  const QSettings settings;
  const QString recent = settings.value(QStringLiteral("recentFiles")).toStringList().value(0);
  for (const QString& folder :
       {settings.value(saveFolderKey()).toString(), recent.isEmpty() ? QString() : QFileInfo(recent).absolutePath()}) {
    if (!folder.isEmpty() && QFileInfo(folder).isWritable()) {
      return folder;
    }
  }
  return QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
}

/// Returns the first extension of a filter such as 'Video (*.mp4 *.webm)'.
QString extensionOf(const QString& filter) {
  static const QRegularExpression first(QStringLiteral(R"(\*\.([^ )]+))"));
  return first.match(filter).captured(1);
}

}  // namespace

QString askWhere(QWidget& window, const QString& title, const QStringList& filters, const QString& name) {
  QFileDialog dialog(&window, title, saveFolder());
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setNameFilters(filters);
  const auto takeFilter = [&dialog](const QString& filter) {
    const QString before = QLatin1Char('.') + dialog.defaultSuffix();
    QString chosen = QFileInfo(dialog.selectedFiles().value(0)).fileName();
    dialog.setDefaultSuffix(extensionOf(filter));
    if (chosen.endsWith(before)) {
      chosen.chop(before.size());
      dialog.selectFile(chosen + QLatin1Char('.') + dialog.defaultSuffix());
    }
  };
  dialog.setDefaultSuffix(extensionOf(filters.first()));
  dialog.selectFile(name + QLatin1Char('.') + dialog.defaultSuffix());
  QObject::connect(&dialog, &QFileDialog::filterSelected, &dialog, takeFilter);
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) {
    return {};
  }
  QSettings().setValue(saveFolderKey(), QFileInfo(dialog.selectedFiles().first()).absolutePath());
  return dialog.selectedFiles().first();
}

QString askFolder(QWidget& window, const QString& title) {
  QString folder = QFileDialog::getExistingDirectory(&window, title, saveFolder());
  if (!folder.isEmpty()) {
    QSettings().setValue(saveFolderKey(), folder);
  }
  return folder;
}

QString asFileName(const QString& object) {
  static const QRegularExpression unusual(QStringLiteral(R"([^\p{L}\p{N}._]+)"));
  static const QRegularExpression extension(QStringLiteral(R"(\.[A-Za-z][A-Za-z0-9]{0,8}$)"));
  QString name = QString(object).remove(extension).replace(unusual, QStringLiteral("-"));
  while (name.startsWith(QLatin1Char('-')) || name.startsWith(QLatin1Char('.'))) {
    name.remove(0, 1);
  }
  while (name.endsWith(QLatin1Char('-'))) {
    name.chop(1);
  }
  return name.isEmpty() ? QStringLiteral("object") : name;
}

}  // namespace chainmail
