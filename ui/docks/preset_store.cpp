#include "docks/preset_store.h"

#include <QDir>
#include <QFileInfo>
#include <QLockFile>
#include <QSettings>
#include <algorithm>

#include "common/as_path.h"
#include "files/text/limits.h"
#include "files/text/outputs.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int lockMilliseconds = 5000;

/// Earlier versions kept the presets in the settings. Qt (6.4) empties the file of the settings without a word when the
/// disk is full, so presets have a file of their own.
std::string earlierText() { return QSettings().value(QStringLiteral("softnessPresets")).toString().toStdString(); }

/// Returns the first free name beside the file.
QString nameOfDamaged(const QString& path) {
  const auto name = [&](int number) {
    return QFileInfo(path).dir().filePath(QStringLiteral("softness-presets-damaged-%1.json").arg(number));
  };
  int number = 1;
  while (QFile::exists(name(number))) {
    ++number;
  }
  return name(number);
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

/// Changes the presets while no other window does.
template <class Edit>
void PresetStore::change(Edit edit) {
  QDir().mkpath(QFileInfo(file()).path());
  QLockFile lock(file() + QStringLiteral(".lock"));
  if (!lock.tryLock(lockMilliseconds)) {
    const bool isHeld = lock.error() == QLockFile::LockFailedError;
    throw Error("presets", isHeld ? "another window is changing them" : "their folder cannot be written",
                isHeld ? "try again"
                       : "free disk space, or check the permissions of " + QFileInfo(file()).path().toStdString());
  }
  refresh();
  const std::vector<SoftnessPreset> before = own_;
  try {
    edit();
    writeTo(file());
  } catch (...) {
    own_ = before;
    throw;
  }
}

/// Reads what another window may have changed. Text that cannot be read is kept in another file.
void PresetStore::refresh() {
  try {
    load();
  } catch (const Error&) {
    QFile::rename(file(), nameOfDamaged(file()));
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

}  // namespace chainmail
