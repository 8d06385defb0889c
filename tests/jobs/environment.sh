# shellcheck shell=bash disable=SC2034
# What tests/run and its jobs share: a folder for a while, and how programs with sanitizers start. Sourced after
# app/setup.sh.

scratch=$(mktemp -d) # has mode 0700, which XDG_RUNTIME_DIR needs
trap 'rm -rf "$scratch"' EXIT
export XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-$scratch}
# If a block of thread-local variables begins 16 bytes into a page, the leak check of GCC 12 wrongly expects a header
# there and crashes. Without the interceptor it finds such blocks like all other memory of the loader.
export ASAN_OPTIONS=verify_asan_link_order=0:intercept_tls_get_addr=0
export LSAN_OPTIONS="suppressions='$root/tests/sanitizers/lsan.supp':print_suppressions=0"
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS="suppressions='$root/tests/sanitizers/tsan.supp'"

# Sets `with` to the command that starts the tests of build/PRESET.
start_with() {
  local preset=$1
  with=()
  if [[ $preset == asan ]]; then
    g++ -shared -fPIC -o "$scratch/keep_libraries.so" "$root/tests/sanitizers/keep_libraries.cpp" || return
    with=(env LD_PRELOAD="$scratch/keep_libraries.so")
  fi
  # The thread sanitizer of this compiler cannot start if addresses are randomised over 32 bits.
  if [[ $preset == tsan ]] && setarch -R true 2>/dev/null; then
    with=(setarch -R)
  fi
}

# What the sanitizers run with every change: programs, and the labels of their tests.
memory_programs=(test_core test_files test_faults test_documents test_threads chainmail_import)
memory_tests='^(core|files|faults|documents|threads)$'
