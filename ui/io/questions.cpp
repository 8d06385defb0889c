#include "io/questions.h"

#include <QMessageBox>
#include <QPushButton>
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

}  // namespace chainmail
