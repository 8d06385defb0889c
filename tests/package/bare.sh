# shellcheck shell=bash
# Functions for a bare Debian in a folder, which root makes with debootstrap. Source app/setup.sh first.

# The names of the versions of Debian that are supported.
declare -A suite_of=([12]=bookworm [13]=trixie)

# Makes a bare system from the package source of this one.
#   make_bare FOLDER [SUITE]     SUITE is that of this system if it is left out
make_bare() {
  local folder=$1 site suite
  read -r site suite < <(apt-get indextargets --format '$(SITE) $(RELEASE)' 'Created-By: Packages')
  debootstrap --variant=minbase "${2:-$suite}" "$folder" "$site" || return
  mount -t proc proc "$folder/proc" && mount --bind /dev "$folder/dev" && mount --bind /dev/pts "$folder/dev/pts" || return
  if [[ ${2:-$suite} == "$suite" ]]; then
    rm -f "$folder/etc/apt/sources.list"  # of debootstrap: apt warns where a source is listed twice
    cp -r /etc/apt/sources.list /etc/apt/sources.list.d "$folder/etc/apt/" 2>/dev/null || true
    cp -r /usr/share/keyrings/. "$folder/usr/share/keyrings/"
  fi
  # Proxies and the like, but no file that a package will install.
  cp /etc/apt/apt.conf "$folder/etc/apt/" 2>/dev/null || true
  find /etc/apt/apt.conf.d -type f -print0 | while IFS= read -r -d '' file; do
    dpkg-query -S "$file" >/dev/null 2>&1 || cp "$file" "$folder/etc/apt/apt.conf.d/"
  done
  cp /etc/resolv.conf /etc/hosts "$folder/etc/"
}

# Runs a command in a bare system.
in_bare() {
  local folder=$1
  shift
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 HOME=/root chroot "$folder" "$@"
}

# Removes a bare system.
remove_bare() {
  umount -R "$1/proc" "$1/dev" 2>/dev/null || true
  rm -rf --one-file-system "$1"
}
