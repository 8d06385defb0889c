#pragma once

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QtTest>

#include "folders.h"

namespace chainmail::test {

/// A document, and the name of its schema in the build.
struct SchemaDocument {
  QString schema;
  QString path;
};

/// The result of a check.
struct SchemaCheck {
  QString fault;         // empty if the document follows its schema
  QStringList accepted;  // mistakes in it that the schema does not find
};

inline QString schema_path(const QString& name) {
  return builtFile("share/chainmail/schemas") + QLatin1Char('/') + name + QStringLiteral(".schema.json");
}

/// Checks documents with an independent reader of JSON Schema, all in one process.
inline QList<SchemaCheck> check_schemas(const QList<SchemaDocument>& documents) {
  QStringList arguments{sourceFile("tests/cli/check_schemas.py")};
  for (const SchemaDocument& document : documents) {
    arguments << schema_path(document.schema) << document.path;
  }
  QProcess process;
  process.start(QStringLiteral("/usr/bin/python3"), arguments);
  process.waitForFinished(120'000);
  const QByteArray error = process.readAllStandardError();
  const QJsonArray results = QJsonDocument::fromJson(process.readAllStandardOutput()).array();
  QList<SchemaCheck> checks;
  for (qsizetype i = 0; i < documents.size(); ++i) {
    const QJsonObject one = results.at(i).toObject();
    const QString fault = results.size() == documents.size() ? one[QStringLiteral("fault")].toString()
                                                             : QStringLiteral("not checked: ") + error;
    checks.append({fault, one[QStringLiteral("accepted")].toVariant().toStringList()});
  }
  return checks;
}

}  // namespace chainmail::test
