#include "docks/calibration_box.h"

#include <QHBoxLayout>
#include <QLocale>
#include <QVBoxLayout>

#include "common/text.h"
#include "document/edits.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

QString rounded(double number) { return QLocale().toString(number, 'g', 2); }

QString change(const char* name, double before, double after) {
  return QStringLiteral("%1 %2 → <b>%3</b>").arg(QLatin1String(name), rounded(before), rounded(after));
}

QString errors(const TestedDrags& tested) {
  const Residual &before = tested.before, &after = tested.after;
  return QStringLiteral("%1 (nothing moves: %2), %3, %4 of the handle's displacement")
      .arg(change("relative error", before.relative, after.relative), rounded(tested.nothing.relative),
           change("RMS", before.rms, after.rms), change("max", before.max, after.max));
}

}  // namespace

CalibrationBox::CalibrationBox(Document& document, Jobs& jobs)
    : document_(document),
      jobs_(jobs),
      start_(new QPushButton(QStringLiteral("Calibrate softness"))),
      keep_(new QPushButton(QStringLiteral("Save as preset…"))),
      result_(new QLabel) {
  arrange();
  connect(start_, &QPushButton::clicked, this, &CalibrationBox::start);
  connect(keep_, &QPushButton::clicked, this, &CalibrationBox::presetRequested);
  connect(&document, &Document::pinsChanged, this, &CalibrationBox::adapt);
  connect(&document, &Document::meshChanged, this, [this] {
    result_->hide();
    keep_->hide();
    adapt();
  });
  connect(&jobs, &Jobs::changed, this, &CalibrationBox::adapt);
  adapt();
}

void CalibrationBox::arrange() {
  start_->setObjectName(QStringLiteral("calibrate"));
  keep_->setObjectName(QStringLiteral("calibrationKeep"));
  keep_->setToolTip(QStringLiteral("Saves the present softness under a name"));
  result_->setTextFormat(Qt::RichText);
  result_->setObjectName(QStringLiteral("calibrationResult"));
  result_->setWordWrap(true);
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  result_->setToolTip(
      QStringLiteral("Distance of the elements from neo-Hookean FEM on the same cells after random drags, before → "
                     "after calibration. Relative error: RMS distance divided by the RMS displacement of the reference "
                     "solution; about 1 if nothing moves. The search does not use the unseen drags."));
  result_->hide();
  keep_->hide();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(start_);
  column->addWidget(result_);
  column->addWidget(keep_);
}

/// Enables or disables the start button. While it is disabled, its tool tip explains why.
void CalibrationBox::adapt() {
  const QString why = whyNot();
  start_->setEnabled(why.isEmpty());
  start_->setToolTip(
      why.isEmpty() ? QStringLiteral("Searches in the background for the softness and relaxation with which %1 comes "
                                     "closest to neo-Hookean FEM on this object, as one undo step")
                          .arg(text(info(algorithm()).label))
                    : why);
}

QString CalibrationBox::whyNot() const {
  if (jobs_.running()) {
    return QStringLiteral("'%1' is running: wait for it, or cancel it").arg(jobs_.text());
  }
  if (document_.pins().empty()) {
    return QStringLiteral("Nothing pins this object, so FEM has no solution: pin a layer first");
  }
  try {
    check(ElasticMethod::neo_hookean, *document_.mesh());
  } catch (const Error& error) {
    return QString::fromStdString(error.what());
  }
  return {};
}

/// Returns the first algorithm of the ChainMail family in the panels; Exact if there is none.
Algorithm CalibrationBox::algorithm() const {
  for (int panel = 0; panel < document_.panels(); ++panel) {
    if (info(document_.algorithm(panel)).uses_softness()) {
      return document_.algorithm(panel);
    }
  }
  return Algorithm::exact;
}

void CalibrationBox::start() {
  CalibrationOptions options;
  options.elastic = document_.elastic();
  options.pins = document_.pins();
  options.algorithm = algorithm();
  options.scheme = document_.relaxation().scheme;
  options.energy = energy_of_links(document_.wholeSoftness()->energy);
  jobs_.start(
      Jobs::Kind::compute, QStringLiteral("Calibrating softness"),
      [this, options, mesh = document_.mesh(), cuts = document_.cuts()](const Progress& progress) -> Jobs::Finish {
        const CalibrationResult result = calibrate(mesh, cuts, options, progress);
        return [this, result, options, mesh] {
          if (mesh == document_.mesh()) {
            take(result, options);
          }
        };
      });
}

void CalibrationBox::take(const CalibrationResult& result, const CalibrationOptions& options) {
  const bool atEquilibrium = !info(options.scheme).sweeps;
  edits::setCalibrated(document_, result.softness, options.energy,
                       {atEquilibrium || result.sweeps > 0, 1, options.scheme});
  const QString sweeps = atEquilibrium        ? QStringLiteral("at equilibrium")
                         : result.sweeps == 0 ? QStringLiteral("without relaxation")
                                              : QStringLiteral("with %1 of relaxation after each move")
                                                    .arg(counted(std::size_t(result.sweeps), QStringLiteral("sweep")));
  const QLocale locale;
  result_->setText(QStringLiteral("%1, %2: %3; %4 evaluations.<br>On %5 unseen drags: %6.")
                       .arg(text(info(options.algorithm).label), sweeps, errors(result.fitted),
                            locale.toString(result.evaluations),
                            locale.toString(qulonglong(result.held_out.drags.size())), errors(result.held_out)));
  result_->show();
  keep_->show();
}

}  // namespace chainmail
