# shellcheck shell=bash
# Sourced by .ci/run and .ci/slow: steps whose failure stops none after them, and the names of all that failed or were
# skipped at the end. Whoever sources it sets `logs`, the folder of what the steps print.

: "${logs:?}"
failed=()
skipped=()
declare -A pids=()

step() {  # name, command...: runs it, keeps its output, notes its failure; a line that begins with SKIPPED says why
  local name=$1 start=$SECONDS reason
  shift
  printf '\n=== %s: %s\n' "$name" "$*"
  if ! "$@" 2>&1 | tee "$logs/$name.log"; then
    printf '=== %s: FAILED after %d s\n' "$name" "$((SECONDS - start))"
    failed+=("$name")
  elif reason=$(grep -m 1 '^SKIPPED' "$logs/$name.log"); then
    printf '=== %s: %s\n' "$name" "$reason"
    skipped+=("$name")
  else
    printf '=== %s: passed in %d s\n' "$name" "$((SECONDS - start))"
  fi
}

beside() {  # name, command...: begins a step in the background, which `await` shows and judges
  step "$@" >"$logs/$1.shown" 2>&1 &
  pids[$1]=$!
}

await() {  # name: the output of a step that `beside` began, and its verdict; one that was killed has none, and has failed
  wait "${pids[$1]}" || true
  cat "$logs/$1.shown"
  case $(tail -n 1 "$logs/$1.shown") in
    "=== $1: passed"*) ;;
    "=== $1: SKIPPED"*) skipped+=("$1") ;;
    *) failed+=("$1") ;;
  esac
}

finish() {  # names what failed and what was skipped
  [[ ${#skipped[@]} -eq 0 ]] || printf '=== SKIPPED: %s\n' "${skipped[*]}"
  [[ ${#failed[@]} -gt 0 ]] || return 0
  printf '=== FAILED: %s (logs in %s)\n' "${failed[*]}" "$logs" >&2
  exit 1
}

install_checkers() {  # the packages that packages.txt marks "check"
  local missing=() package
  while read -r package; do
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
  done < <(awk '$1 !~ /^#/ && $2 == "check" { print $1 }' packages.txt)
  [[ ${#missing[@]} -gt 0 ]] || return 0
  local as_root=()
  [[ $(id -u) -eq 0 ]] || as_root=(sudo)
  "${as_root[@]}" apt-get update
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
}
