#pragma once

#include <QBoxLayout>
#include <QWidget>
#include <algorithm>
#include <functional>
#include <vector>

#include "common/text.h"
#include "mesh/described.h"

namespace chainmail {

/// Makes a row of fields after their name, which all have the same tooltip.
QWidget* namedRow(const QString& name, const QString& help, const std::vector<QWidget*>& fields);

/// The row of a member of a described struct: a slider and a field for a number, a list for a choice, and a field for
/// each number of an array.
struct MemberRow {
  QWidget* widget;
  std::vector<QWidget*> fields;                           // of an array, one for each axis
  std::function<void(std::size_t i, double value)> show;  // item `i`, as if the user had not changed it
};
/// Makes a row. `changed` receives what the user enters; see ParameterRow for `gesture`.
MemberRow makeRow(const MemberInfo& member,
                  const std::function<void(std::size_t i, double value, int gesture)>& changed);

/// The rows of all members of a described struct, in their order.
template <class Struct>
class MemberRows {
  static_assert(std::ranges::none_of(members_of<Struct>, is_yes_or_no), "makeRow has no check box yet");

 public:
  /// Receives the changed struct, the name of the member, and the gesture.
  using Change = std::function<void(const Struct& all, const QString& label, int gesture)>;

  /// `present` returns the struct that the rows show and change.
  MemberRows(std::function<const Struct&()> present, const Change& change) : present_(std::move(present)) {
    for (const Member<Struct>& member : members_of<Struct>) {
      rows_.push_back(makeRow(member, [=, this, &member](std::size_t i, double value, int gesture) {
        Struct all = present_();
        member.set(all, i, value);
        change(all, text(member.label), gesture);
      }));
    }
  }
  MemberRows(const MemberRows&) = delete;
  MemberRows& operator=(const MemberRows&) = delete;
  ~MemberRows() = default;

  void addTo(QBoxLayout& column) const {
    for (const MemberRow& row : rows_) {
      column.addWidget(row.widget);
    }
  }
  /// Shows the present values of the members that the rule names, and of an array those along the named axes.
  void show(const std::function<bool(const MemberInfo&)>& isShown,
            const std::function<bool(std::size_t axis)>& hasAxis) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const Member<Struct>& member = members_of<Struct>[k];
      for (std::size_t i = 0; i < member.count; ++i) {
        rows_[k].show(i, member.get(present_(), i));
      }
      for (std::size_t axis = 0; axis < rows_[k].fields.size(); ++axis) {
        rows_[k].fields[axis]->setVisible(hasAxis(axis));
      }
      rows_[k].widget->setVisible(isShown(member));
    }
  }

 private:
  std::function<const Struct&()> present_;
  std::vector<MemberRow> rows_;
};

}  // namespace chainmail
