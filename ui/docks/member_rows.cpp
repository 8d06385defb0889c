#include "docks/member_rows.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSpinBox>

#include "common/number_field.h"
#include "common/text.h"

namespace chainmail {
namespace {

using Changed = std::function<void(std::size_t i, double value, int gesture)>;

QWidget* withFields(const MemberInfo& member, const std::vector<QWidget*>& fields) {
  return namedRow(text(member.label), sentence(text(member.help)), fields);
}

MemberRow makeNumber(const MemberInfo& member, const Changed& changed) {
  auto* row = new ParameterRow(*member.number);
  QObject::connect(row, &ParameterRow::changed, row, [=](double value, int gesture) { changed(0, value, gesture); });
  return {row, {}, [row](std::size_t, double value) { row->show(value); }};
}

MemberRow makeChoice(const MemberInfo& member, const Changed& changed) {
  auto* list = new QComboBox;
  list->setObjectName(text(member.key));
  list->setFocusPolicy(Qt::StrongFocus);  // the wheel scrolls the dock, without changing the field
  for (const std::string_view label : member.labels) {
    list->addItem(text(label), list->count());
  }
  QObject::connect(list, &QComboBox::activated, list, [=](int index) { changed(0, index, 0); });
  return {withFields(member, {list}), {}, [list](std::size_t, double value) { list->setCurrentIndex(int(value)); }};
}

MemberRow makeArray(const MemberInfo& member, const Changed& changed) {
  std::vector<QSpinBox*> counts;
  for (std::size_t i = 0; i < member.count; ++i) {
    auto* count = counts.emplace_back(new QSpinBox);
    count->setObjectName(text(member.key) + QLatin1Char("XYZ"[i]));
    count->setAccessibleName(QStringLiteral("%1 along %2").arg(text(member.label)).arg(QLatin1Char("xyz"[i])));
    count->setRange(int(member.number->lowest), int(member.number->highest));
    count->setKeyboardTracking(false);
    QObject::connect(count, &QSpinBox::valueChanged, count, [=](int value) { changed(i, value, 0); });
    QObject::connect(count, &QSpinBox::editingFinished, count, &QWidget::clearFocus);  // shortcuts work again
  }
  const std::vector<QWidget*> fields(counts.begin(), counts.end());
  return {withFields(member, fields), fields, [counts](std::size_t i, double value) {
            const QSignalBlocker block(counts[i]);
            counts[i]->setValue(int(value));
          }};
}

}  // namespace

QWidget* namedRow(const QString& name, const QString& help, const std::vector<QWidget*>& fields) {
  auto* row = new QWidget;
  auto* label = new QLabel(name);
  label->setBuddy(fields.front());
  label->setToolTip(help);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(label, fields.size() == 1 ? 0 : 1);
  for (QWidget* field : fields) {
    field->setToolTip(help);
    layout->addWidget(field, fields.size() == 1 ? 1 : 0);
  }
  return row;
}

MemberRow makeRow(const MemberInfo& member, const Changed& changed) {
  return !member.names.empty() ? makeChoice(member, changed)
         : member.count > 1    ? makeArray(member, changed)
                               : makeNumber(member, changed);
}

}  // namespace chainmail
