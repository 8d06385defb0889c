#pragma once

#include <QObject>
#include <QTimer>
#include <array>
#include <memory>
#include <span>
#include <string_view>

#include "colour_values.h"
#include "document.h"

namespace chainmail {

enum class ColourMode { plain, compression, stretch, shear, violation, distance };

/// How a mode is called: `name` in settings and tests, `label` in the menu, `title` and `unit` in the legend.
struct ColourModeInfo {
  ColourMode mode;
  std::string_view name, label, title, unit;
};
std::span<const ColourModeInfo> colourModes();
const ColourModeInfo& info(ColourMode mode);

/// Works out what the objects of both panels are coloured by. It does so for panels that are painted alone, only when
/// something has changed, and in slices, so that a large mesh lags behind instead of the window.
class Colouring : public QObject {
  Q_OBJECT

 public:
  explicit Colouring(const Document& document);

  ColourMode mode() const { return mode_; }
  void setMode(ColourMode mode);

  /// To be called when a panel is painted. The values for its newest frame, or for one a little older while those are
  /// being worked out; none in plain mode and as long as there are none.
  const ColourValues* follow(int panel);
  /// One for both panels, so that a colour means the same in both.
  ColourScale scale() const { return scale_; }

 signals:
  void modeChanged();
  /// There is something else to paint.
  void changed();

 private:
  /// Positions of a panel as they were in a frame.
  struct Kept {
    std::vector<float> positions;
    std::uint64_t number = 0;  // of the frame

    /// Copies what has changed since.
    void follow(const Frame& frame);
  };
  /// The values of a panel, and those that will take their place.
  struct Work {
    bool outdated = true, running = false;
    std::size_t next = 0;
    ColourValues building, shown;
    // As they were when the work began: frames and softness may change meanwhile.
    Kept own, other;
    std::shared_ptr<const Softness> softness;
  };

  void receiveFrame(int panel);
  void startOver();
  bool start(int panel);
  void advance(Work& work);
  void finish(Work& work);
  float value(const Work& work, std::size_t i) const;
  void goOn();
  void updateScale();

  const Document& document_;
  ColourMode mode_ = ColourMode::plain;
  std::array<Work, Document::panels> works_;
  ColourScale scale_;
  std::uint64_t number_ = 0;
  QTimer timer_;
};

}  // namespace chainmail
