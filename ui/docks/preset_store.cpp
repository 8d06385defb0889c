#include "docks/preset_store.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSettings>
#include <algorithm>
#include <utility>

#include "common/as_path.h"
#include "files/text/limits.h"
#include "files/text/outputs.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Earlier versions kept the presets in the settings. Qt (6.4) empties the file of the settings without a word when the
/// disk is full, so presets have a file of their own.
std::string earlierText() { return QSettings().value(QStringLiteral("softnessPresets")).toString().toStdString(); }

}  // namespace

QString PresetStore::file() {
  return QFileInfo(QSettings().fileName()).dir().filePath(QStringLiteral("softness-presets.json"));
}

void PresetStore::load() {
  own_.clear();
  if (QFile::exists(file())) {
    own_ = read_presets(asPath(file()));
  } else if (const std::string text = earlierText(); !text.empty()) {
    own_ = read_presets(text, "settings");
  }
}

/// Reads what another window may have changed. A file that cannot be read gets another name.
void PresetStore::refresh() {
  try {
    load();
  } catch (const Error&) {
    QFile::rename(file(), file() + QStringLiteral(".damaged"));
  }
}

void PresetStore::save(const SoftnessPreset& preset) {
  const std::string where = "preset '" + preset.name + "'";
  if (const std::string fault = fault_of_name(preset.name); !fault.empty()) {
    throw Error(where, "this name is not allowed", fault);
  }
  if (std::ranges::count(built_in_presets(), preset.name, &BuiltInPreset::name) > 0) {
    throw Error(where, "a built-in preset has this name", "choose another name");
  }
  refresh();
  std::vector<SoftnessPreset> presets = own_;
  if (const auto there = std::ranges::find(presets, preset.name, &SoftnessPreset::name); there != presets.end()) {
    *there = preset;
  } else if (presets.size() < limits::presets) {
    presets.push_back(preset);
  } else {
    throw Error("presets", "there cannot be more than " + std::to_string(presets.size()), "delete some of them first");
  }
  write(std::move(presets));
}

void PresetStore::remove(const std::string& name) {
  refresh();
  std::vector<SoftnessPreset> presets = own_;
  std::erase_if(presets, [&](const SoftnessPreset& preset) { return preset.name == name; });
  write(std::move(presets));
}

void PresetStore::write(std::vector<SoftnessPreset> presets) {
  QDir().mkpath(QFileInfo(file()).path());
  write_file(asPath(file()), [&](std::ostream& out) { write_presets(out, presets); });
  own_ = std::move(presets);
}

}  // namespace chainmail
