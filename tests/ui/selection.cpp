// Tests which elements and links are selected after a stroke.

#include "document/selection.h"

#include <QTest>

#include "mesh/generate.h"
#include "program.h"

namespace chainmail::selection {

class SelectionTest : public QObject {
  Q_OBJECT

 private slots:
  void strokesReplaceAddAndRemove() {
    const std::vector<ElementId> before{1, 3, 5}, hit{3, 4};
    QCOMPARE(combined(before, hit, SelectionMode::replace), hit);
    QCOMPARE(combined(before, hit, SelectionMode::add), (std::vector<ElementId>{1, 3, 4, 5}));
    QCOMPARE(combined(before, hit, SelectionMode::remove), (std::vector<ElementId>{1, 5}));
  }

  void aLinkNeedsBothItsEnds() {
    const auto mesh = generate({MeshKind::grid, {3, 3, 1}, 1, {}});
    const auto links = linksAmong(*mesh, Cuts(mesh), {0, 1, 4, 8});
    QCOMPARE(links, (std::vector<LinkId>{*find_link(*mesh, 0, 1), *find_link(*mesh, 1, 4)}));
  }

  void everyLinkOfTheWholeIsThereOnceAndCutsAreNot() {
    const auto mesh = generate({MeshKind::tetra, {3, 3, 3}, 1, {}});
    std::vector<ElementId> all;
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      all.push_back(e);
    }
    Cuts cuts(mesh);
    cuts.cut(7);
    const auto links = linksAmong(*mesh, cuts, all);
    QCOMPARE(links.size(), std::size_t{mesh->link_count()} - 1);
    for (LinkId link = 0, i = 0; link < mesh->link_count(); ++link) {
      if (link != 7) {
        QCOMPARE(links[i++], link);
      }
    }
  }
};

CHAINMAIL_TEST(SelectionTest)

}  // namespace chainmail::selection

#include "selection.moc"
