#pragma once

#include <QDialog>

namespace chainmail {

/// Returns the licence of the program and of the libraries that it links, in a few sentences.
QString licenceInWords();

/// Shows version, licences, Qt and OpenGL as plain text, which can be copied into a report of a fault.
class AboutDialog : public QDialog {
  Q_OBJECT

 public:
  explicit AboutDialog(QWidget* parent);
};

}  // namespace chainmail
