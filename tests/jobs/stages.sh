# shellcheck shell=bash
# Stages of tests/run: each is timed, and one that fails does not stop the next one. Sourced after environment.sh.

failures=()
times=()

# stage NAME COMMAND…: runs a stage. Its time and its failure are printed again before the summary.
stage() {
  local name=$1 start=$SECONDS failed=
  shift
  say "== $name"
  ("$@") || failed=1
  times+=("$(printf '%6d s  %s' $((SECONDS - start)) "$name")")
  if [[ -z $failed ]]; then
    say "== $name: done in $((SECONDS - start)) s"
  else
    failures+=("tests/run: the stage '$name' failed")
    printf '%s\n' "${failures[-1]}" >&2
  fi
}

# Ends the script if a stage has failed.
stop_after_failures() { [[ ${#failures[@]} -eq 0 ]] || exit 1; }

# Runs ctest in build/PRESET: run_tests PRESET OPTION…
run_tests() {
  local preset=$1 with
  shift
  start_with "$preset" || return
  (cd "$root" && "${with[@]}" ctest --preset "$preset" --parallel "$(nproc)" "$@" 2>&1)
}

# Prints how many lines of sources the folders have.
show_lines() {
  local folder
  for folder in app core ui tests; do
    printf '%6d lines  %s\n' "$(cd "$root" && git ls-files -z "$folder" | grep -zE '[.](cpp|h|py|pyi|sh|vert|frag)$' |
      xargs -0 cat | wc -l)" "$folder"
  done
}

# Prints the seconds of all stages, and what failed.
show_times() {
  printf '%s\n' '' "${times[@]}" "$(printf '%6d s  %s' "$SECONDS" 'all stages')"
  [[ ${#failures[@]} -eq 0 ]] || printf '%s\n' '' "${failures[@]}"
}

# Prints the lines of ctest. Before its summary: the times and failures of all stages, the ten slowest tests, and the
# lines of sources. show_summary NAME: the lines of ctest are a stage with that name.
show_summary() {
  local line summary='' start=$SECONDS slow=()
  while IFS= read -r line; do
    if [[ $line =~ Test\ +#[0-9]+:\ ([^ ]+)\ .*\ ([0-9.]+)\ sec ]]; then
      slow+=("$(printf '%8.1f s  %s' "${BASH_REMATCH[2]}" "${BASH_REMATCH[1]}")")
    elif [[ -z $summary && $line == *'% tests passed'* ]]; then
      summary=1
      [[ -z ${1:-} ]] || times+=("$(printf '%6d s  %s' $((SECONDS - start)) "$1")")
      printf '\nThe slowest tests:\n'
      printf '%s\n' "${slow[@]}" | sort -rn | sed 10q
      show_times
      show_lines
      say
    fi
    printf '%s\n' "$line"
  done
}
