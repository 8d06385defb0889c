#pragma once

#include <QBoxLayout>
#include <QDockWidget>
#include <QScrollArea>

namespace chainmail {

/// The content of a dock, which scrolls where there is no room for it: docks must not make the window larger than the
/// screen. It has the size of its content if there is room, and is at most as tall if the content does not grow. A
/// content of fixed height scrolls across only.
class DockScroll : public QScrollArea {
  Q_OBJECT

 public:
  explicit DockScroll(QWidget* content);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* content, QEvent* event) override;

 private:
  void fitWidth();
  /// The least width of the content with the scroll bar beside it, which does not cover it (pixels).
  int contentWidth() const;
};

/// Makes a column of parameters the content of a dock, packed at the top.
void setColumn(QDockWidget& dock, QVBoxLayout& column);

}  // namespace chainmail
