#pragma once

#include <QDialog>
#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include "document/document.h"
#include "window/keys_page.h"
#include "window/manual_window.h"

class QMainWindow;

namespace chainmail {

class Actions;

/// Returns the licence of the program and of the libraries that it links, in a few sentences.
QString licenceInWords();

/// Shows version, licences, Qt and OpenGL as plain text, which can be copied into a report of a fault.
class AboutDialog : public QDialog {
  Q_OBJECT

 public:
  explicit AboutDialog(QWidget* parent);
};

/// An animated drag that shows the object in motion on the first start. It ends before the first press of a button or
/// key takes effect, or after 40 s. For the solvers, the object is then exactly at rest, without an undo step or a last
/// drag; the views show it with their next frame.
class ExampleDrag : public QObject {
  Q_OBJECT

 public:
  ExampleDrag(Document& document, QObject* parent);
  ~ExampleDrag() override;

  /// Starts the drag, unless the object has undo steps.
  void start();
  void stop();
  bool running() const { return clock_.isActive(); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void move();

  Document& document_;
  ElementId element_ = 0;
  Point from_ = Point::Zero();
  double reach_ = 0;  // mesh units
  QTimer clock_;
  QElapsedTimer since_;
};

/// The Help menu: the manual, the page of keys, About, and the example of the first start.
class HelpMenu : public QObject {
  Q_OBJECT

 public:
  HelpMenu(QMainWindow& window, Document& document);
  void fill(Actions& actions);
  /// On the first start, shows an example and returns true.
  bool welcome();

 private:
  QMainWindow& window_;
  // Made on first use.
  ManualWindow* manual_ = nullptr;
  KeysPage* keys_ = nullptr;
  AboutDialog* about_ = nullptr;
  ExampleDrag example_;
};

}  // namespace chainmail
