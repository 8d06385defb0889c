#pragma once

#include <QBoxLayout>
#include <QDockWidget>
#include <QScrollArea>

namespace chainmail {

/// The content of a dock, which scrolls in a low window, because docks must not make the window taller than the screen.
/// It has the size of its content if there is room. Its scroll bar never covers the content.
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

/// Makes a column of parameters the content of a dock, packed at the top.
void setColumn(QDockWidget& dock, QVBoxLayout& column);

}  // namespace chainmail
