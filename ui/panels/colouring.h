#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "document/background_reference.h"
#include "document/document.h"
#include "drawing/colour_map.h"

namespace chainmail {

/// How the range of a colour scale is chosen: from the values, as a fixed range, or from the values on a logarithmic
/// scale.
struct ColourRange {
  enum class Kind { automatic, fixed, logarithmic };
  static constexpr double limit = 1e6;         // of the magnitude of both ends
  static constexpr double smallestGap = 1e-4;  // between the ends

  Kind kind = Kind::automatic;
  double lowest = 0, highest = 1;  // of a fixed range

  /// True if a fixed range has finite ends in order. Every other kind is valid.
  bool valid() const {
    return kind != Kind::fixed || (std::abs(lowest) <= limit && std::abs(highest) <= limit &&
                                   highest - lowest >= smallestGap * 0.999);  // the ends are rounded
  }
  bool operator==(const ColourRange&) const = default;
};

enum class ColourMode {
  plain,
  compression,
  stretch,
  shear,
  length,
  violation,
  distance,
  violationDifference,
  physicsError
};

/// The quantity of a mode. Its names: `name` in settings and tests, `label` in the menu, `title` and `unit` in the
/// legend. Its values lie between `least` and `most`, and `centre` is the value of an object at rest.
struct ColourModeInfo {
  ColourMode mode;
  std::string_view name, label, title, unit, definition;
  float least = 0, most = std::numeric_limits<float>::infinity(), centre = 0;
};
std::span<const ColourModeInfo> colourModes();
const ColourModeInfo& info(ColourMode mode);
/// True if the values of a panel also depend on another panel's object.
bool comparesPanels(ColourMode mode);
/// True if the middle of a mode's scale is a neutral value, and not its beginning.
bool isDiverging(ColourMode mode);

/// Computes the values that colour the objects of the panels. It computes only for panels that are painted, only after
/// a change, and in short time slices. So the colours of a large mesh may lag behind, but the window stays responsive.
class Colouring : public QObject {
  Q_OBJECT

 public:
  explicit Colouring(const Document& document);

  ColourMode mode() const { return mode_; }
  void setMode(ColourMode mode);
  /// The reference panel of modes that compare panels. This panel itself is compared with the panel that differs most.
  int reference() const { return reference_; }
  void setReference(int panel);
  /// True if all panels share one scale, so that a colour means the same value in each.
  bool sharesScale() const { return sharesScale_; }
  void setSharesScale(bool shares);
  /// The range of the scale in the current mode.
  const ColourRange& range() const { return ranges_[std::size_t(mode_)]; }
  /// Sets the range of the current mode, or of any mode. It must be valid.
  void setRange(const ColourRange& range) { setRange(mode_, range); }
  void setRange(ColourMode mode, const ColourRange& range);

  /// Call this when a panel is painted. Returns the values of its newest frame, or those of a slightly older frame
  /// while the new ones are computed. Returns null in plain mode and before the first values are ready.
  const ColourValues* follow(int panel);
  /// Drops the values of a panel that is no longer painted. They no longer count for the shared scale.
  void forget(int panel);
  ColourScale scale(int panel) const { return scales_[panel]; }
  /// The title of a panel's legend.
  QString title(int panel) const;
  /// True if the panels' titles differ.
  bool hasTitlesOfPanels() const { return comparesPanels(mode_) || mode_ == ColourMode::physicsError; }
  /// The title of a legend for all panels.
  QString title() const;

 signals:
  void modeChanged();
  /// The panels need a repaint.
  void changed();

 private:
  /// A copy of the positions in a panel's frame.
  struct Copy {
    std::vector<float> positions;
    std::uint64_t number = 0, series = 0;  // of the frame
    FrameSpace space;

    /// Copies the blocks that changed since the last frame.
    void follow(const Frame& frame);
  };
  /// The values of a panel that are shown, and those that are being computed.
  struct Work {
    bool outdated = true, running = false;
    std::size_t next = 0;
    ColourValues building, shown;
    std::vector<int> others;  // the panels that it is compared with
    // Copied when the work begins, because frames, softness and the reference solution may change during the work.
    std::array<Copy, Document::maxPanels> copies;
    std::shared_ptr<const Softness> softness;
    std::shared_ptr<const BackgroundReference::Answer> solution;
    double squares = 0, rms = 0;  // sum of squares of the values being computed, and RMS of those shown
  };

  void receiveFrame(int panel);
  void followSolution();
  void followPanels();
  void startOver();

  bool start(int panel);
  std::vector<int> comparedWith(int panel) const;
  void advanceAll();
  void advance(int panel);
  void finish(Work& work);

  float value(int panel, std::size_t i) const;
  void take(Work& work, std::size_t i, float value) const;
  float violation(const Work& work, int panel, LinkId link) const;
  float length(const Work& work, int panel, LinkId link) const;
  float distance(const Work& work, int panel, int other, ElementId element) const;
  float physicsError(const Work& work, int panel, ElementId element) const;

  float highestOf(int panel) const;
  void updateScales();
  ColourScale ranged(ColourScale scale) const;
  ColourScale finished(ColourScale scale) const;
  QString errorText(const Work& work) const;

  const Document& document_;
  BackgroundReference solution_;  // the reference solution
  ColourMode mode_ = ColourMode::violation;
  std::array<Work, Document::maxPanels> works_;
  std::array<ColourScale, Document::maxPanels> scales_;
  int reference_ = 0;
  bool sharesScale_ = true;
  std::array<ColourRange, std::size_t(ColourMode::physicsError) + 1> ranges_;  // by mode
  std::uint64_t number_ = 0;
  QTimer timer_;
};

}  // namespace chainmail
