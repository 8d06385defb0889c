#include <QFile>
#include <QLocale>
#include <QMap>
#include <QRegularExpression>
#include <QSet>
#include <QtTest>
#include <bit>
#include <cmath>

#include "body/softness.h"
#include "elastic/material.h"
#include "files/formats/volume.h"
#include "files/import/import_process.h"
#include "files/mesh/mesh_formats.h"
#include "files/session/lesson.h"
#include "files/text/limits.h"
#include "folders.h"
#include "program.h"
#include "solver/algorithms.h"

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

QString text_of(std::string_view text) { return QString::fromUtf8(text.data(), qsizetype(text.size())); }
QString grouped(std::uint64_t number) { return QLocale(QLocale::English).toString(qulonglong(number)); }
QString binary(std::uint64_t number) { return QStringLiteral("2^%1").arg(std::countr_zero(number)); }
QString decimal(double number) { return QStringLiteral("10^%1").arg(std::lround(std::log10(number))); }

/// What each row of the table of limits begins with, by the words that begin its first column.
QMap<QString, QString> limits_of_files() {
  using namespace limits;
  return {
      {"a file that is read as a whole", QStringLiteral("%1 GiB").arg(file_bytes >> 30)},
      {"elements of a mesh", grouped(element_limit)},
      {"coordinates", decimal(coordinate_limit)},
      {"voxels of a volume", binary(voxels)},
      {"voxels in memory", binary(voxels_in_memory)},
      {"points of a grid in `.vtk`", grouped(points_without_values)},
      {"compressed voxels", grouped(compression_ratio) + " times"},
      {"densities of voxels", "from −" + decimal(density_limit) + " to " + decimal(density_limit)},
      {"header of a volume",
       QStringLiteral("%1 bytes (MetaImage); %2 MiB and %3 lines (NRRD)")
           .arg(grouped(metaimage_header_bytes), grouped(nrrd_header_bytes >> 20), grouped(nrrd_header_lines))},
      {"data files of a volume", grouped(metaimage_files) + " (MetaImage), " + grouped(nrrd_files) + " (NRRD)"},
      {"name of an object", grouped(name_bytes) + " bytes"},
      {"text of a step of a lesson", grouped(caption_bytes) + " bytes"},
      {"any other text", grouped(text_bytes) + " bytes"},
      {"panels of a session", grouped(session_panels)},
      {"steps of a lesson", grouped(lesson_steps)},
      {"recorded moves in a session", grouped(session_moves)},
      {"splits in recorded moves", grouped(split_parts)},
      {"recorded moves in a file", grouped(moves)},
      {"values in a session", QStringLiteral("%1, without long arrays of numbers; an object or array counts as %2, "
                                             "a key as %3")
                                  .arg(grouped(json_values), grouped(values_of_container), grouped(values_of_key))},
      {"nesting of JSON", grouped(json_levels) + " levels"},
      {"presets of softness", grouped(presets) + ", with names of at most " + grouped(preset_name_bytes) + " bytes"},
      {"`chainmail-import`",
       QStringLiteral("2 GiB and 40 times the size of the file; %1 s of processor time").arg(ImportLimits().seconds)}};
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
  void the_manual_lists_each_limit();
  void the_manual_lists_each_algorithm_energy_and_law();
  void the_manual_has_the_limits_of_lessons();
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

void ManualTablesTest::the_manual_lists_each_limit() {
  QMap<QString, QString> limits = limits_of_files();
  const QString table = text_of("resources/manual/formats.md").section("| what | limit |", 1).section("\n\n", 0, 0);
  for (const QString& row : table.split('\n').filter(QRegularExpression("^\\| [^-]"))) {
    const QString what = row.section(" | ", 0, 0).mid(2), limit = row.section(" | ", 1);
    const QStringList begins = limits.keys();
    const auto key = std::ranges::find_if(begins, [&](const QString& one) { return what.startsWith(one); });
    QVERIFY2(key != begins.end(), qPrintable(row));
    const QRegularExpression whole("^" + QRegularExpression::escape(limits.take(*key)) + "(?!,?\\d)");
    QVERIFY2(limit.contains(whole), qPrintable(row));
  }
  QVERIFY2(limits.isEmpty(), qPrintable(limits.keys().join(", ")));
}

void ManualTablesTest::the_manual_lists_each_algorithm_energy_and_law() {
  const QString page = text_of("resources/manual/algorithms.md"), physics = text_of("resources/manual/physics.md");
  for (const AlgorithmInfo& one : algorithms()) {
    const QString row = QStringLiteral("\n| %1 | `%2` |").arg(text_of(one.label), text_of(one.offered_name()));
    QVERIFY2(page.contains(row), qPrintable(row));
  }
  for (const EnergyKindInfo& one : energy_kinds()) {
    const bool is_of_links = one.kind != EnergyKind::material;
    QCOMPARE(page.contains(QStringLiteral("\n| `%1` |").arg(text_of(one.name))), is_of_links);
  }
  for (const StrainLaw::Kind kind : strain_laws) {
    const auto number = number_of(kind);
    const QString option = number ? "`--" + text_of(number->name) + "`" : "|";
    const QRegularExpression row("\n\\| `" + QString::fromStdString(name(kind)) + "`[^\n]* \\| " +
                                 QRegularExpression::escape(option));
    QVERIFY2(physics.contains(row), qPrintable(row.pattern()));
  }
}

void ManualTablesTest::the_manual_has_the_limits_of_lessons() {
  const QString page = text_of("resources/manual/sessions.md");
  QVERIFY(page.contains("| `steps` | 1 to " + grouped(limits::lesson_steps) + " steps"));
  QVERIFY(page.contains(QStringLiteral("for %1 to %2 panels").arg(lesson_panels_least).arg(lesson_panels_most)));
}

CHAINMAIL_TEST(ManualTablesTest)

}  // namespace chainmail::test_manual_tables

#include "test_manual_tables.moc"
