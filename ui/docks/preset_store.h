#pragma once

#include <QString>
#include <vector>

#include "files/session/softness_presets.h"

namespace chainmail {

/// The user's own presets of softness, kept in the settings. Names are unique, those built in included; what cannot
/// be done throws Error with a sentence.
class PresetStore {
 public:
  const std::vector<SoftnessPreset>& own() const { return own_; }

  /// Reads the settings; throws where they hold something else, and has no presets then.
  void load();
  /// Adds one, or gives one of the user's own of this name other values.
  void save(const SoftnessPreset& preset);
  void rename(const std::string& name, const std::string& to);
  void remove(const std::string& name);
  /// Adds all of a file that are not there yet, under another name where theirs is taken; says how many.
  std::size_t addFrom(const QString& path);
  /// Writes the user's own into a file, whole or not at all.
  void writeTo(const QString& path) const;

 private:
  void check(const std::string& name) const;
  void keep() const;

  std::vector<SoftnessPreset> own_;
};

}  // namespace chainmail
