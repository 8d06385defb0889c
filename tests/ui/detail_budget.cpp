// Tests how measured times choose the detail of moving objects.

#include <QTest>

#include "drawing/object_drawing.h"
#include "program.h"

namespace chainmail::detail_budget {

class DetailBudgetTest : public QObject {
  Q_OBJECT

 private slots:
  void slowPicturesLeadToFewerShapes() {
    DetailBudget budget;
    for (int frame = 0; frame < 30; ++frame) {
      budget.tookQuick(budget.maxShapes(), double(budget.maxShapes()) / 3'000);  // 3,000 shapes per ms
    }
    QVERIFY(budget.maxShapes() > 90'000 && budget.maxShapes() < 110'000);  // about 33 ms
  }
  void fastPicturesLeadToMoreShapes() {
    DetailBudget budget;
    for (int frame = 0; frame < 30; ++frame) {
      budget.tookQuick(200'000, 2);
    }
    QCOMPARE(budget.maxShapes(), DetailBudget::maxAtRest);
  }
  void smallPicturesSayNothing() {
    DetailBudget budget;
    const std::size_t before = budget.maxShapes();
    budget.tookQuick(100, 500);
    QCOMPARE(budget.maxShapes(), before);
  }
  void completePicturesFollowTheMouseIfTheyAreFast() {
    DetailBudget budget;
    QVERIFY(!budget.affordsComplete());  // unknown
    budget.tookComplete(5);
    QVERIFY(budget.affordsComplete());
    budget.tookComplete(40);
    QVERIFY(!budget.affordsComplete());
  }
};

CHAINMAIL_TEST(DetailBudgetTest)

}  // namespace chainmail::detail_budget

#include "detail_budget.moc"
