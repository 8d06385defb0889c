#pragma once

#include <QString>
#include <vector>

#include "files/session/softness_presets.h"

namespace chainmail {

/// The user's softness presets, in a file beside the settings, which all windows share: each change is made to the
/// presets as another window has left them. Names are unique and differ from those of built-in presets. Functions throw
/// Error if they fail; then nothing has changed.
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
  void rename(const std::string& name, const std::string& to);
  void remove(const std::string& name);
  /// Adds the presets of a file that are new, under another name if theirs is taken. Returns the number of added
  /// presets.
  std::size_t addFrom(const QString& path);
  /// Writes the user's presets to a file, completely or not at all.
  void writeTo(const QString& path) const;

 private:
  template <class Edit>
  void change(Edit edit);
  void refresh();
  void check(const std::string& name) const;
  /// Throws Error if there are limits::presets already.
  static void checkRoom(std::size_t present);

  std::vector<SoftnessPreset> own_;
};

}  // namespace chainmail
