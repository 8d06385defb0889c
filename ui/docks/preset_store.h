#pragma once

#include <QString>
#include <vector>

#include "files/session/softness_presets.h"

namespace chainmail {

/// The user's softness presets, in a file beside the settings. Names are unique and differ from those of built-in
/// presets. Functions throw Error if they fail; then nothing has changed.
class PresetStore {
 public:
  const std::vector<SoftnessPreset>& own() const { return own_; }

  /// Returns the file of the presets.
  static QString file();
  /// Reads the file. Throws if it is damaged; then there are no presets. The next change gives the damaged file another
  /// name.
  void load();
  /// Adds a preset, or replaces the user's preset of this name.
  void save(const SoftnessPreset& preset);
  void remove(const std::string& name);

 private:
  void refresh();
  void write(std::vector<SoftnessPreset> presets);

  std::vector<SoftnessPreset> own_;
};

}  // namespace chainmail
