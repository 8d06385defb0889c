#include "io/questions.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QRegularExpression>
#include <QSettings>
#include <QStandardPaths>
#include <array>

#include "common/as_path.h"

namespace chainmail {
namespace {

/// Fills a box with a question and its explanation.
void setUp(QMessageBox& box, const char* name, const QString& what, const QString& why) {
  box.setObjectName(QLatin1String(name));
  box.setWindowTitle(QStringLiteral("ChainMail workbench"));
  box.setIcon(QMessageBox::Warning);
  box.setTextFormat(Qt::PlainText);
  box.setText(what);
  box.setInformativeText(why);
}

/// Asks with *Save as…*, another answer and *Cancel*. Returns 0, 1 or 2 for them; 2 if the box is closed.
int ask(QWidget& window, const char* name, const QString& what, const QString& why, const QString& other) {
  QMessageBox box(&window);
  setUp(box, name, what, why);
  const auto* saveAs = box.addButton(QStringLiteral("Save &as…"), QMessageBox::AcceptRole);
  const auto* second = box.addButton(other, QMessageBox::DestructiveRole);
  box.setDefaultButton(box.addButton(QStringLiteral("&Cancel"), QMessageBox::RejectRole));
  box.exec();
  return box.clickedButton() == saveAs ? 0 : box.clickedButton() == second ? 1 : 2;
}

constexpr std::array overwriteAnswers{OverwriteAnswer::saveAs, OverwriteAnswer::overwrite, OverwriteAnswer::cancel};

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

ClosingAnswer askBeforeClosing(QWidget& window, const QString& why) {
  constexpr std::array answers{ClosingAnswer::saveAs, ClosingAnswer::discard, ClosingAnswer::cancel};
  return answers[std::size_t(ask(window, "closingQuestion",
                                 QStringLiteral("Your unsaved work cannot be kept for the next start"), why,
                                 QStringLiteral("&Discard")))];
}

OverwriteAnswer askBeforeOverwriting(QWidget& window, const QString& path) {
  return overwriteAnswers[std::size_t(
      ask(window, "overwriteQuestion", QStringLiteral("Another program has changed %1").arg(shownName(path)),
          QStringLiteral("Saving replaces what it wrote since this window opened or saved it."),
          QStringLiteral("&Overwrite")))];
}

bool askBeforeReplacing(QWidget& window, const QString& folder, const QStringList& files) {
  QMessageBox box(&window);
  setUp(box, "replaceQuestion",
        QStringLiteral("%1 already has %2").arg(shownName(folder), files.join(QStringLiteral(", "))),
        QStringLiteral("The new files replace them. To keep them, choose another folder."));
  const auto* replace = box.addButton(QStringLiteral("&Replace"), QMessageBox::DestructiveRole);
  box.setDefaultButton(box.addButton(QStringLiteral("&Cancel"), QMessageBox::RejectRole));
  box.exec();
  return box.clickedButton() == replace;
}

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
