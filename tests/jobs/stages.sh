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

# Prints the lines of ctest, with the times and failures of all stages before its summary.
# stages_before_summary NAME: these lines are a stage with that name, if it is not empty.
stages_before_summary() {
  local line summary= start=$SECONDS
  while IFS= read -r line; do
    if [[ -z $summary && $line == *'% tests passed'* ]]; then
      summary=1
      [[ -z ${1:-} ]] || times+=("$(printf '%6d s  %s' $((SECONDS - start)) "$1")")
      printf '%s\n' '' "${times[@]}" "$(printf '%6d s  %s' "$SECONDS" 'all stages')" ''
      [[ ${#failures[@]} -eq 0 ]] || printf '%s\n' "${failures[@]}" ''
    fi
    printf '%s\n' "$line"
  done
}
