#pragma once

#include <QBoxLayout>
#include <QDockWidget>
#include <QScrollArea>

namespace chainmail {

/// The content of a dock that a low window scrolls: the docks must not make it taller than a screen. Where there is
/// room it takes as much as its content, and its bar never lies over that.
class DockScroll : public QScrollArea {
  Q_OBJECT

 public:
  explicit DockScroll(QWidget* content);

  QSize sizeHint() const override { return widget()->sizeHint(); }

 protected:
  bool eventFilter(QObject* content, QEvent* event) override;

 private:
  void fitWidth();
};

/// Makes a column of parameters, closely set from the top, the content of a dock.
void setColumn(QDockWidget& dock, QVBoxLayout& column);

}  // namespace chainmail
