#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <array>
#include <memory>
#include <span>
#include <string_view>

#include "document/document.h"
#include "document/background_reference.h"
#include "drawing/colour_values.h"

namespace chainmail {

enum class ColourMode { plain, compression, stretch, shear, violation, distance, violationDifference, truth };

/// How a mode is called: `name` in settings and tests, `label` in the menu, `title` and `unit` in the legend.
struct ColourModeInfo {
  ColourMode mode;
  std::string_view name, label, title, unit;
};
std::span<const ColourModeInfo> colourModes();
const ColourModeInfo& info(ColourMode mode);
/// Whether a panel's values follow from another panel's object too.
bool comparesPanels(ColourMode mode);

/// Works out what the objects of the panels are coloured by. It does so for panels that are painted alone, only when
/// something has changed, and in slices, so that a large mesh lags behind instead of the window.
class Colouring : public QObject {
  Q_OBJECT

 public:
  explicit Colouring(const Document& document);

  ColourMode mode() const { return mode_; }
  void setMode(ColourMode mode);
  /// The panel that all others are compared with, by modes that compare; itself it is compared with the one of them
  /// that is furthest off.
  int reference() const { return reference_; }
  void setReference(int panel);
  /// Whether a colour means the same in all panels, or each has a scale of its own.
  bool sharesScale() const { return sharesScale_; }
  void setSharesScale(bool shares);

  /// To be called when a panel is painted. The values for its newest frame, or for one a little older while those are
  /// being worked out; none in plain mode and as long as there are none.
  const ColourValues* follow(int panel);
  /// A panel that is not painted any more has no part in the scale.
  void forget(int panel);
  ColourScale scale(int panel) const { return scales_[panel]; }
  /// What the values of a panel are, for its legend.
  QString title(int panel) const;

 signals:
  void modeChanged();
  /// There is something else to paint.
  void changed();

 private:
  /// Positions of a panel as they were in a frame.
  struct Kept {
    std::vector<float> positions;
    std::uint64_t number = 0, series = 0;  // of the frame

    /// Copies what has changed since.
    void follow(const Frame& frame);
  };
  /// The values of a panel, and those that will take their place.
  struct Work {
    bool outdated = true, running = false;
    std::size_t next = 0;
    ColourValues building, shown;
    std::vector<int> others;  // the panels that it is compared with
    // As they were when the work began, by the panel: frames and softness may change meanwhile.
    std::array<Kept, Document::mostPanels> kept;
    std::shared_ptr<const Softness> softness;
    std::shared_ptr<const BackgroundReference::Answer> truth;
    double squares = 0, rms = 0;  // of what is being built, and of what is shown
  };

  void receiveFrame(int panel);
  void startOver();
  void followTruth();
  void followPanels();
  bool start(int panel);
  std::vector<int> comparedWith(int panel) const;
  void advance(int panel);
  void finish(Work& work);
  float value(int panel, std::size_t i) const;
  float violation(const Work& work, int panel, LinkId link) const;
  float distance(const Work& work, int panel, int other, ElementId element) const;
  float error(const Work& work, int panel, ElementId element) const;
  QString errorInWords(const Work& work) const;
  void goOn();
  void updateScales();
  ColourScale finished(ColourScale scale) const;

  const Document& document_;
  BackgroundReference truth_;
  ColourMode mode_ = ColourMode::plain;
  std::array<Work, Document::mostPanels> works_;
  std::array<ColourScale, Document::mostPanels> scales_;
  int reference_ = 0;
  bool sharesScale_ = true;
  std::uint64_t number_ = 0;
  QTimer timer_;
};

}  // namespace chainmail
