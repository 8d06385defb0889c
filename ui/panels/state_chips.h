#pragma once

#include <QStringList>
#include <QWidget>
#include <vector>

namespace chainmail {

/// The states of a panel's object for which its head has no room, as chips that wrap. They lie over the upper edge of
/// the view, which they do not move, and let the mouse through.
class StateChips : public QWidget {
  Q_OBJECT

 public:
  explicit StateChips(QWidget& view);
  void setStates(const QStringList& states);
  QStringList states() const { return states_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void changeEvent(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void place();

  QWidget& view_;
  QStringList states_;
  std::vector<QRect> chips_;  // one for each state
};

}  // namespace chainmail
