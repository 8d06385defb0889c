#include "docks/preset_store.h"

#include <QLockFile>
#include <QSettings>
#include <algorithm>
#include <sstream>

#include "common/as_path.h"
#include "files/text/limits.h"
#include "files/text/outputs.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int lockMilliseconds = 5000;

QString key() { return QStringLiteral("softnessPresets"); }

/// Returns a key for text that cannot be read, which no text has.
QString keyOfDamaged(const QSettings& settings) {
  int number = 1;
  while (settings.contains(key() + QStringLiteral("Damaged%1").arg(number))) {
    ++number;
  }
  return key() + QStringLiteral("Damaged%1").arg(number);
}

bool isBuiltIn(const std::string& name) {
  return std::ranges::any_of(built_in_presets(), [&](const BuiltInPreset& one) { return one.name == name; });
}

std::vector<SoftnessPreset>::iterator find(std::vector<SoftnessPreset>& presets, const std::string& name) {
  return std::ranges::find(presets, name, &SoftnessPreset::name);
}

/// Returns a name that is not in use: 'felt', 'felt (2)', 'felt (3)'.
std::string freeName(std::vector<SoftnessPreset>& presets, const std::string& name) {
  std::string free = name;
  for (int i = 2; isBuiltIn(free) || find(presets, free) != presets.end(); ++i) {
    const std::string ending = " (" + std::to_string(i) + ")";
    QString start = QString::fromStdString(name);
    while (start.toStdString().size() + ending.size() > limits::preset_name_bytes) {
      start.chop(1);
    }
    free = start.trimmed().toStdString() + ending;
  }
  return free;
}

}  // namespace

void PresetStore::load() {
  own_.clear();
  const std::string text = QSettings().value(key()).toString().toStdString();
  if (!text.empty()) {
    own_ = read_presets(text, "settings");
  }
}

/// Changes the presets while no other window does.
template <class Edit>
void PresetStore::change(Edit edit) {
  QLockFile lock(QSettings().fileName() + QStringLiteral(".presets.lock"));
  if (!lock.tryLock(lockMilliseconds)) {
    throw Error("presets", "another window is changing them", "try again");
  }
  refresh();
  edit();
  keep();
}

/// Reads what another window may have changed.
void PresetStore::refresh() {
  QSettings settings;
  settings.sync();
  try {
    load();
  } catch (const Error&) {
    settings.setValue(keyOfDamaged(settings), settings.value(key()));
  }
}

void PresetStore::check(const std::string& name) const {
  const std::string where = "preset '" + name + "'";
  if (const std::string fault = fault_of_name(name); !fault.empty()) {
    throw Error(where, "this name is not allowed", fault);
  }
  if (isBuiltIn(name)) {
    throw Error(where, "a built-in preset has this name", "choose another name");
  }
}

void PresetStore::checkRoom(std::size_t present) {
  if (present >= limits::presets) {
    throw Error("presets", "there cannot be more than " + std::to_string(present), "delete some of them first");
  }
}

void PresetStore::save(const SoftnessPreset& preset) {
  check(preset.name);
  change([&] {
    if (const auto there = find(own_, preset.name); there != own_.end()) {
      *there = preset;
    } else {
      checkRoom(own_.size());
      own_.push_back(preset);
    }
  });
}

void PresetStore::rename(const std::string& name, const std::string& to) {
  if (name == to) {
    return;
  }
  check(to);
  change([&] {
    if (find(own_, to) != own_.end()) {
      throw Error("preset '" + to + "'", "another preset has this name", "choose another name");
    }
    const auto there = find(own_, name);
    if (there == own_.end()) {
      throw Error("preset '" + name + "'", "another window has removed it", "save it again under the new name");
    }
    there->name = to;
  });
}

void PresetStore::remove(const std::string& name) {
  change([&] { std::erase_if(own_, [&](const SoftnessPreset& preset) { return preset.name == name; }); });
}

std::size_t PresetStore::addFrom(const QString& path) {
  std::vector<SoftnessPreset> presets = read_presets(asPath(path));
  std::size_t added = 0;
  change([&] {
    std::vector<SoftnessPreset> all = own_;
    for (SoftnessPreset& preset : presets) {
      if (std::ranges::find(all, preset) == all.end()) {
        checkRoom(all.size());
        preset.name = freeName(all, preset.name);
        all.push_back(std::move(preset));
      }
    }
    added = all.size() - own_.size();
    own_ = std::move(all);
  });
  return added;
}

void PresetStore::writeTo(const QString& path) const {
  write_file(asPath(path), [this](std::ostream& out) { write_presets(out, own_); });
}

void PresetStore::keep() const {
  std::ostringstream text;
  write_presets(text, own_);
  QSettings().setValue(key(), QString::fromStdString(text.str()));
}

}  // namespace chainmail
