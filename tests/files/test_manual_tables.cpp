#include <QFile>
#include <QMap>
#include <QRegularExpression>
#include <QSet>
#include <QtTest>

#include "body/softness.h"
#include "files/mesh/mesh_formats.h"
#include "folders.h"
#include "program.h"

namespace chainmail::test_manual_tables {

namespace {

QString text_of(const char* path) {
  QFile file(sourceFile(path));
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

QStringList endings_of(const MeshFormat& format) {
  return QString::fromUtf8(format.endings.data(), qsizetype(format.endings.size())).split(' ');
}

/// The other columns of a row of the manual's table, by each ending in its first one.
QMap<QString, QStringList> rows_of_manual() {
  static const QRegularExpression ending("`(\\.[a-z]+)`");
  QMap<QString, QStringList> rows;
  const QStringList lines = text_of("resources/manual/formats.md").split('\n');
  for (const QString& line : lines.filter(QRegularExpression("^\\| `\\."))) {
    const QStringList columns = line.split('|');
    for (auto found = ending.globalMatch(columns.value(1)); found.hasNext();) {
      rows[found.next().captured(1)] = columns;
    }
  }
  return rows;
}

/// Endings of which the system knows the type.
const QMap<QString, QString> known_types{{".obj", "model/obj"}, {".stl", "model/stl"}};
/// Files of any kind have this one.
const QString too_common = ".dat";

QMap<QString, QString> types_by_ending() {
  static const QRegularExpression part("<mime-type type=\"([^\"]+)\"|<glob pattern=\"\\*(\\.[a-z]+)\"");
  QMap<QString, QString> types = known_types;
  QString type;
  for (auto found = part.globalMatch(text_of("resources/chainmail.mime.xml")); found.hasNext();) {
    const auto one = found.next();
    if (!one.captured(1).isEmpty()) {
      type = one.captured(1);
    } else {
      types[one.captured(2)] = type;
    }
  }
  return types;
}

QSet<QString> types_in(const char* path) {
  static const QRegularExpression line("^MimeType=(.*)$", QRegularExpression::MultilineOption);
  const QStringList types = line.match(text_of(path)).captured(1).split(';', Qt::SkipEmptyParts);
  return {types.begin(), types.end()};
}

}  // namespace

/// What the manual and the desktop say about formats and numbers agrees with their tables.
class ManualTablesTest : public QObject {
  Q_OBJECT

 private slots:
  void the_manual_lists_each_format();
  void the_desktop_opens_each_format();
  void the_manual_lists_each_number_of_softness();
};

void ManualTablesTest::the_manual_lists_each_format() {
  QMap<QString, QStringList> rows = rows_of_manual();
  for (const MeshFormat& format : mesh_formats()) {
    for (const QString& ending : endings_of(format)) {
      QVERIFY2(rows.contains(ending), qPrintable(ending));
      const QStringList columns = rows.take(ending);
      QVERIFY2(columns.value(2).trimmed().isEmpty() != format.reads(), qPrintable(ending));
      QVERIFY2(columns.value(3).trimmed().isEmpty() != format.writes(), qPrintable(ending));
    }
  }
  QVERIFY2(rows.isEmpty(), qPrintable(rows.keys().join(' ')));
}

void ManualTablesTest::the_desktop_opens_each_format() {
  const QMap<QString, QString> types = types_by_ending();
  QSet<QString> opened{types.value(".chainmail")};
  for (const MeshFormat& format : mesh_formats()) {
    for (const QString& ending : endings_of(format)) {
      if (format.reads() && ending != too_common) {
        QVERIFY2(types.contains(ending), qPrintable(ending));
        opened.insert(types.value(ending));
      }
    }
  }
  QCOMPARE(types_in("resources/org.chainmail.workbench.desktop"), opened);
}

void ManualTablesTest::the_manual_lists_each_number_of_softness() {
  const auto written = [](double number) { return QString::number(number, 'g', 10); };
  const QString page = text_of("resources/manual/algorithms.md");
  for (const auto& [parameter, value] : softness_numbers) {
    const QString highest =
        parameter->highest == parameters::no_highest ? QStringLiteral("or more") : "to " + written(parameter->highest);
    const QString row = QStringLiteral("| %1 | `%2` | %3 | %4 %5 | %6 |\n")
                            .arg(QString::fromUtf8(parameter->label.data()), QString::fromUtf8(parameter->name.data()),
                                 written(parameter->default_value), written(parameter->lowest), highest,
                                 QString::fromUtf8(parameter->help.data()));
    QVERIFY2(page.contains(row), qPrintable("algorithms.md lacks: " + row));
  }
}

CHAINMAIL_TEST(ManualTablesTest)

}  // namespace chainmail::test_manual_tables

#include "test_manual_tables.moc"
